//! A stop at any tick of any move: along the path, within the limits, then rest.

use proptest::prelude::*;
use stillbeam::axis::{Axis, Cause, Change, Mode, Policy, StopLimits, Tick};
use stillbeam::{Limits, Move, Profile};
use stillbeam_tests::assert_near;

use super::common::{
    Arm, LIMITS, POLICY, TICK, ask, assert_continuous, enabled, run, stepper, to, turns,
};

/// Stops after `ticks` ticks of the moves and runs on; checks everything a stop promises.
fn stopped(mut axis: Arm, moves: &[Move], ticks: u32, limits: &Limits) -> (Arm, u32) {
    for motion in moves {
        ask(&mut axis, motion).expect("the move is within the limits");
    }
    let mut all = run(&mut axis, ticks);
    let before = all.last().expect("at least one tick").setpoint;
    axis.stop(Cause::Requested);
    all.extend(run(&mut axis, 400));
    assert_continuous(&all, limits);
    assert_eq!(axis.mode(), Mode::Stopped);
    let last = all.last().unwrap().setpoint;
    assert_eq!((last.rate, last.acceleration), (0.0, 0.0));
    // Never back: rates keep their sign or are zero.
    for tick in &all[ticks as usize..] {
        assert!(tick.setpoint.rate * before.rate >= 0.0, "turns back at tick {}", tick.number);
    }
    let taken = all[ticks as usize..].iter().take_while(|t| t.setpoint.rate != 0.0).count() as u32;
    (axis, taken)
}

fn policy(limits: Limits) -> Policy {
    Policy { limits, ..POLICY }
}

#[test]
fn every_tick_of_every_profile_can_be_stopped() {
    for profile in Profile::ALL {
        for ticks in 1..=62 {
            let motion = to(profile, 0.6, 2.2);
            let moves = [motion, to(Profile::Cubic, 0.9, 0.5)];
            let (axis, _) = stopped(enabled(POLICY), &moves, ticks, &LIMITS);
            let angle = axis.generator().hub().angle.radians();
            let start = 0.2 * std::f64::consts::TAU;
            assert!(
                start - 1e-6 <= angle && angle <= 2.2 + 1e-6,
                "{profile:?} at {ticks}: {angle}"
            );
        }
    }
}

#[test]
fn a_stop_is_as_short_as_the_acceleration_allows() {
    // A cruise of 4 rad/s: T = 1.5 v/A = 0.15 s.
    let spin = Move::SpinUp { duration: 0.5, rate: 4.0 };
    let (_, taken) = stopped(enabled(POLICY), &[spin], 80, &LIMITS);
    assert_eq!(taken, 14, "setpoints on the way between tick 0 and 15 of the stop");
}

#[test]
fn random_moves_and_limits_are_stopped_within_the_limits() {
    let profiles = prop::sample::select(Profile::ALL.to_vec());
    proptest!(ProptestConfig::with_cases(600), |(
        profile in profiles,
        duration in 0.05f64..1.5,
        angle in -3.0f64..3.0,
        slack in 1.0f64..1.5,
        share in 0.0f64..1.1,
    )| {
        let delta = angle - 0.2 * std::f64::consts::TAU;
        let ticks = (duration / TICK).round().max(1.0);
        let peaks = profile.peaks(delta, ticks * TICK);
        prop_assume!(peaks.rate > 1e-3 && peaks.rate < 90.0);
        // The tightest limits that accept the move, and half as much again.
        let limits = Limits {
            rate: Some(peaks.rate * slack),
            acceleration: Some(peaks.acceleration * slack),
            ..Limits::default()
        };
        let after = 1 + (share * ticks) as u32;
        stopped(enabled(policy(limits)), &[to(profile, duration, angle)], after, &limits);
    });
}

#[test]
fn spins_are_stopped_in_either_direction() {
    proptest!(ProptestConfig::with_cases(200), |(
        rate in -5.9f64..5.9,
        then in -5.9f64..5.9,
        ticks in 1u32..220,
    )| {
        prop_assume!(rate.abs() > 0.01);
        let moves = [
            Move::SpinUp { duration: 0.8, rate },
            Move::SpinUp { duration: 0.8, rate: then },
        ];
        // A change of sign passes through zero within the move.
        prop_assume!(rate * then > 0.0);
        stopped(enabled(POLICY), &moves, ticks, &LIMITS);
    });
}

