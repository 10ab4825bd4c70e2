//! Time-optimal motions: closed forms, symmetries, limits, and the segments made of them. Durations
//! are held against Ruckig's in the workspace's `tests/`.

use std::f64::consts::TAU;

use proptest::prelude::*;
use stillbeam::hub::HubState;
use stillbeam::motion::optimal::{Bounds, TimeOptimal};
use stillbeam::motion::{MoveSummary, Plan, Segment};
use stillbeam::{Angle, Error, Limits, Move, Profile};

use crate::assert_near;

const BOUNDS: Bounds = Bounds { rate: 2.0, acceleration: 5.0, deceleration: 5.0, jerk: 40.0 };

fn hub(radians: f64, rate: f64, acceleration: f64) -> HubState<f64> {
    HubState { acceleration, ..HubState::turning(Angle::from_radians(radians), rate) }
}

fn rest(radians: f64) -> HubState<f64> {
    hub(radians, 0.0, 0.0)
}

fn reach(start: &HubState<f64>, end: &HubState<f64>, bounds: &Bounds) -> TimeOptimal {
    TimeOptimal::reach(start, end, bounds).expect("reach")
}

fn lay(motion: &TimeOptimal, tick: f64) -> (Vec<Segment<f64>>, MoveSummary) {
    let mut segments = Vec::new();
    let summary = motion.lay(tick, &mut |segment| segments.push(*segment)).expect("lay");
    (segments, summary)
}

/// Reach 100 rad at rate 25, acceleration 4, jerk 3: the ramp takes v/a + a/j, and turns by half of
/// v times that.
#[test]
fn a_ramp_takes_what_it_takes_by_hand() {
    let bounds = Bounds { rate: 25.0, acceleration: 4.0, deceleration: 4.0, jerk: 3.0 };
    let ramp = TimeOptimal::ramp(&rest(0.0), 25.0, &bounds).expect("ramp");
    assert_near("duration", ramp.duration(), 25.0 / 4.0 + 4.0 / 3.0, 1e-12);
    assert_near("angle", ramp.end().angle.radians(), 12.5 * (25.0 / 4.0 + 4.0 / 3.0), 1e-12);
    assert!(ramp.duration() < 7.584 && ramp.end().angle.radians() < 94.8);
    // What is left of 100 rad is turned at the rate reached.
    let whole = reach(&rest(0.0), &hub(100.0, 25.0, 0.0), &bounds);
    let left = (100.0 - ramp.end().angle.radians()) / 25.0;
    assert_near("whole", whole.duration(), ramp.duration() + left, 1e-12);
}

/// With every limit reached, v/a + a/j + D/v; each limit left out in turn.
#[test]
fn rest_to_rest_takes_its_closed_form() {
    let far = reach(&rest(1.0), &rest(-9.0), &BOUNDS).duration();
    assert_near("all limits", far, 2.0 / 5.0 + 5.0 / 40.0 + 10.0 / 2.0, 1e-12);
    // D = a t (t + a/j)... from the area under the rate: D = a (t + a/j)(2 a/j + t).
    let hold = 0.1;
    let near = 5.0 * (hold + 0.125) * (0.25 + hold);
    let time = reach(&rest(0.0), &rest(near), &BOUNDS).duration();
    assert_near("no cruise", time, 2.0 * (0.25 + hold), 1e-12);
    // D = 2 j (T/4)³.
    let time = reach(&rest(0.0), &rest(2.0 * 40.0 * 1e-3), &BOUNDS).duration();
    assert_near("jerk alone", time, 0.4, 1e-12);
    let jumping = Bounds { jerk: f64::INFINITY, ..BOUNDS };
    let time = reach(&rest(0.0), &rest(10.0), &jumping).duration();
    assert_near("trapezoid", time, 2.0 / 5.0 + 5.0, 1e-12);
    let braking = Bounds { deceleration: 10.0, ..jumping };
    let time = reach(&rest(0.0), &rest(-10.0), &braking).duration();
    assert_near("harder braking", time, 0.2 + 0.1 + 5.0, 1e-12);
}

