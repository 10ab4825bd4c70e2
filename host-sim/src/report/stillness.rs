//! Still moves compared with the usual ones in the same time.

use std::f64::consts::PI;

use maud::html;

use super::Section;
use super::parts::{Table, figure, fixed};
use crate::error::Error;
use crate::plan::comparison::{self, Entry};
use crate::plan::picture;
use crate::study::Study;
use crate::study::stillness::PERIODS;

/// The section.
pub(super) fn section(study: &Study) -> Result<Section, Error> {
    let found = &study.stillness;
    let length = found.arm.link.length;
    let swing = picture::swing(&found.entries, found.duration, length);
    let swing_caption = html! {
        strong { "The hub stops, and the tip stops with it." }
        " Member A with 30 g, \u{3c0} rad in " (fixed(found.duration, 2)) " s, " (PERIODS)
        " first periods, the delay of the shaper included; the reference rod."
    };
    let curves_caption = html! {
        strong { "What if the arm is not the one it was planned for?" }
        " Largest deflection within a first period after the move, the arm\u{2019}s frequency off \
         by so much. The robust move is planned for three arms at once."
    };
    let moving = picture::moving(&found.entries, &found.arm, PI);
    let row = |entry: &Entry| entry.cells(found.duration);
    let table = Table {
        caption: "Residual in % of L where the arm\u{2019}s frequency is off by so much. Shapers \
                  are made for the frequency of the straight arm; those that leave less than a \
                  quarter of a first period for the motion are left out. Rate in \u{3c0}/T, \
                  acceleration in \u{3c0}/T\u{b2}, torque in mN\u{a0}m, frequency right"
            .into(),
        header: comparison::HEADER.to_vec(),
        rows: found.entries.iter().map(row).collect(),
        key: found.entries.iter().position(|entry| entry.name == "still"),
    };
    let body = html! {
        p {
            "The cubic leaves member B almost at rest by luck. A still move is planned to: its \
             angle is a quintic with a bulge, and the bulge is what leaves the arm\u{2019}s exact \
             rod, flown through the move on the microcontroller, without vibration. \
             Every motion below takes the same time."
        }
        @if let Some(moving) = &moving {
            (moving.figure(&html! {
                "The three arms " (moving.speed()) ", over and over. Dashed: where they shall rest."
            }))
        }
        (figure(&[swing], &swing_caption, "stillness-swing.csv")?)
        (figure(&[picture::sensitivity(&found.curves)], &curves_caption, "stillness.csv")?)
        (table.markup())
        p.soft {
            "Other arms, durations and limits: docs/still.md; an arm of your own: "
            code { "stillbeam-sim plan SCENE --to ANGLE" } "."
        }
    };
    Ok(Section { id: "stillness", title: "Moves that arrive still", body })
}