#[test]
fn a_limit_of_jerk_stretches_the_stop() {
    let limits = Limits { jerk: Some(200.0), ..LIMITS };
    let spin = Move::SpinUp { duration: 1.5, rate: 4.0 };
    let (_, smooth) = stopped(enabled(policy(limits)), &[spin], 180, &limits);
    // 6v/T² ≤ J: T ≥ 0.346 s.
    assert!((34..=45).contains(&smooth), "{smooth} ticks");
}

/// A stop near the end of a move lets it arrive; what waits behind it is dropped.
#[test]
fn a_move_that_ends_first_is_finished() {
    let profile = Profile::Trapezoid;
    let limits = Limits { acceleration: Some(12.0), ..LIMITS };
    let delta = 2.2 - 0.2 * std::f64::consts::TAU;
    assert!(profile.peaks(delta, 0.6).acceleration < 12.0);
    let moves = [to(profile, 0.6, 2.2), to(profile, 0.9, 0.5)];
    let (axis, taken) = stopped(enabled(policy(limits)), &moves, 50, &limits);
    assert_near("angle", axis.generator().hub().angle.radians(), 2.2, 1e-6);
    assert_eq!(taken, 60 - 50, "the move's own last ticks");
}

#[test]
fn a_stop_at_rest_drops_what_waits_and_moves_nothing() {
    let mut axis = enabled(POLICY);
    let held = run(&mut axis, 3).pop().unwrap().setpoint;
    ask(&mut axis, &to(Profile::Cubic, 0.6, 2.0)).unwrap();
    axis.stop(Cause::Requested);
    assert_eq!((axis.mode(), axis.cause()), (Mode::Stopped, Some(Cause::Requested)));
    assert!(run(&mut axis, 100).iter().all(|tick| tick.setpoint.angle == held.angle));
}

#[test]
fn a_stop_needs_a_limit_of_acceleration() {
    let limits = Limits::default();
    let error = stillbeam::motion::Braking::<f32>::new(&limits, TICK).unwrap_err().to_string();
    assert_eq!(error, "limits.acceleration = inf: must be 0.000000001 to 1000000000000 rad/s^2");
}

/// Greatest deceleration and jerk of a stop between its ticks, rad/s² and rad/s³. Its rate is one
/// cubic, which rates and accelerations at two ticks determine.
fn peaks_between(stop: &[Tick<f32>]) -> [f64; 2] {
    let mut most = [0.0_f64; 2];
    for pair in stop.windows(2) {
        let [a, b] = [pair[0].setpoint, pair[1].setpoint];
        let [v0, v1] = [a.rate, b.rate].map(|rate| f64::from(rate) / TICK);
        let [a0, a1] = [a.acceleration, b.acceleration].map(f64::from);
        // a(s) = a₀ + 2c₂s + 3c₃s², s = 0..1 over the tick.
        let (c2, c3) = (3.0 * (v1 - v0) - 2.0 * a0 - a1, a0 + a1 - 2.0 * (v1 - v0));
        let sign = if v0 + v1 < 0.0 { -1.0 } else { 1.0 };
        for i in 0..=16 {
            let s = f64::from(i) / 16.0;
            most[0] = most[0].max(-sign * (a0 + s * (2.0 * c2 + 3.0 * s * c3)));
            most[1] = most[1].max(((2.0 * c2 + 6.0 * s * c3) / TICK).abs());
        }
    }
    most
}

fn with_stop(limits: Limits, deceleration: Option<f64>, jerk: Option<f64>) -> Policy {
    Policy { stop: StopLimits { deceleration, jerk }, ..policy(limits) }
}

/// A stop with limits of its own is harder than a move, and harder than a change of mind.
#[test]
fn a_stop_may_be_harder_than_a_move() {
    let spin = Move::SpinUp { duration: 0.5, rate: 4.0 };
    let harder = Limits { acceleration: Some(120.0), ..LIMITS };
    let (_, taken) = stopped(enabled(with_stop(LIMITS, Some(120.0), None)), &[spin], 80, &harder);
    assert_eq!(taken, 4, "T = 1.5 v/A = 0.05 s");
    let mut axis = enabled(with_stop(LIMITS, Some(120.0), None));
    ask(&mut axis, &spin).expect("a move");
    run(&mut axis, 80);
    axis.change(&Change::Hold).expect("enabled");
    let held = run(&mut axis, 40);
    let taken = held.iter().take_while(|tick| tick.setpoint.rate != 0.0).count();
    assert_eq!(taken, 14, "a hold brakes as a move does");
    // A jerk of its own, above that of the moves: 6v/T² ≤ J, T ≥ 0.11 s in place of 0.35 s.
    let smooth = Limits { jerk: Some(200.0), ..LIMITS };
    let spin = Move::SpinUp { duration: 1.5, rate: 4.0 };
    let policy = with_stop(smooth, Some(120.0), Some(2000.0));
    let (_, taken) = stopped(enabled(policy), &[spin], 180, &harder);
    assert!((10..=14).contains(&taken), "{taken} ticks");
}

