//! Fig. 1: rigid and flexible tip path.

use maud::html;

use super::Section;
use super::parts::{figure, percent};
use crate::animation::{Animation, Arm, INTERVALS, Ink, Link, Panel};
use crate::error::Error;
use crate::plot::{Axis, Chart, Colour, Dash, Marker, Series};
use crate::study::{Run, Study};

/// Seconds between the marked instants.
const EVERY: f64 = 0.02;

/// The section.
pub(super) fn section(study: &Study) -> Result<Section, Error> {
    let (rigid, flexible) = (&study.tip_path.rigid, &study.tip_path.flexible);
    let chart =
        Chart::new("Fig. 1: path of the tip", Axis::linear("tip X, m"), Axis::linear("tip Y, m"))
            .sized(900, 600)
            .equal_scales()
            .with(Series::line("", spokes(rigid)).colour(Colour::Grey).width(1))
            .with(Series::line("", spokes(flexible)).colour(Colour::Orange).width(1))
            .with(Series::line("rigid link", path(rigid)).colour(Colour::Ink).dash(Dash::Dashed))
            .with(Series::line("flexible link", path(flexible)).colour(Colour::Vermilion))
            .with(
                Series::scatter("rigid, every 20 ms of the move", instants(rigid))
                    .colour(Colour::Ink),
            )
            .with(
                Series::scatter("flexible, the same instants", instants(flexible))
                    .colour(Colour::Vermilion)
                    .marker(Marker::Ring),
            );
    let caption = html! {
        strong { "The flexible tip first lags, then runs ahead, and goes on swinging." }
        " Seen from above; member D bare, \u{3c0} rad in 0.2 s from right to left, then 0.2 s of \
         rest, undamped, " (flexible.solver.describe()) ". Thin lines join the motor\u{2019}s axis \
         and the tip at the same instants. The largest deflection, " (percent(flexible.peak(), 0))
        " of L, is that of the swing after the hub has stopped; the path leaves the circle there \
         because a bent link is also a shorter one."
    };
    let moving = moving(rigid, flexible);
    let body = html! {
        (moving.figure(&html! {
            "The same move " (moving.speed()) ", over and over. Dashed: where the link shall rest."
        }))
        (figure(&[chart], &caption, "fig1-tip-path.csv")?)
    };
    Ok(Section { id: "fig1", title: "Fig. 1: rigid and flexible tip path", body })
}

/// Draws the flexible link over the rigid one.
fn moving(rigid: &Run, flexible: &Run) -> Animation {
    let seconds = flexible.rows.last().map_or(0.0, |row| row.t_s);
    let arm = |label: &str, ink, run: &Run| {
        let samples = run.rows.iter().map(|row| (row.t_s, row.hub_angle_rad, row.deflection_m));
        let frames = Link::of(&run.scene.arm).frames(samples, seconds, INTERVALS);
        Arm { label: label.to_owned(), ink, frames }
    };
    let arms =
        vec![arm("rigid link", Ink::Grey, rigid), arm("flexible link", Ink::Vermilion, flexible)];
    let remark = format!("up to {} of L off", percent(flexible.peak(), 0));
    let label = "A rigid and a flexible link along the same move".to_owned();
    let goal = flexible.rows.last().map(|row| row.hub_angle_rad);
    Animation {
        panels: vec![Panel { arms, remark }],
        ..Animation::of_link(&flexible.scene.arm, label, goal, seconds)
    }
}

fn path(run: &Run) -> Vec<(f64, f64)> {
    run.rows.iter().map(|row| (row.tip_x_m, row.tip_y_m)).collect()
}

/// Returns the tip every 20 ms of the move.
fn instants(run: &Run) -> Vec<(f64, f64)> {
    let every = (EVERY / run.solver.tick).round() as usize;
    let moving = run.rows.iter().step_by(every).take_while(|row| row.t_s < run.move_time() + 1e-9);
    moving.map(|row| (row.tip_x_m, row.tip_y_m)).collect()
}

/// Returns the path from the axis to each of those points and back.
fn spokes(run: &Run) -> Vec<(f64, f64)> {
    instants(run).into_iter().flat_map(|tip| [(0.0, 0.0), tip]).collect()
}
