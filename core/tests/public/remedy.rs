//! The duration that a remedy names keeps the limits, and a tick less does not.

use proptest::prelude::*;
use stillbeam::hub::Angle;
use stillbeam::motion::Plan;
use stillbeam::{HubState, Limits, Move, Profile, Remedy};

fn start(rate: f64) -> HubState<f64> {
    HubState::turning(Angle::from_radians(-0.2), rate)
}

/// The duration that a remedy prints, as a reader would type it.
fn printed(remedy: &Remedy) -> f64 {
    let text = remedy.to_string();
    let words = text.split("a duration of ").nth(1).unwrap_or_else(|| panic!("{text}"));
    words.split(" s fits").next().expect("a number").parse().expect("a number")
}

/// Refused moves name the shortest duration that fits.
fn assert_mended(motion: Move, start: HubState<f64>, limits: &Limits, tick: f64) {
    if Plan::new(&motion, start, limits, tick).is_ok() {
        return;
    }
    let remedy = Plan::remedy(&motion, start, limits, tick);
    let duration = printed(&remedy);
    let ticks = motion.lasting(duration).ticks(tick).expect("ticks");
    let plan = |ticks: u32| {
        Plan::new(&motion.lasting(f64::from(ticks) * tick), start, limits, tick).is_ok()
    };
    assert!(Plan::new(&motion.lasting(duration), start, limits, tick).is_ok(), "{remedy}");
    assert!(ticks < 2 || !plan(ticks - 1), "{remedy}: a tick less fits too");
    let digits = duration.to_string();
    assert!(digits.len() < 14, "{digits} in {remedy}");
}

/// The move in its shortest duration is taken, and a tick less is not.
fn assert_shortest(motion: Move, start: HubState<f64>, limits: &Limits, tick: f64) {
    let fits = |ticks: u32| {
        Plan::new(&motion.lasting(f64::from(ticks) * tick), start, limits, tick).is_ok()
    };
    match Plan::shortest(&motion, start, limits, tick) {
        Ok(shortest) => {
            let ticks = shortest.ticks(tick).expect("ticks");
            assert!(fits(ticks) && (ticks == 1 || !fits(ticks - 1)), "{shortest}");
            assert_eq!(shortest, motion.lasting(shortest.duration()));
        }
        Err(error) => {
            let remedy = Plan::remedy(&motion, start, limits, tick);
            let none = *limits == Limits::default();
            assert!(none || !matches!(remedy, Remedy::Duration(_)), "{error}; {remedy}");
            assert!(none || !fits(1 << 24), "{error}");
        }
    }
}

