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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Options;
    use crate::plan::judge::Motion;
    use crate::scenes;
    use stillbeam::{Limits, Move, Profile};

    #[test]
    fn both_arms_end_where_they_shall_and_one_is_still() {
        let arm = scenes::open("b-tip30").expect("a scene").arm;
        let (limits, options, tick) = (Limits::default(), Options::default(), 0.01);
        let (from, to, duration, robust) = (0.0, 1.2, Some(1.0), None);
        let request = Request { arm, from, to, duration, limits, robust, options, tick };
        let plan = request.plan().expect("a plan").plan;
        let quintic = Move::To { profile: Profile::Quintic, duration: 1.0, to: 1.2 };
        let [quintic, still] = [quintic, plan.motion()]
            .map(|motion| Motion::of(0.0, motion, tick).judge(&arm, 0.0).expect("a judgement"));
        let animation = animation(&request, &quintic, &still).expect("a picture");
        let swing = |panel: &Panel| {
            let rest = panel.arms[0].frames.iter().rev().take(40);
            rest.fold(0.0, |most: f64, frame| most.max(frame.deflections[0].abs()))
        };
        let [quintic, still] = [0, 1].map(|k| &animation.panels[k]);
        assert!(swing(still) < 1e-3 * arm.link.length, "{}", swing(still));
        assert!(swing(quintic) > 20.0 * swing(still), "{}", swing(quintic));
        assert!(quintic.remark.contains(" % of L left"), "{}", quintic.remark);
        for panel in [quintic, still] {
            let last = panel.arms[0].frames.last().expect("a frame");
            let reach = arm.hub.radius + arm.link.length;
            let [x, y] = last.line[last.line.len() - 1];
            let off = (x - reach * f64::cos(1.2)).hypot(y - reach * f64::sin(1.2));
            assert!(off < 1.1 * last.deflections[0].abs() + 1e-9, "{off} {:?}", last.deflections);
        }
    }
}
