//! Torque and moment: refused where they cannot be checked, kept where they are taken.

use std::f64::consts::PI;

use stillbeam::axis::{Axis, Policy, StopLimits};
use stillbeam::motion::{Braking, Plan};
use stillbeam::planner::{Kinematics, Planner, Prediction, Request, StillMove, Target};
use stillbeam::stepper::Rigid;
use stillbeam::{Angle, Error, Generator, Limits, Link, Move, Profile, Remedy, Scene};

use stillbeam::HubState;
use stillbeam_sim::plan::judge::Motion;

const TICK: f64 = 0.01;

/// Relative error of a predicted torque.
const PREDICTED: f64 = Prediction::MARGIN;

fn scene() -> Scene {
    Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 })
}

fn rigid() -> Rigid<f32> {
    Rigid::new(&scene(), TICK).expect("a stepper")
}

/// Every layer that takes limits and does not fly the arm.
#[test]
fn layers_that_cannot_check_a_load_refuse_its_limit() {
    let base = Limits { acceleration: Some(100.0), ..Limits::default() };
    for (name, limits) in [
        ("limits.torque = 0.3 N m", Limits { torque: Some(0.3), ..base }),
        ("limits.moment = 0.3 N m", Limits { moment: Some(0.3), ..base }),
    ] {
        let motion = Move::To { profile: Profile::Cubic, duration: 1.0, to: 1.0 };
        let start = HubState::resting_at(0.0).expect("an angle");
        let policy = Policy { limits, stop: StopLimits::OF_MOVES, patience: 0.0, missed: 0 };
        let mut generator = Generator::<_, 8>::new(rigid(), 0.0).expect("a generator");
        for refused in [
            generator.limit(limits),
            Axis::<_, 8>::new(rigid(), Angle::default(), policy).map(drop),
            Braking::<f32>::new(&limits, TICK).map(drop),
            Plan::new(&motion, start, &limits, TICK).map(drop),
        ] {
            let error = refused.expect_err("no means to check it").to_string();
            assert!(error.starts_with(name) && error.contains("must be absent here"), "{error}");
        }
        // What was refused is not half in force.
        assert_eq!(
            generator.plan_context(),
            Generator::<_, 8>::new(rigid(), 0.0).unwrap().plan_context()
        );
        generator.limit(limits.kinematic()).expect("none of the arm");
    }
}

/// Handed in, or the planner's own, or both: the smaller.
#[test]
fn a_planners_own_load_limits_are_kept_by_all_its_moves() {
    let free = Planner::<f32, 2>::new(&scene(), TICK).expect("a planner");
    let strong = Limits { torque: Some(5.0), ..Limits::default() };
    for weak in [
        free.clone().with_load_limits(Some(0.4), None).expect("limits"),
        free.clone().with_load_limits(None, Some(0.4)).expect("limits"),
    ] {
        let request = Request::from_rest(0.0, PI).limits(strong);
        let plan = weak.plan(&request).expect("a plan");
        let prediction = weak.predict(&plan, None);
        assert!(prediction.torque <= 0.4 && prediction.moment <= 0.4, "{prediction:?}");
        let short = plan.duration() - 2.0 * TICK;
        let exceeded = |error: Error| {
            assert!(error.to_string().contains(": the move needs "), "{error}");
        };
        let unlimited = Request::from_rest(0.0, PI).duration(short).any_deflection();
        exceeded(weak.plan(&unlimited).expect_err("unlimited"));
        let linear = unlimited.kinematics(Kinematics::Linear).duration(0.8 * short);
        exceeded(weak.plan(&linear).expect_err("linear"));
        exceeded(weak.plan(&request.duration(short)).expect_err("limited"));
        free.plan(&request.duration(short)).expect("a plan");
        // The one that is handed in is the smaller.
        let weaker = Limits { torque: Some(0.1), ..Limits::default() };
        let plan = weak.plan(&request.limits(weaker)).expect("a plan");
        assert!(weak.predict(&plan, None).torque <= 0.1);
        // On the target the generator's context has none: the planner keeps its own.
        let arm = Generator::<_, 8>::new(rigid(), 0.0).expect("a generator");
        exceeded(arm.plan_context().plan_still(&weak, PI, Some(short)).expect_err("beyond"));
        arm.plan_context().plan_still(&weak, PI, None).expect("a plan");
    }
    for nonsense in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(free.clone().with_load_limits(Some(nonsense), None).is_err());
    }
}

