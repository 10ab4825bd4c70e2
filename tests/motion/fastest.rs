//! The fastest moves that arrive still, held against the reference rod.

use std::f64::consts::PI;

use stillbeam::planner::{FastestMove, Planner, Request};
use stillbeam::{Limits, Profile};
use stillbeam_sim::limits::Case;
use stillbeam_sim::plan::Options;
use stillbeam_sim::plan::asked::Asked;
use stillbeam_sim::plan::judge::Motion;
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
    let options = Options::default();
    let asked = Asked { before, limits, from, to, duration, robust, options, settle, count };
    let (plan, _) = asked.plan_fastest().expect("a search").expect("a move");
    let bound = shortest::rigid_bound(PI, limits, TICK).expect("a limit");
    assert!(plan.duration() < 1.62 && plan.duration() > bound, "{} {bound}", plan.duration());
}

/// π rad within 9 π/T² for T of two first periods, the frequency known to a fifth.
#[test]
fn a_robust_move_leaves_what_it_may_in_the_rod() {
    let arm = scenes::open("a-tip30").expect("a scene").arm;
    let period = Planner::<f64, 2>::new(&arm, TICK).expect("planner").first_period();
    let limits =
        &Limits { acceleration: Some(9.0 * PI / (4.0 * period * period)), ..Limits::default() };
    let before = Case { arm: &arm, from: 0.0, steps: &[], shaper: None, tick: TICK };
    let (duration, robust) = (None, Some(0.2));
    let (from, to, settle, count) = (0.0, PI, 0.0, 1);
    let options = Options { residual: Some(0.03), ..Options::default() };
    let asked = Asked { before, limits, from, to, duration, robust, options, settle, count };
    let (plan, _) = asked.plan_fastest().expect("a search").expect("a move");
    assert!(plan.duration() < 2.0 * period, "{} of {period}", plan.duration());
    for error in [-0.2, -0.15, -0.05, 0.05, 0.15, 0.2] {
        let judged = Motion::of(0.0, shortest::path(&plan), TICK).judge(&arm, error);
        let judged = judged.expect("a run");
        assert!(judged.residual < 0.031, "{error}: {}", judged.residual);
        assert!(judged.acceleration <= limits.acceleration.unwrap() * (1.0 + 1e-9));
    }
    // An arm with damping has no such move, which is said.
    let damped = scenes::open("b-tip30-damped-hub").expect("a scene").arm;
    let asked = Asked { before: Case { arm: &damped, ..before }, ..asked };
    let refused = asked.plan_fastest().expect_err("damping").to_string();
    assert!(refused.starts_with("within: no such move was found"), "{refused}");
}

/// Member D bare, π rad in one first period: two modes at rest, at a lower peak than the still
/// move's
/// 12.2 π/T² and with less than a third of its residual. What is left is the third mode's.
#[test]
fn both_modes_rest_in_a_short_move() {
    let arm = scenes::open("d-fast").expect("a scene").arm;
    let period = Planner::<f64, 2>::new(&arm, TICK).expect("planner").first_period();
    for (ratio, most, left) in [(1.0, 7.9, 3.4e-3), (2.0, 4.2, 7e-4)] {
        let duration = ratio * period;
        let tick = duration / 200.0;
        let planner = Planner::<f64, 2>::new(&arm, tick).expect("planner");
        let request = Request::from_rest(0.0, PI).duration(duration).any_deflection();
        let plan: FastestMove<24> = planner.gentlest(&request).expect("a request").expect("a move");
        let judged = Motion::of(0.0, shortest::path(&plan), tick).judge(&arm, 0.0);
        let judged = judged.expect("a run");
        let acceleration = judged.acceleration * duration * duration / PI;
        assert!(acceleration < most, "{ratio}: {acceleration}");
        assert!(judged.residual < left, "{ratio}: {}", judged.residual);
    }
}
