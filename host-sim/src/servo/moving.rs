//! The arm behind the drive, with less and with more of the setpoints sent.

use stillbeam::Scene;

use super::bench::Feed;
use super::trials::{Outcome, Report, Trial};
use crate::animation::{Animation, Arm, INTERVALS, Ink, Link, Panel};
use crate::number::{Digits, percent};

/// Draws the arm with positions alone, with all that can be sent, and with a still move, side by
/// side. A trial that was not made is left out.
pub fn animation(report: &Report) -> Animation {
    let shown = [
        (Trial { feed: Feed::POSITION, ..Trial::PLAIN }, Ink::Vermilion),
        (Trial::PLAIN, Ink::Orange),
        (Trial::STILL, Ink::Blue),
    ];
    let made: Vec<(&Outcome, Ink)> =
        shown.iter().filter_map(|(trial, ink)| Some((report.find(trial)?, *ink))).collect();
    let ends = made.iter().filter_map(|(outcome, _)| outcome.trace.shown.last());
    let seconds = ends.map(|shown| shown.t).fold(0.0, f64::max);
    let goal = report.commanded.angles(0.0).last().map(|(_, angle)| angle);
    let panels =
        made.iter().map(|(outcome, ink)| panel(&report.arm, outcome, *ink, seconds)).collect();
    let label = "The arm behind the drive".to_owned();
    Animation { panels, ..Animation::of_link(&report.arm, label, goal, seconds) }
}

fn panel(arm: &Scene, outcome: &Outcome, ink: Ink, seconds: f64) -> Panel {
    let samples = outcome.trace.shown.iter().map(|shown| (shown.t, shown.angle, shown.deflection));
    let left = percent(outcome.judged.residual, 1.0, Digits::Three);
    let behind = Digits::Three.show(1e3 * outcome.judged.hub);
    Panel {
        arms: vec![Arm {
            label: outcome.trial.describe(),
            ink,
            frames: Link::of(arm).frames(samples, seconds, INTERVALS),
        }],
        remark: format!("hub off by {behind} mrad; {left} of L left"),
    }
}