/// A stop begins with the torque that the moving arm takes: a limit below that has none.
#[test]
fn a_stop_keeps_the_planners_own_loads() {
    let free = Planner::<f32, 2>::new(&scene(), TICK).expect("a planner");
    let stop = Request::from_hub(HubState::turning(Angle::default(), 3.0), Target::Stop);
    let torque = free.predict(&free.plan(&stop).expect("a stop"), None).torque;
    let weak = free.with_load_limits(Some(0.3 * torque), None).expect("limits");
    let slower = weak.predict(&weak.plan(&stop).expect("a slower stop"), None);
    assert!(slower.torque <= 0.3 * torque, "{slower:?}");
    let course = weak.plan_by_stop(&stop.target(Target::Angle(2.0))).expect("a move");
    let slower = course.predict(&weak, None);
    assert!(slower.torque <= 0.3 * torque, "{slower:?}");
}

/// The duration that an explained refusal names is taken, a tick less is not.
#[test]
fn a_refused_still_move_is_explained() {
    let planner = Planner::<f32, 2>::new(&scene(), TICK).expect("a planner");
    for limits in [
        Limits { torque: Some(0.4), ..Limits::default() },
        Limits { moment: Some(0.4), ..Limits::default() },
        Limits { rate: Some(8.0), ..Limits::default() },
        Limits { jerk: Some(5e3), acceleration: Some(200.0), ..Limits::default() },
    ] {
        let request = Request::from_rest(0.0, PI).limits(limits);
        let error = planner.plan(&request.duration(0.15)).expect_err("too short");
        let remedy = planner.remedy(&error, &request);
        let Remedy::Duration(duration) = remedy else { panic!("{remedy}") };
        planner.plan(&request.duration(duration)).expect("the duration that is named");
        assert!(planner.plan(&request.duration(duration - TICK)).is_err(), "{remedy}");
    }
}

/// Holding the arm level takes more than the limit: no duration helps, and the refusal says so.
#[test]
fn a_limit_below_the_weight_is_explained_by_it() {
    let mut heavy = scene();
    heavy.gravity = 2.0;
    heavy.payload.mass = 0.05;
    let planner = Planner::<f32, 2>::new(&heavy, TICK).expect("a planner");
    // Level at the middle of the way: the payload and half the link at their lever arms.
    let held = 2.0 * (0.05 * 0.4 + 0.0224 * 0.2);
    let limits = Limits { torque: Some(0.8 * held), ..Limits::default() };
    let up = Request::from_rest(-0.5 * PI, 0.5 * PI).limits(limits);
    let weight = |error: Error| match planner.remedy(&error, &up) {
        Remedy::Weight(held) => held,
        other => panic!("{other}"),
    };
    let shortest = weight(planner.plan(&up).expect_err("weak"));
    let period = planner.first_period();
    let timed = weight(planner.plan(&up.duration(3.0 * period)).expect_err("weak"));
    for found in [shortest, timed] {
        assert!((found / held - 1.0).abs() < 0.02, "{found} {held}");
    }
    // Hanging to half-way up it is light enough.
    planner.plan(&up.target(Target::Angle(-0.3 * PI))).expect("a plan");
}

/// Largest error of a predicted torque against the reference rod, over arms and moves that bend by
/// up to half the length. The hub has neither radius nor inertia, so the moment is the torque.
#[test]
fn a_prediction_peaks_as_the_reference_rod() {
    let mut worst = 0.0_f64;
    for payload in [0.0, 0.3, 1.0, 3.0] {
        for ratio in [1.5, 2.0, 3.0] {
            for to in [0.4, 1.5, PI] {
                let mut arm = scene();
                arm.payload.mass = payload * arm.link.mass;
                let rough = Planner::<f32, 2>::new(&arm, TICK).expect("a planner");
                let tick = rough.first_period() / 20.0;
                let planner = Planner::<f32, 2>::new(&arm, tick).expect("a planner");
                let request = Request::from_rest(0.0, to).duration(ratio * 20.0 * tick);
                let plan = planner.plan(&request.any_deflection()).expect("a plan");
                let prediction = planner.predict(&plan, None);
                // The same curve, looked at forty times a tick.
                let finer = StillMove { ticks: 20 * plan.ticks, tick: plan.tick / 20.0, ..plan };
                let judged = Motion::of(0.0, finer.motion(), finer.tick);
                let judged = judged.judge(&arm, 0.0).expect("a run");
                let off = prediction.torque / judged.torque - 1.0;
                assert!(
                    (prediction.moment / prediction.torque - 1.0).abs() < 1e-5,
                    "{prediction:?}"
                );
                worst = worst.max(off.abs());
            }
        }
    }
    assert!(worst < PREDICTED, "{worst}");
}
