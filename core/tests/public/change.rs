use stillbeam::axis::{Axis, Cause, Change, Mode, Policy, StopLimits};
use stillbeam::hub::HubState;
use stillbeam::model::EightElements;
use stillbeam::motion::optimal::Bounds;
use stillbeam::motion::{Spline, Waypoint};
use stillbeam::stepper::Modal;
use stillbeam::{Angle, Error, Limits, Link, Move, Profile, Scene, Setpoint};

const TICK: f64 = 0.01;

type Arm = Axis<Modal<f32, 2>, 8>;

fn limits() -> Limits {
    Limits { rate: Some(6.0), acceleration: Some(60.0), ..Limits::default() }
}

fn axis() -> Arm {
    let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    let model = EightElements::consistent(&scene).expect("model");
    let stepper = Modal::<f32, 2>::new(&model, TICK).expect("stepper");
    let policy = Policy { limits: limits(), stop: StopLimits::OF_MOVES, patience: 0.0, missed: 2 };
    let mut axis = Arm::new(stepper, Angle::default(), policy).expect("axis");
    axis.enable(Angle::default()).expect("on");
    axis
}

fn take(axis: &mut Arm, to: f64, duration: f64) {
    let motion = Move::To { profile: Profile::Quintic, duration, to };
    let planned = axis.plan_context().and_then(|context| context.plan(&motion)).expect("a plan");
    axis.take(&planned).expect("room");
}

/// Ticks on and asserts that angle, rate and acceleration go on within the limits, to f32's
/// rounding. Returns the last setpoint.
fn run(axis: &mut Arm, ticks: usize) -> Setpoint<f32> {
    let mut before = axis.generator().setpoint();
    for _ in 0..ticks {
        let now = axis.tick().setpoint;
        goes_on(&before, &now);
        before = now;
    }
    before
}

/// Asserts that a motion within 60 rad/s² leads from one setpoint to the next.
fn goes_on(before: &Setpoint<f32>, now: &Setpoint<f32>) {
    let turned = f64::from(now.angle.since(before.angle)) * std::f64::consts::TAU;
    let mean = 0.5 * TICK * f64::from(before.rate + now.rate);
    assert!((turned - mean).abs() < 0.25 * 60.0 * TICK * TICK + 1e-6, "{before:?} {now:?}");
    assert!((now.rate - before.rate).abs() < 60.0 * TICK as f32 + 1e-5, "{before:?} {now:?}");
    assert!(now.rate.abs() < 6.001 && now.acceleration.abs() < 60.01, "{now:?}");
}

fn radians(angle: f64) -> Angle<f32> {
    Angle::from_radians(angle).cast()
}

/// A target that moves thirty times a second is met and tracked: its rate is fed forward, so that
/// no lag is left where it turns evenly, and where it swings the lag is of the second order.
#[test]
fn thirty_targets_a_second_are_tracked() {
    let mut axis = axis();
    // 0.8 rad/s, then a swing of 0.5 rad at 0.5 Hz.
    let omega = std::f64::consts::PI;
    let target = |t: f64| {
        if t < 3.0 {
            (0.3 + 0.8 * t, 0.8)
        } else {
            let x = omega * (t - 3.0);
            (2.7 + 0.8 * x.sin() / omega, 0.8 * x.cos())
        }
    };
    let (mut even, mut swing) = (0.0f64, 0.0f64);
    let mut before = axis.tick().setpoint;
    for k in 1..900u32 {
        let t = TICK * f64::from(k - 1);
        // Every 33 ms, so that it never comes in step with the ticks.
        if (f64::from(k) * TICK / 0.033).floor() > (f64::from(k - 1) * TICK / 0.033).floor() {
            let (angle, rate) = target(t);
            // The first has half a second to be reached, the others a tenth.
            let duration = if t < 0.5 { 0.5 } else { 0.1 };
            let change = Change::Target { angle: radians(angle), rate: rate as f32, duration };
            axis.change(&change).expect("within the limits");
        }
        let now = axis.tick().setpoint;
        goes_on(&before, &now);
        before = now;
        let lag = (now.angle.radians() - target(TICK * f64::from(k)).0).abs();
        if (2.0..3.0).contains(&t) {
            even = even.max(lag);
        } else if t > 4.0 {
            swing = swing.max(lag);
        }
    }
    assert!(even < 2e-6, "{even} rad behind a target that turns evenly");
    // ½ θ̈ d² = ½ × 2.5 × 0.1² = 0.0126 rad would be the error of the extrapolation itself.
    assert!(swing < 0.0126, "{swing} rad behind a target that swings");
}