fn limit() -> impl Strategy<Value = Option<f64>> {
    proptest::option::of((-1.0..3.0_f64).prop_map(|power| 10_f64.powf(power)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_turn_in_the_time_that_is_named_keeps_every_limit(
        profile in proptest::sample::select(Profile::ALL.to_vec()),
        tick in proptest::sample::select(vec![0.002, 0.005, 0.01]),
        to in -6.0..6.0,
        rate in limit(),
        acceleration in limit(),
        deceleration in limit(),
        jerk in limit(),
        duration in 0.01..2.0,
    ) {
        let jumps = matches!(profile, Profile::Cubic | Profile::Trapezoid);
        let limits = Limits { rate, acceleration, deceleration, jerk, ..Limits::default() };
        let motion = Move::To { profile, duration, to };
        assert_shortest(motion, start(0.0), &limits, tick);
        if jumps && jerk.is_some() {
            Plan::new(&motion, start(0.0), &limits, tick).expect_err("a jump");
            let remedy = Plan::remedy(&motion, start(0.0), &limits, tick);
            prop_assert_eq!(remedy, Remedy::Smoother);
        } else {
            assert_mended(motion, start(0.0), &limits, tick);
        }
    }

    #[test]
    fn a_spin_up_in_the_time_that_is_named_keeps_every_limit(
        tick in proptest::sample::select(vec![0.002, 0.005, 0.01]),
        turning in -6.0..6.0,
        rate in -6.0..6.0,
        acceleration in limit(),
        deceleration in limit(),
        jerk in limit(),
        duration in 0.01..2.0,
    ) {
        let rate_limit = Some(6.0);
        let limits =
            Limits { rate: rate_limit, acceleration, deceleration, jerk, ..Limits::default() };
        assert_mended(Move::SpinUp { duration, rate }, start(turning), &limits, tick);
        assert_shortest(Move::SpinUp { duration, rate }, start(turning), &limits, tick);
    }
}

/// Half as long to slow down as to speed up, where the deceleration may be twice as high.
#[test]
fn a_spin_down_keeps_the_limit_of_deceleration() {
    let (acceleration, deceleration) = (Some(4.0), Some(8.0));
    let limits = Limits { acceleration, deceleration, ..Limits::default() };
    let shortest = |from: f64, to: f64| {
        let motion = Move::SpinUp { duration: 1.0, rate: to };
        Plan::shortest(&motion, start(from), &limits, 0.001).expect("shortest").duration()
    };
    // 2Δω/T.
    assert_eq!([shortest(0.0, 3.0), shortest(3.0, 0.0)], [1.5, 0.75]);
    assert_eq!(shortest(-1.0, 2.0), 1.5, "it slows down and speeds up");
    let turn = Move::To { profile: Profile::Trapezoid, duration: 1.0, to: 1.6 };
    let turn = Plan::shortest(&turn, start(0.0), &limits, 0.001).expect("shortest");
    assert_eq!(turn.duration(), 1.424, "√(4.5 · 1.8 / 4) s");
    let error = Plan::shortest(&turn, start(0.0), &Limits::default(), 0.001).unwrap_err();
    assert!(error.to_string().starts_with("limits.acceleration = inf: must be"), "{error}");
}

#[test]
fn what_no_duration_mends_says_so() {
    let limits = Limits { rate: Some(4.0), ..Limits::default() };
    let refused = |motion: Move, turning| {
        Plan::new(&motion, start(turning), &limits, 0.01).expect_err("too fast");
        Plan::remedy(&motion, start(turning), &limits, 0.01).to_string()
    };
    let spin = refused(Move::SpinUp { duration: 1.0, rate: -5.25 }, 0.0);
    assert!(
        spin.contains("the hub turns at -5.25 rad/s at an end, so no duration helps"),
        "{spin}"
    );
    let braking = refused(Move::SpinUp { duration: 1.0, rate: 0.0 }, 7.1);
    assert!(braking.contains("turns at 7.1 rad/s"), "{braking}");
    let dwell = refused(Move::Dwell { duration: 1.0 }, 7.1);
    assert!(dwell.contains("turns at 7.1 rad/s"), "{dwell}");
    let still = refused(Move::Still { duration: 0.1, to: 1.0, bulge: [0.0; 6] }, 0.0);
    assert!(still.contains("use a longer move or raise the limit"), "{still}");
    // 1e6 rad at 1e-9 rad/s.
    let never = Limits { rate: Some(1e-9), ..Limits::default() };
    let motion = Move::To { profile: Profile::Quintic, duration: 1e5, to: 1e6 };
    Plan::new(&motion, start(0.0), &never, 0.01).expect_err("slow");
    let refused = Plan::remedy(&motion, start(0.0), &never, 0.01).to_string();
    assert!(refused.contains("no duration up to 167772.16 s helps"), "{refused}");
}

/// A radian a tick is a limit like the others.
#[test]
fn more_than_a_radian_a_tick_names_a_duration() {
    let motion = Move::To { profile: Profile::Cubic, duration: 0.01, to: 100.0 };
    assert_mended(motion, start(0.0), &Limits::default(), 0.01);
    let error = Plan::new(&motion, start(0.0), &Limits::default(), 0.01).expect_err("too fast");
    assert!(error.to_string().starts_with("move.duration: the move peaks at"), "{error}");
}

/// 0.71, not 0.7100000000000001.
#[test]
fn durations_are_printed_as_one_would_write_them() {
    let limits = Limits { rate: Some(1.0), ..Limits::default() };
    for (tick, ticks) in [(0.01, 71), (0.01, 57), (0.005, 1001), (0.002, 3), (0.001, 100_007)] {
        // A cubic's rate peaks at 1.5 times the mean.
        let to = -0.2 + f64::from(ticks) * tick / 1.5 * (1.0 - 1e-9);
        let motion = Move::To { profile: Profile::Cubic, duration: tick, to };
        Plan::new(&motion, start(0.0), &limits, tick).expect_err("too fast");
        let remedy = Plan::remedy(&motion, start(0.0), &limits, tick);
        let wanted = (f64::from(ticks) * tick * 1e6).round() / 1e6;
        assert_eq!(remedy.to_string(), format!("a duration of {wanted} s fits"));
    }
}