/// A hub that turns too fast to stop in time overshoots and comes back.
#[test]
fn a_hub_overshoots_where_it_must() {
    let motion = reach(&hub(0.0, 2.0, 0.0), &rest(0.1), &BOUNDS);
    let [lowest, highest] = motion.rates();
    assert!(lowest < -0.1 && highest <= 2.0, "{lowest} {highest}");
    let furthest = (0..1000).map(|k| motion.at(motion.duration() * f64::from(k) / 1000.0));
    let furthest = furthest.map(|hub| hub.angle.radians()).fold(0.0, f64::max);
    // It turns back while it still brakes: 2 · 0.125 − 40 · 0.125³/6 until the brake is full, and
    // 1.6875²/10 from there.
    let exact = 0.25 - 40.0 * 0.125f64.powi(3) / 6.0 + 1.6875 * 1.6875 / 10.0;
    assert_near("furthest", furthest, exact, 1e-5);
    let stop = TimeOptimal::ramp(&hub(0.0, 2.0, 0.0), 0.0, &BOUNDS).expect("stop");
    assert_near("stop", stop.end().angle.radians(), 0.525, 1e-12);
}

/// Beyond a limit the hub first comes back within it.
#[test]
fn a_start_beyond_the_limits_comes_back_within() {
    let motion = reach(&hub(0.0, 3.0, 8.0), &rest(5.0), &BOUNDS);
    let times = (0..=2000).map(|k| motion.duration() * f64::from(k) / 2000.0);
    let hubs: Vec<_> = times.map(|t| motion.at(t)).collect();
    let within =
        |hub: &HubState<f64>| hub.rate <= 2.0 + 1e-9 && hub.acceleration.abs() <= 5.0 + 1e-9;
    let first = hubs.iter().position(within).expect("within");
    assert!(hubs[first..].iter().all(within));
    assert!(first > 0 && first < 1500, "{first}");
}

#[test]
fn what_cannot_be_is_refused() {
    let refused =
        |start, end, bounds: Bounds| TimeOptimal::reach(&start, &end, &bounds).unwrap_err();
    let error = refused(rest(0.0), hub(1.0, 2.1, 0.0), BOUNDS);
    assert!(matches!(error, Error::LimitExceeded { parameter: "limits.rate", .. }), "{error}");
    let error = refused(rest(0.0), hub(1.0, 1.0, 6.0), BOUNDS);
    assert!(
        matches!(error, Error::LimitExceeded { parameter: "limits.acceleration", .. }),
        "{error}"
    );
    // Just before it the rate was 1.9 + 4²/80 = 2.1 rad/s.
    let error = refused(rest(0.0), hub(1.0, 1.9, -4.0), BOUNDS);
    assert_eq!(
        error,
        Error::LimitExceeded { parameter: "limits.rate", limit: 2.0, needed: 2.1, unit: "rad/s" }
    );
    let error = refused(hub(0.0, f64::NAN, 0.0), rest(1.0), BOUNDS);
    assert!(matches!(error, Error::OutOfRange { parameter: "hub.rate", .. }), "{error}");
    let slow = Limits { rate: Some(1.0), ..Limits::default() };
    let error = Bounds::new(&slow, 0.01).unwrap_err();
    assert!(matches!(error, Error::OutOfRange { parameter: "limits.acceleration", .. }), "{error}");
    let bounds = Bounds { rate: 1e-6, ..BOUNDS };
    let long = reach(&rest(0.0), &rest(1e3), &bounds).lay::<f64>(0.01, &mut |_| ());
    assert!(matches!(long, Err(Error::OutOfRange { parameter: "move.duration", .. })));
}

/// Ticks from where a motion ends to the nearest one.
fn beside_tick(motion: &TimeOptimal, tick: f64) -> f64 {
    let ticks = motion.duration() / tick;
    ticks - ticks.round()
}