/// A new duration: the move under way ends where it would have, and the move behind it follows.
#[test]
fn a_move_under_way_takes_another_duration() {
    let mut axis = axis();
    assert_eq!(axis.change(&Change::Duration(0.5)), Err(Error::NoMove));
    take(&mut axis, 1.0, 0.6);
    take(&mut axis, 0.4, 0.5);
    run(&mut axis, 21);
    axis.change(&Change::Duration(0.8)).expect("slower");
    let end = run(&mut axis, 80);
    assert_eq!(end.angle, radians(1.0));
    assert_eq!(end.rate, 0.0);
    let next = run(&mut axis, 25);
    assert!((next.angle.radians() - 0.7).abs() < 1e-5, "{next:?}");
    // The second one too, by less than is left.
    axis.change(&Change::Duration(0.2)).expect("faster");
    let end = run(&mut axis, 20);
    assert_eq!(end.angle, radians(0.4));
    assert!(axis.rests());
}

/// Hold brakes where it is and stays enabled; cancel ends the move under way and drops the others.
#[test]
fn hold_and_cancel() {
    let mut axis = axis();
    take(&mut axis, 2.0, 0.8);
    take(&mut axis, 0.0, 0.8);
    run(&mut axis, 30);
    let turning = axis.generator().setpoint();
    axis.change(&Change::Hold).expect("held");
    let held = run(&mut axis, 60);
    assert!(axis.rests() && axis.mode() == Mode::Enabled);
    assert!(held.angle.radians() > turning.angle.radians());
    assert!(held.angle.radians() < 1.9, "{held:?}");

    take(&mut axis, 0.5, 0.8);
    take(&mut axis, 0.0, 0.8);
    run(&mut axis, 10);
    axis.change(&Change::Cancel).expect("cancelled");
    let end = run(&mut axis, 120);
    assert_eq!(end.angle, radians(0.5));
    assert!(axis.rests());
    // Nothing is under way: there is nothing to drop.
    axis.change(&Change::Cancel).expect("cancelled");
    axis.change(&Change::Hold).expect("held");
    assert_eq!(run(&mut axis, 3).angle, radians(0.5));
}

/// A change that cannot be kept is refused, and the motion goes on as it was, to the bit.
#[test]
fn a_refused_change_changes_nothing() {
    let mut axis = axis();
    take(&mut axis, 1.0, 0.6);
    run(&mut axis, 20);
    let untouched = axis.generator().clone();
    let to = |duration| Change::Target { angle: radians(2.0), rate: 0.0, duration };
    assert!(matches!(axis.change(&to(0.1)), Err(Error::LimitExceeded { .. })));
    for duration in [0.0, -1.0, f64::NAN, 1e9] {
        assert!(matches!(axis.change(&to(duration)), Err(Error::OutOfRange { .. })));
    }
    let nowhere = Angle { turns: 0, part: f32::NAN };
    let change = Change::Target { angle: nowhere, rate: 0.0, duration: 1.0 };
    assert!(matches!(axis.change(&change), Err(Error::OutOfRange { .. })));
    let change = Change::Target { angle: radians(1.0), rate: f32::NAN, duration: 1.0 };
    assert!(axis.change(&change).is_err());
    let mut untouched = untouched;
    for _ in 0..60 {
        assert_eq!(axis.tick().setpoint, untouched.tick());
    }
    axis.disable();
    assert!(matches!(axis.change(&Change::Hold), Err(Error::WrongMode { .. })));
}

/// The hub that another program moves, at a tick.
fn given(k: u32) -> HubState<f32> {
    // 1 − cos: from rest, 2.4 rad/s and 12 rad/s² at most.
    let (omega, t) = (5.0, TICK * f64::from(k));
    let angle = Angle::from_radians(0.48 * (1.0 - (omega * t).cos()));
    HubState {
        acceleration: (12.0 * (omega * t).cos()) as f32,
        ..HubState::turning(angle.cast(), (2.4 * (omega * t).sin()) as f32)
    }
}

