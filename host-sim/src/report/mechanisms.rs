//! Link systems: all torques at once, and an arm that becomes a loop.

use maud::html;

use super::parts::{Table, figure, fixed, percent};
use super::{Section, TIME};
use crate::error::Error;
use crate::mechanism::picture;
use crate::plot::{Axis, Chart, Colour, Dash, Series};
use crate::study::Study;
use crate::study::mechanisms::Pair;

/// The section.
pub(super) fn section(study: &Study) -> Result<Section, Error> {
    let found = &study.mechanisms;
    let (open, closing) = (&found.open, &found.closing);
    let open_charts =
        [torques(open, 0, ["core", "reference rod"]), torques(open, 1, ["core", "reference rod"])];
    let open_caption = html! {
        strong { "Nodal forces first, then the torques of all joints at once." }
        " Two flexible links, 1 rad each in 0.6 s. One tick carries the forces of both links back \
         from the tip, lengths \u{d7} directions \u{d7} forces; the reference rod finds the same \
         torques by virtual work. They differ by " (percent(open.apart(), 2)) " of the peak."
    };
    let drawn = [picture::poses(&closing.scene, &closing.flexible)];
    let drawn_caption = html! {
        strong { "The same algorithm before and after the loop closes." }
        " Three links reach for a pivot, close on it at 1.8 s, let go of joints 2 and 3, and are a \
         four-bar driven by joint 1 alone."
    };
    let count = closing.scene.mechanism.links.len();
    let curves: Vec<Chart> =
        (0..count).map(|j| torques(closing, j, ["tick of 10 ms", "tick of 1 ms"])).collect();
    let curves_caption = html! {
        strong { "Torques of an open arm that becomes a loop." }
        " From the time of closing on, joints 2 and 3 are free. The tick of 10 ms in f32 is within "
        (percent(closing.apart(), 2)) " of the peak of one of 1 ms in f64 with a coordinate more."
    };
    let looped = &found.looped;
    let rigid_charts = [
        picture::poses(&looped.scene, &looped.flexible),
        torques(looped, 0, ["flexible", "rigid"]),
    ];
    let rigid_caption = html! {
        strong { "Rigid links ask for other torques." }
        " A four-bar whose crank turns once in 0.8 s. Links that bend store what the drive gives, \
         and give it back; afterwards they swing, where rigid links stand."
    };
    let row = |(name, pair, joint): &(&str, &Pair, usize)| {
        let peaks = pair.peaks(*joint).map(|peak| fixed(1e3 * peak, 1));
        vec![(*name).to_owned(), peaks[0].clone(), peaks[1].clone()]
    };
    let table = Table {
        caption: "Peak torque of the crank, in mN\u{a0}m".into(),
        header: vec!["Mechanism", "Flexible links", "Rigid links"],
        rows: [("four-bar", looped, 0)].iter().map(row).collect(),
        key: None,
    };
    let body = html! {
        (figure(&open_charts, &open_caption, "mechanisms-open.csv")?)
        (figure(&drawn, &drawn_caption, "mechanisms-closing.csv")?)
        (figure(&curves, &curves_caption, "mechanisms-closing.csv")?)
        (figure(&rigid_charts, &rigid_caption, "mechanisms-loop.csv")?)
        (table.markup())
        p.soft {
            "Mechanisms of your own: docs/mechanisms.md; "
            code { "stillbeam-sim run SCENE --csv OUT.csv --page OUT.html" } "."
        }
    };
    Ok(Section { id: "mechanisms", title: "Several links, open and closed", body })
}

/// Draws one joint's torque of both runs.
fn torques(pair: &Pair, joint: usize, [own, other]: [&str; 2]) -> Chart {
    let points = |rows: &[crate::mechanism::table::Row]| -> Vec<(f64, f64)> {
        rows.iter().map(|row| (row.t, row.torques[joint])).collect()
    };
    let title = format!("Joint {}", joint + 1);
    let chart = Chart::new(title, Axis::tight(TIME), Axis::linear("torque, N m"))
        .with(Series::line(other, points(&pair.other)).colour(Colour::Grey).dash(Dash::Dashed))
        .with(Series::line(own, points(&pair.flexible)).colour(Colour::Blue));
    match crate::mechanism::closes_at(&pair.scene.mechanism) {
        Some(t) => chart.mark(t, "closes"),
        None => chart,
    }
}