/// A motion that ends within 1e-7 of a tick of one ends at it, and is else the motion itself.
#[test]
fn a_motion_that_all_but_ends_at_a_tick_ends_at_it() {
    let (tick, rate) = (0.01, 1.9288955443815492);
    let start = hub(0.0, 1.85106327837001, -0.7922969193886025);
    let reach_beside = |to: f64| reach(&start, &hub(to, rate, 0.0), &BOUNDS);
    let turned = -1.6369047927911637;
    let beside = beside_tick(&reach_beside(turned), tick);
    for ticks in [-9e-8, -4e-8, 1e-8, 9e-8] {
        // Before the last stretch it turns at full speed, against the sense of `rate`.
        let motion = reach_beside(turned - (ticks - beside) * tick * BOUNDS.rate);
        assert_near("end beside the tick", beside_tick(&motion, tick), ticks, 1e-9);
        let (segments, summary) = lay(&motion, tick);
        assert_eq!((summary.ticks, summary.end.rate), (254, rate));
        assert_near("rounded by", summary.rounded_by, -ticks * tick, 1e-10);
        assert_eq!(summary.end.angle.since(motion.end().angle), 0.0);
        let mut n = 0;
        for segment in &segments {
            for k in 0..segment.count() {
                let (laid, asked) = (segment.hub(k), motion.at(f64::from(n + k) * tick));
                assert_near("angle", TAU * laid.angle.since(asked.angle), 0.0, 1e-12);
                assert_near("rate", laid.rate, asked.rate, 1e-10);
            }
            n += segment.count();
        }
        assert_eq!(n, summary.ticks);
    }
}

/// One that would end a ten-millionth of a tick late is slowed down to the next tick: sped up to
/// end at this one it would pass its limits.
#[test]
fn a_turn_from_rest_to_rest_is_never_sped_up() {
    let (to, tick) = (1.6971130313142715, 0.011640309400706449);
    let motion = reach(&rest(0.0), &rest(to), &BOUNDS);
    assert!((1e-8..1e-6).contains(&beside_tick(&motion, tick)), "{}", beside_tick(&motion, tick));
    let (_, summary) = lay(&motion, tick);
    assert!(summary.rounded_by > 0.9 * tick && summary.peaks.rate < 2.0, "{summary:?}");
}

