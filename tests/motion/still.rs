//! Moves that arrive still: what is left in the reference rod, limits, robustness, changing course.

use std::f64::consts::PI;

use stillbeam::hub::Angle;
use stillbeam::model::Rod;
use stillbeam::planner::{Kinematics, Planner, Request, StillMove, Target};
use stillbeam::stepper::{ArmState, Elastica, Quality};
use stillbeam::{Error, Generator, HubState, Limits, Link, Move, Profile, Scene};
use stillbeam_sim::plan::judge::Motion;
use stillbeam_sim::scenes;

const TICK: f64 = 0.01;

fn member_a() -> Scene {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.00952, bending_stiffness: 0.0213344 });
    scene.payload.mass = 0.03;
    scene
}

fn member_d() -> Scene {
    Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 })
}

/// A move from 0 to π rad in `duration` s, whatever the arm deflects by.
fn half_turn<T>(duration: f64) -> Request<T, 2> {
    Request::from_rest(0.0, PI).duration(duration).any_deflection()
}

/// Residual in the reference rod, of L, the arm's frequency off by `error`.
fn residual(arm: &Scene, plan: &StillMove, from: f64, error: f64) -> f64 {
    Motion::of(from, plan.motion(), plan.tick).judge(arm, error).expect("a run").residual
}

#[test]
fn nothing_is_left_of_a_half_turn() {
    for (arm, bounds) in [
        (member_a(), [(1.0, 0.0015), (1.5, 0.0003), (2.0, 0.0001), (3.0, 0.00005)]),
        (member_d(), [(1.0, 0.012), (1.5, 0.002), (2.0, 0.0005), (3.0, 0.0001)]),
    ] {
        let planner = Planner::<f32, 2>::new(&arm, TICK).expect("planner");
        for (ratio, bound) in bounds {
            let plan = planner.plan(&half_turn(ratio * planner.first_period())).expect("plan");
            let left = residual(&arm, &plan, 0.0, 0.0);
            assert!(left < bound, "{ratio} first periods: {left}");
            assert!(plan.simulations <= 60, "{plan:?}");
        }
    }
}

/// Members B, C and D with 30 g, in one first period.
#[test]
fn little_is_left_of_a_half_turn_in_one_period() {
    for name in ["b-tip30", "c-tip30", "d-tip30", "b-tip30-damped-hub"] {
        let arm = scenes::open(name).expect("a scene").arm;
        let planner = Planner::<f32, 2>::new(&arm, TICK).expect("planner");
        let plan = planner.plan(&half_turn(planner.first_period())).expect("plan");
        let left = residual(&arm, &plan, 0.0, 0.0);
        assert!(left < 0.0015, "{name}: {left}");
    }
}

/// Where the second mode is left ringing it is looked after too, for at most half as much again of
/// acceleration.
#[test]
fn the_second_mode_is_brought_to_rest_where_it_rings() {
    let arm = member_d();
    let planner = Planner::<f32, 2>::new(&arm, TICK).expect("planner");
    let duration = 1.5 * planner.first_period();
    let plan = planner.plan(&half_turn(duration)).expect("plan");
    // Acceleration limited to what the first mode alone needs: the second goes on ringing.
    let scaled = |plan: &StillMove| plan.peaks.acceleration * duration * duration / PI;
    let limits = Limits { acceleration: Some(0.9 * plan.peaks.acceleration), ..Limits::default() };
    let spared = planner.plan(&half_turn(duration).limits(limits)).expect("plan");
    assert!(scaled(&plan) < 1.5 * scaled(&spared), "{} {}", scaled(&plan), scaled(&spared));
    let [quiet, rings] = [plan, spared].map(|plan| residual(&arm, &plan, 0.0, 0.0));
    assert!(quiet < 0.001 && rings > 1.5 * quiet, "{quiet} {rings}");
}

/// A hub that must not turn fast, an arm that rings: the way to a far target begins with a stop,
/// and a stop alone is a move of its own.
#[test]
fn a_course_may_begin_with_a_stop() {
    let arm = member_a();
    let planner = Planner::<f32, 2>::new(&arm, TICK).expect("planner");
    let flex = ArmState { coordinate: [0.004, 0.0], rate: [0.02, 0.0] };
    let from = HubState { rate: 0.15, ..HubState::at_rest(Angle::from_radians(0.3)) };
    let limits = Limits { rate: Some(0.4), acceleration: Some(1.5), ..Limits::default() };
    let request = Request::from_hub(from, Target::Angle(3.0)).arm(flex).limits(limits);
    let course = planner.plan_by_stop(&request).expect("a stop and a move");
    let then = course.then.expect("by way of a rest");
    assert_eq!(then.from, HubState::at_rest(Angle::from_radians(course.first.to)));
    let left = course.predict(&planner, Some(&flex)).residual;
    assert!((then.to - 3.0).abs() < 1e-12 && left < 0.002 * 0.4, "{course:?}");
    let stop = planner.plan(&request.target(Target::Stop)).expect("a stop");
    let left = planner.predict(&stop, Some(&flex)).residual;
    assert!((stop.to - 0.3).abs() < 1.0 && left < 0.002 * 0.4, "{stop:?}");
    for plan in [course.first, then, stop] {
        limits.admit(&plan.peaks).expect("kept");
    }
    // Without a limit one move does.
    let free = planner.plan_by_stop(&request.limits(Limits::default())).expect("a move");
    assert!(free.then.is_none());
}