/// A follower bridges as many silent ticks as the policy allows, and goes on; then it stops along
/// the path within the limits.
#[test]
fn an_axis_that_loses_what_it_follows_stops() {
    let mut axis = axis();
    let mut before = axis.tick().setpoint;
    for k in 1..=40 {
        let state = given(k);
        // Ticks 20 and 21 have none, 30 an impossible one.
        let jump = HubState { rate: state.rate + 5.0, ..state };
        let state = match k {
            20 | 21 => None,
            30 => Some(&jump),
            _ => Some(&state),
        };
        let tick = axis.follow(state);
        goes_on(&before, &tick.setpoint);
        before = tick.setpoint;
        assert_eq!(tick.mode, Mode::Enabled, "tick {k}");
        if !matches!(k, 20 | 21 | 30) {
            assert_eq!(before.angle, given(k).angle, "tick {k}");
        }
    }
    for k in 1..=2 {
        assert_eq!(axis.follow(None).mode, Mode::Enabled, "{k} are allowed");
    }
    before = axis.generator().setpoint();
    let turning = before;
    assert_eq!(axis.follow(None).mode, Mode::Stopping);
    assert_eq!(axis.cause(), Some(Cause::FollowLost));
    goes_on(&before, &axis.generator().setpoint());
    let held = run(&mut axis, 60);
    assert_eq!(axis.mode(), Mode::Stopped);
    let (from, to) = (turning.angle.radians(), held.angle.radians());
    assert!((to - from) * f64::from(turning.rate) > 0.0, "{turning:?} {held:?}");
    // A state is no longer followed.
    assert_eq!(axis.follow(Some(&given(43))).setpoint.angle, held.angle);
    // Nothing that is no number is.
    axis.enable(Angle::default()).expect("on");
    let mut nonsense = *axis.generator().hub();
    nonsense.rate = f32::NAN;
    for _ in 0..2 {
        assert_eq!(axis.follow(Some(&nonsense)).setpoint.angle, held.angle);
    }
    assert_eq!(axis.follow(Some(&nonsense)).mode, Mode::Stopped);
}

/// A path on an axis whose rows stay away ends at rest, within the limits.
#[test]
fn a_path_on_an_axis_ends_at_rest() {
    let mut axis = axis();
    let mut path = axis.path(Spline::Quintic).expect("a path");
    for i in 1..=4u32 {
        let row = Waypoint::at(0.1 * f64::from(i), 0.2 * f64::from(i) - 0.1).turning(2.0);
        path.offer(row).expect("a row");
    }
    assert_eq!(axis.advance(&mut path), Ok(false));
    let last = run(&mut axis, 80);
    // Three rows were taken: the fourth waits for the rate of the next.
    assert!(axis.rests() && axis.mode() == Mode::Enabled);
    assert!(last.angle.radians() > 0.5 && last.angle.radians() < 0.7, "{last:?}");
}

/// The shortest way to an angle from the middle of a move, and to another one behind it: within
/// the limits, without a jump of angle or rate.
#[test]
fn an_axis_reaches_an_angle_in_the_shortest_time() {
    let mut axis = axis();
    take(&mut axis, 2.0, 0.8);
    run(&mut axis, 30);
    let turning = axis.generator().setpoint();
    assert!(turning.rate > 3.0, "{turning:?}");
    let change = Change::Reach { angle: radians(-0.5), rate: 0.0 };
    axis.change(&change).expect("within reach");
    // It brakes in v/A, and then goes back by d in d/V + V/A, by hand; up to three
    // ticks are the end of the last one, one behind it, and the one that holds.
    let (v, a, most) = (f64::from(turning.rate), 60.0, 6.0);
    let back = turning.angle.radians() + 0.5 * v * v / a + 0.5;
    let by_hand = v / a + back / most + most / a;
    let mut ticks = 0;
    while !axis.generator().is_holding() {
        run(&mut axis, 1);
        ticks += 1;
    }
    assert!((f64::from(ticks) * TICK - by_hand).abs() < 3.0 * TICK, "{ticks} ticks, {by_hand} s");
    assert!((axis.generator().setpoint().angle.radians() + 0.5).abs() < 1e-6);
    // Behind a queue, by the generator itself; to pass an angle at a rate.
    let mut arm = axis.generator().clone();
    let bounds = Bounds::new(&limits(), TICK).expect("bounds");
    let first = arm.push(&Move::Reach { to: 0.3, rate: 0.0, bounds }).expect("room");
    let second = arm.push(&Move::Reach { to: 1.0, rate: 2.0, bounds }).expect("room");
    let mut before = arm.setpoint();
    for _ in 0..first.ticks + second.ticks + 1 {
        let now = arm.tick();
        goes_on(&before, &now);
        before = now;
    }
    let after = before.angle.radians() - 1.0;
    // It passes the angle inside a tick, and is at most two behind it.
    assert!(before.rate == 2.0 && after > -1e-6 && after < 2.0 * 2.0 * TICK + 1e-6, "{before:?}");
}