/// A state within the bounds, that can be kept within them.
fn state() -> impl Strategy<Value = [f64; 2]> {
    (-2.0..2.0_f64, -1.0..1.0_f64).prop_map(|(rate, share)| {
        let spare = 2.0 - rate * share.signum();
        let most = (0.99 * 80.0 * spare).sqrt().min(5.0);
        [rate, share * most]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    /// Mirrored and backwards in time, the shortest motion takes as long.
    #[test]
    fn a_motion_has_its_mirror_image_and_its_reverse(
        [v0, a0] in state(), [v1, a1] in state(), to in -3.0..3.0_f64,
    ) {
        let fits = |v: f64, a: f64| (v - a * a.abs() / 80.0).abs() < 2.0;
        prop_assume!(fits(v1, a1) && fits(v0, a0));
        let motion = reach(&hub(0.0, v0, a0), &hub(to, v1, a1), &BOUNDS);
        let mirror = reach(&hub(0.0, -v0, -a0), &hub(-to, -v1, -a1), &BOUNDS);
        prop_assert_eq!(motion.duration(), mirror.duration());
        prop_assume!(fits(v0, -a0) && fits(v1, -a1));
        let backwards = reach(&hub(0.0, v1, -a1), &hub(to, v0, -a0), &BOUNDS);
        let difference = (motion.duration() - backwards.duration()).abs();
        prop_assert!(difference < 1e-9, "{difference:e}");
    }

    /// Angle, rate and acceleration go on without a step from piece to piece, and to the end.
    #[test]
    fn pieces_join(
        [v0, a0] in state(), v1 in -2.0..2.0_f64, to in -3.0..3.0_f64, uneven in 0.3..3.0_f64,
    ) {
        let bounds = Bounds { deceleration: 5.0 * uneven, ..BOUNDS };
        let motion = reach(&hub(0.0, v0, a0), &hub(to, v1, 0.0), &bounds);
        let mut state = [0.0, v0, a0];
        for piece in motion.pieces() {
            for (now, next) in state.iter().zip(piece.after(0.0)) {
                prop_assert!((now - next).abs() < 1e-9, "{now} {next}");
            }
            state = piece.after(piece.duration);
        }
        for (now, asked) in state.iter().zip([to, v1, 0.0]) {
            prop_assert!((now - asked).abs() < 1e-9, "{now} {asked}");
        }
    }

    /// Between any two ticks the segments turn the hub as the motion does, and tell the stepper
    /// what the borders inside a tick are worth: the excess of ∫(1 − s)θ̈ ds over that of a
    /// parabola with the same mean and ends.
    #[test]
    fn segments_follow_the_motion(
        [v0, a0] in state(), v1 in -2.0..2.0_f64, to in -3.0..3.0_f64, jumps in any::<bool>(),
    ) {
        let tick = 0.01;
        let jerk = if jumps { f64::INFINITY } else { 40.0 };
        let motion = reach(&hub(0.0, v0, a0), &hub(to, v1, 0.0), &Bounds { jerk, ..BOUNDS });
        let (segments, summary) = lay(&motion, tick);
        let mut n = 0;
        let mut end_acceleration = 0.0;
        for segment in segments.iter().filter(|segment| segment.count() > 0) {
            for k in 0..segment.count() {
                let (laid, asked) = (segment.hub(k), motion.at(f64::from(n + k) * tick));
                prop_assert!((laid.angle.since(asked.angle)).abs() < 1e-9);
                prop_assert!((laid.rate - asked.rate).abs() < 1e-7);
            }
            if n > 0 {
                let before = motion.at(f64::from(n - 1) * tick);
                let now = segment.hub(0);
                let turned = TAU * now.angle.since(before.angle);
                let first = (turned - tick * before.rate) / (tick * tick);
                let mean = (now.rate - before.rate) / tick;
                let parabola = mean / 2.0 + (before.acceleration - end_acceleration) / 12.0;
                let kink = first - parabola;
                prop_assert!((segment.kink_moment() - kink).abs() < 1e-5, "{} {kink}", segment.kink_moment());
            } else {
                prop_assert_eq!(segment.kink_moment(), 0.0);
            }
            end_acceleration = segment.end_acceleration();
            n += segment.count();
        }
        prop_assert_eq!(n, summary.ticks);
        let after = f64::from(summary.ticks) * tick;
        prop_assert!((-1e-9..2.0 * tick + 1e-6).contains(&(after - motion.duration())));
        prop_assert!((summary.rounded_by - (after - motion.duration())).abs() < 1e-9);
        prop_assert!(summary.end.angle.since(motion.at(after).angle).abs() < 1e-9);
    }

    /// From rest to rest the motion ends at a tick, at its angle, within the limits.
    #[test]
    fn a_turn_from_rest_to_rest_ends_at_a_tick(to in -3.0..3.0_f64, tick in 0.001..0.02_f64) {
        let motion = reach(&rest(0.0), &rest(to), &BOUNDS);
        let (segments, summary) = lay(&motion, tick);
        prop_assert!(segments.len() <= 7);
        // No turn at all takes a tick.
        let least = if to == 0.0 { tick } else { -1e-9 * tick };
        prop_assert!((least..=tick).contains(&summary.rounded_by), "{}", summary.rounded_by);
        prop_assert_eq!(summary.end, rest(to));
        prop_assert!(summary.peaks.rate <= 2.0 + 1e-9);
        prop_assert!(summary.peaks.acceleration <= 5.0 + 1e-9 && summary.peaks.jerk <= 40.0 + 1e-7);
        let last = segments.last().expect("a segment");
        prop_assert!(last.hub_at(f64::from(last.count())).angle.since(summary.end.angle).abs() < 1e-12);
    }
}

fn planned(motion: Move, start: HubState<f64>, limits: &Limits) -> Result<Plan, Error> {
    Plan::new(&motion, start, limits, 0.01)
}

/// A move in the shortest time keeps the limits that it is held against: its own bounds and the
/// generator's, deceleration apart from acceleration.
#[test]
fn a_reach_is_a_move() {
    let bounds = Bounds { deceleration: 8.0, ..BOUNDS };
    let limits = Limits {
        rate: Some(2.0),
        acceleration: Some(5.0),
        deceleration: Some(8.0),
        jerk: Some(40.0),
        ..Limits::default()
    };
    assert_eq!(Bounds::new(&limits, 0.01), Ok(bounds));
    let motion = Move::Reach { to: 5.0, rate: 0.0, bounds };
    let plan = planned(motion, rest(0.0), &limits).expect("reach");
    assert_eq!(plan.summary.end, rest(5.0));
    // v/a + a/j and v/d + d/j of ramps, the mean of which is also turned at the full rate.
    let (up, down) = (2.0 / 5.0 + 5.0 / 40.0, 2.0 / 8.0 + 8.0 / 40.0);
    let exact: f64 = up + down + (5.0 - up - down) / 2.0;
    assert_eq!(f64::from(plan.summary.ticks), (exact / 0.01).ceil());
    let gentle = Limits { deceleration: Some(7.0), ..limits };
    let error = planned(motion, rest(0.0), &gentle).unwrap_err();
    let Error::LimitExceeded { parameter: "limits.deceleration", needed, .. } = error else {
        panic!("{error}");
    };
    assert_near("deceleration", needed, 8.0, 1e-9);
    // From where another ramp has brought it, and back to rest.
    let ramp = Move::Ramp { rate: -1.5, bounds };
    let turning = planned(ramp, rest(0.0), &limits).expect("ramp").summary;
    assert!(turning.end.rate == -1.5 && turning.end.angle.radians() < 0.0);
    let stop = Move::Ramp { rate: 0.0, bounds };
    let stop = planned(stop, turning.end, &limits).expect("stop").summary;
    assert!(stop.ticks < turning.ticks, "it brakes harder than it speeds up");
    let fast = HubState { rate: 2.5, ..rest(0.0) };
    let error = planned(motion, fast, &limits).unwrap_err();
    assert!(matches!(error, Error::LimitExceeded { parameter: "limits.rate", .. }), "{error}");
    let none = Bounds { acceleration: 0.0, ..bounds };
    let error = planned(Move::Ramp { rate: 1.0, bounds: none }, rest(0.0), &limits).unwrap_err();
    assert!(error.to_string().starts_with("bounds.acceleration = 0: must be"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Every profile from any state has a shortest duration: a tick less does not keep the limits,
    /// and the time-optimal motion is shorter still.
    #[test]
    fn a_pass_has_a_shortest_duration(
        profile in proptest::sample::select(Profile::ALL.to_vec()),
        v0 in -1.0..1.0_f64, v1 in -1.0..1.0_f64, to in -3.0..3.0_f64,
    ) {
        let limits = Limits { rate: Some(2.0), acceleration: Some(5.0), ..Limits::default() };
        let start = HubState::turning(Angle::default(), v0);
        let pass = Move::Pass { profile, duration: 0.0, to, rate: v1 };
        let shortest = Plan::shortest(&pass, start, &limits, 0.01);
        // A turn that is too short for its rates may take a detour that the profile cannot make.
        prop_assume!(shortest.is_ok());
        let shortest = shortest.expect("a duration");
        let less = shortest.lasting(shortest.duration() - 0.01);
        prop_assert!(planned(shortest, start, &limits).is_ok());
        prop_assert!(planned(less, start, &limits).is_err());
        let bounds = Bounds::new(&limits, 0.01).expect("bounds");
        let optimal = reach(&start, &HubState::turning(Angle::from_radians(to), v1), &bounds);
        prop_assert!(optimal.duration() <= shortest.duration() + 1e-9);
    }
}