#[test]
fn damping_gravity_hub_and_payload_inertia_are_included() {
    let mut arm = member_a();
    arm.damping.alpha = 0.15;
    arm.damping.beta = 0.004;
    arm.hub.radius = 0.05;
    arm.payload.inertia = 1e-5;
    arm.gravity = 1.0;
    let planner = Planner::<f32, 2>::new(&arm, TICK).expect("planner");
    for ratio in [1.5, 2.0, 3.0] {
        let request = Request::from_rest(-0.7, 1.9).duration(ratio * planner.first_period());
        let plan = planner.plan(&request.any_deflection()).expect("plan");
        let left = residual(&arm, &plan, -0.7, 0.0);
        assert!(left < 0.0005, "{ratio} first periods: {left}");
    }
}

/// The correction is what makes it still: without it far more is left.
#[test]
fn the_linear_move_is_worse() {
    let arm = member_a();
    let planner = Planner::<f32, 2>::new(&arm, TICK).expect("planner");
    let duration = 1.5 * planner.first_period();
    let linear = planner.plan(&half_turn(duration).kinematics(Kinematics::Linear)).expect("plan");
    let plan = planner.plan(&half_turn(duration)).expect("plan");
    let [linear, still] = [linear, plan].map(|plan| residual(&arm, &plan, 0.0, 0.0));
    assert!(linear > 0.02 && still < 0.02 * linear, "{linear} {still}");
}

/// Within a fifth of its frequency the arm keeps less than after any shaper, at two first periods.
#[test]
fn a_robust_move_stays_still_across_its_band() {
    let arm = member_a();
    let planner = Planner::<f32, 2>::robust(&arm, TICK, 0.2).expect("planner");
    let plan = planner.plan(&half_turn(2.0 * planner.first_period())).expect("plan");
    let most = [-0.2, -0.1, 0.0, 0.1, 0.2].map(|error| residual(&arm, &plan, 0.0, error));
    assert!(most.iter().all(|&left| left < 0.065), "{most:?}");
    let scaled = plan.peaks.acceleration * plan.duration() * plan.duration() / PI;
    assert!(scaled < 10.0, "{scaled}");
}

/// Where three arms are nearly one and the time is short, the outer two are brought to rest.
#[test]
fn a_narrow_band_in_a_short_time_is_planned_for_two_arms() {
    let arm = member_a();
    let planner = Planner::<f32, 2>::robust(&arm, TICK, 0.05).expect("planner");
    let plan = planner.plan(&half_turn(1.5 * planner.first_period())).expect("plan");
    let left = [-0.04, 0.0, 0.04].map(|error| residual(&arm, &plan, 0.0, error));
    assert!(left[0] < 1e-3 && left[2] < 1e-3 && left[1] < 0.015, "{left:?}");
    assert!((plan.residual - left[1]).abs() < 1e-4, "{} {left:?}", plan.residual);
}

/// An angle meant in degrees: refused in words, not in a number that is none.
#[test]
fn a_move_that_no_arm_can_make_is_refused_in_words() {
    let planner = Planner::<f32, 2>::new(&member_a(), TICK).expect("planner");
    let far = Request::from_rest(0.0, 180.0).duration(1.7).any_deflection();
    let refused = planner.plan(&far).expect_err("too far").to_string();
    assert!(refused.contains("use ") && !refused.contains("NaN"), "{refused}");
}

/// The shortest move keeps every limit at every tick, and a tick less would exceed one.
#[test]
fn the_shortest_move_keeps_the_limits() {
    let arm = member_d();
    let planner = Planner::<f32, 2>::new(&arm, TICK).expect("planner");
    for limits in [
        Limits { acceleration: Some(300.0), ..Limits::default() },
        Limits { rate: Some(20.0), acceleration: Some(500.0), ..Limits::default() },
        Limits { jerk: Some(15_000.0), ..Limits::default() },
        Limits { torque: Some(0.4), ..Limits::default() },
        Limits { moment: Some(0.4), ..Limits::default() },
    ] {
        let request = Request::from_rest(0.0, PI).limits(limits);
        let plan = planner.plan(&request).expect("plan");
        limits.admit(&plan.peaks).expect("kept");
        planner.predict(&plan, None).admit(&limits, 0.4).expect("kept");
        let judged = Motion::of(0.0, plan.motion(), TICK).judge(&arm, 0.0).expect("a run");
        let kept = |value: f64, limit: Option<f64>, room: f64| {
            assert!(limit.is_none_or(|limit| value <= room * limit), "{value} {limits:?}");
        };
        kept(judged.rate, limits.rate, 1.0 + 1e-4);
        kept(judged.acceleration, limits.acceleration, 1.0 + 1e-4);
        // The planner's two modes against the rod's seven polynomials.
        kept(judged.torque, limits.torque, 1.02);
        assert!(judged.residual < 0.001, "{}", judged.residual);
        let longer = f64::from(plan.ticks - 1) * TICK;
        let before = planner.plan(&half_turn(longer)).expect("plan");
        let less =
            limits.admit(&before.peaks).and(planner.predict(&before, None).admit(&limits, 0.4));
        assert!(less.is_err(), "{limits:?}: {} ticks would do", plan.ticks - 1);
    }
}

