//! The fastest moves that arrive still, held against the reference rod.

use std::f64::consts::PI;

use stillbeam::planner::{FastestMove, Planner, Request};
use stillbeam::{Limits, Profile};
use stillbeam_sim::limits::Case;
use stillbeam_sim::plan::judge::Motion;
use stillbeam_sim::plan::kept::Asked;
use stillbeam_sim::plan::shortest;
use stillbeam_sim::scenes;

const TICK: f64 = 0.01;

/// Planned as on a target, with 12 intervals in f32.
#[test]
fn the_rod_rests_behind_a_fastest_move() {
    let arm = scenes::open("a-tip30").expect("a scene").arm;
    let planner = Planner::<f32, 2>::new(&arm, TICK).expect("planner");
    for (ratio, bound) in [(1.5, 3e-3), (2.0, 1e-3), (3.0, 5e-4)] {
        let peaks = Profile::SCurve.peaks(PI, ratio * planner.first_period());
        let limits = Limits {
            rate: Some(peaks.rate),
            acceleration: Some(peaks.acceleration),
            jerk: Some(peaks.jerk),
            ..Limits::default()
        };
        let request = Request::from_rest(0.0, PI).limits(limits).any_deflection();
        let plan: FastestMove<12> = planner.fastest(&request).expect("a request").expect("a move");
        let judged = Motion::of(0.0, shortest::path(&plan), TICK).judge(&arm, 0.0).expect("a run");
        assert!(judged.residual < bound, "{ratio} first periods: {}", judged.residual);
        // The rod's largest rate and acceleration are looked at twice a tick.
        assert!(judged.rate <= peaks.rate * (1.0 + 1e-9), "{}", judged.rate);
        assert!(judged.acceleration <= peaks.acceleration * (1.0 + 1e-9), "{judged:?}");
    }
}

/// A search that only lengthens what exceeds a limit passed over a duration that is accepted, and
/// took 1.98 s.
#[test]
fn no_accepted_duration_is_passed_over() {
    let arm = scenes::open("a-tip30").expect("a scene").arm;
    let limits = &Limits { rate: Some(2.9143), acceleration: Some(5.8872), ..Limits::default() };
    let before = Case { arm: &arm, from: 0.0, steps: &[], shaper: None, tick: TICK };
    let (duration, robust) = (None, None);
    let (from, to, settle, count) = (0.0, PI, 0.0, 1);
    let asked = Asked { before, limits, from, to, duration, robust, settle, count };
    let (plan, _) = asked.plan_fastest().expect("a search").expect("a move");
    let bound = shortest::rigid_bound(PI, limits, TICK).expect("a limit");
    assert!(plan.duration() < 1.62 && plan.duration() > bound, "{} {bound}", plan.duration());
}
