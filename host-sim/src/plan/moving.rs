//! The arm as it bends along a quintic and along the still move, side by side.

use stillbeam::Scene;

use super::Request;
use crate::animation::{Animation, Arm, INTERVALS, Ink, Link, Panel};
use crate::number::{Digits, percent};
use crate::plan::judge::Judgement;

/// Draws the quintic beside the still move of the same duration, both as the reference rod follows
/// them. Returns `None` on a linear axis and on a carrier that turns.
pub fn animation(request: &Request, quintic: &Judgement, still: &Judgement) -> Option<Animation> {
    let shown = [("quintic", Ink::Vermilion, quintic), ("still move", Ink::Blue, still)];
    side_by_side(&request.arm, request.to, shown)
}

/// Draws motions to the hub angle `to`, rad, side by side: the name, the colour and the run of
/// each. Returns `None` on a linear axis and on a carrier that turns.
pub fn side_by_side<'a>(
    arm: &Scene,
    to: f64,
    motions: impl IntoIterator<Item = (&'a str, Ink, &'a Judgement)>,
) -> Option<Animation> {
    if arm.mount.is_linear() || arm.mount.carrier != 0.0 {
        return None;
    }
    let motions: Vec<_> = motions.into_iter().collect();
    let ends = motions.iter().filter_map(|(_, _, run)| run.samples.last().map(|sample| sample.t));
    let seconds = ends.fold(0.0, f64::max);
    let panel = |(name, ink, run): &(&str, Ink, &Judgement)| {
        let samples = run.samples.iter().map(|s| (s.t, s.angle, s.deflection));
        let frames = Link::of(arm).frames(samples, seconds, INTERVALS);
        let left = percent(run.residual, 1.0, Digits::Three);
        Panel {
            arms: vec![Arm { label: (*name).to_owned(), ink: *ink, frames }],
            remark: format!("{left} of L left"),
        }
    };
    let names: Vec<&str> = motions.iter().map(|(name, _, _)| *name).collect();
    let label = format!("The arm as it bends: {}", names.join(", "));
    let panels = motions.iter().map(panel).collect();
    Some(Animation { panels, ..Animation::of_link(arm, label, Some(to), seconds) })
}
