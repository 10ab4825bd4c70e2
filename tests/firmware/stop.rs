//! A stop at any tick of any move: along the path, within the limits, then rest.

use proptest::prelude::*;
use stillbeam::axis::{Cause, Mode, Policy};
use stillbeam::{Limits, Move, Profile};
use stillbeam_tests::assert_near;

use super::common::{Arm, LIMITS, POLICY, TICK, ask, assert_continuous, enabled, run, to};

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