#[test]
fn a_stop_is_no_softer_than_a_move() {
    let refused = |limits: Limits, deceleration: f64, jerk: Option<f64>| {
        let policy = with_stop(limits, Some(deceleration), jerk);
        Axis::<_, 8>::new(stepper(0.03), turns(0.2), policy)
            .map(|_: Arm| ())
            .unwrap_err()
            .to_string()
    };
    let error = refused(LIMITS, 39.0, None);
    assert!(error.starts_with("policy.stop.deceleration = 39: must be 40 to"), "{error}");
    let gentle = Limits { deceleration: Some(30.0), ..LIMITS };
    let error = refused(gentle, 29.0, None);
    assert!(error.starts_with("policy.stop.deceleration = 29: must be 30 to"), "{error}");
    for bad in [f64::NAN, f64::INFINITY] {
        let error = refused(LIMITS, bad, None);
        assert!(error.starts_with("policy.stop.deceleration = "), "{error}");
    }
    let error = refused(LIMITS, 40.0, Some(0.0));
    assert!(error.starts_with("policy.stop.jerk = 0: must be"), "{error}");
}

/// Deceleration and jerk of a stop hold between its ticks too, at any tick of a move that speeds up
/// by more or by less than the stop slows down. Where the acceleration that the hub has is above
/// twice the limit it is dropped at once, and the jerk with it.
#[test]
fn a_stop_keeps_its_own_limits_between_the_ticks() {
    proptest!(ProptestConfig::with_cases(400), |(
        rate in 0.5f64..6.0,
        duration in 0.3f64..1.5,
        share in 0.02f64..1.3,
        softer in 0.3f64..1.5,
        harder in 1.0f64..5.0,
        jerk in proptest::option::of(50.0f64..5000.0),
        back in any::<bool>(),
    )| {
        let rate = if back { -rate } else { rate };
        let steepest = 2.0 * rate.abs() / (duration / TICK).round() / TICK;
        let limits = Limits {
            rate: Some(rate.abs()),
            acceleration: Some(1.001 * steepest),
            ..Limits::default()
        };
        let deceleration = softer * steepest;
        // The spin-up only speeds up: the axis with the softer limit takes its plan.
        let mut axis = enabled(with_stop(limits, None, None));
        let soft = Limits { deceleration: Some(deceleration), ..limits };
        let spin = Move::SpinUp { duration, rate };
        let planned = axis.plan_context().unwrap().plan(&spin).unwrap();
        let own = harder * deceleration;
        axis = enabled(with_stop(soft, Some(own), jerk));
        axis.take(&planned).unwrap();
        let before = run(&mut axis, 1 + (share * duration / TICK) as u32);
        let last = before.last().unwrap().setpoint;
        prop_assume!(last.rate.abs() > 0.01);
        axis.stop(Cause::Requested);
        // The acceleration with which the stop begins is that of the latest setpoint now.
        let mut first = *before.last().unwrap();
        first.setpoint = axis.generator().setpoint();
        let mut stop = vec![first];
        while axis.mode() == Mode::Stopping {
            stop.extend(run(&mut axis, 1));
        }
        prop_assert_eq!(stop.last().unwrap().setpoint.rate, 0.0);
        let [hardest, steepest_jerk] = peaks_between(&stop);
        // Two ticks are the least: a slow hub brakes in them, whatever the limit.
        prop_assert!(hardest <= 1.01 * own + 0.02 || stop.len() <= 4, "{hardest} {own}");
        if let Some(jerk) = jerk {
            let begins = f64::from(stop[0].setpoint.acceleration - last.acceleration);
            prop_assert!(steepest_jerk <= 1.02 * jerk + 5.0, "{steepest_jerk} {jerk} {begins}");
        }
        for pair in stop.windows(2) {
            prop_assert!(pair[1].setpoint.rate.abs() <= rate.abs() as f32 * 1.001);
        }
    });
}