#[test]
fn refusals_name_their_reason() {
    let mut arm = member_a();
    let planner = Planner::<f32, 2>::new(&arm, TICK).expect("planner");
    let short = planner.plan(&half_turn(0.5)).expect_err("too short");
    assert!(matches!(short, Error::TooShort { .. }), "{short}");
    assert!(short.to_string().contains("0.9 first periods"), "{short}");
    arm.gravity = 2.0;
    let planner = Planner::<f32, 2>::new(&arm, TICK).expect("planner");
    // Less than the arm's own weight: no duration helps.
    let limits = Limits { torque: Some(0.005), ..Limits::default() };
    let weak = planner.plan(&Request::from_rest(0.0, 1.0).limits(limits)).expect_err("too weak");
    assert!(weak.to_string().contains("limits.torque"), "{weak}");
    assert!(Planner::<f32, 2>::robust(&arm, TICK, 0.5).is_err());
}

/// In the middle of a move, and with the arm ringing after it: another target from a coming tick
/// on, without a jump, and still at the end.
#[test]
fn a_course_can_be_changed_at_any_tick() {
    let arm = member_d();
    let rod = Rod::<2>::new(&arm).expect("rod");
    let planner = Planner::<f32, 2>::new(&arm, TICK).expect("planner");
    for when in [1, 7, 12, 19, 24, 31] {
        let stepper = Elastica::<f32, 2>::new(&rod, TICK, Quality::Fine, 0.7).expect("stepper");
        let mut generator = Generator::<_, 8>::new(stepper, 0.0).expect("generator");
        generator
            .push(&Move::To { profile: Profile::Cubic, duration: 0.25, to: 1.5 })
            .expect("move");
        for _ in 0..=when {
            generator.tick();
        }
        let mut ahead = generator.clone();
        for _ in 0..4 {
            ahead.tick();
        }
        let from = ahead.hub().precise();
        let flex = ahead.stepper().arm_state(ahead.state(), ahead.hub());
        let request = Request::from_hub(from, Target::Angle(-0.5)).arm(flex).duration(0.3);
        let plan = planner.plan(&request.any_deflection()).expect("plan");
        // A tick early the hub is elsewhere, if it turns.
        if from.rate != 0.0 {
            let early = generator.redirect(2, &plan);
            assert!(matches!(early, Err(Error::Elsewhere { .. })), "{early:?}");
        }
        generator.redirect(3, &plan).expect("a new course");
        for _ in 0..4 {
            generator.tick();
        }
        let hub = *generator.hub();
        assert!((f64::from(hub.rate) - from.rate).abs() < 1e-4 * plan.peaks.rate, "{when}");
        let off = (f64::from(hub.acceleration) - from.acceleration).abs();
        assert!(off < 1e-4 * plan.peaks.acceleration, "{when}: {off}");
        for _ in 0..plan.ticks {
            generator.tick();
        }
        assert!((generator.setpoint().angle.radians() + 0.5).abs() < 1e-6);
        let left = (0..12).map(|_| generator.tick().deflection().abs()).fold(0.0, f32::max);
        // The cubic's jumps have left the second mode ringing, which no plan looks after.
        assert!(left < 0.005 * 0.4, "{when}: {left}");
    }
}

/// A measured state is taken over as it is.
#[test]
fn a_measured_state_is_accepted() {
    let arm = member_d();
    let rod = Rod::<2>::new(&arm).expect("rod");
    let stepper = Elastica::<f64, 2>::new(&rod, TICK, Quality::Fine, 0.5).expect("stepper");
    let mut generator = Generator::<_, 8>::new(stepper, 0.3).expect("generator");
    generator.tick();
    let flex = ArmState { coordinate: [0.004, 0.0], rate: [-0.2, 0.0] };
    let hub = *generator.hub();
    generator.set_state(generator.stepper().state_of(&flex, &hub));
    let back = generator.stepper().arm_state(generator.state(), &hub);
    for k in 0..2 {
        assert!((back.coordinate[k] - flex.coordinate[k]).abs() < 1e-12);
        assert!((back.rate[k] - flex.rate[k]).abs() < 1e-9, "{back:?}");
    }
    // It rings on with that amplitude, and a plan from it brings it to rest.
    let planner = Planner::<f64, 2>::new(&arm, TICK).expect("planner");
    let request = Request::from_hub(hub.precise(), Target::Angle(1.0)).arm(flex).duration(0.2);
    let plan = planner.plan(&request.any_deflection()).expect("plan");
    assert!(planner.predict(&plan, Some(&flex)).residual < 0.002 * 0.4);
    assert!(planner.predict(&plan, None).residual > 0.005 * 0.4);
}
