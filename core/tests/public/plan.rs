use std::f64::consts::{PI, TAU};

use crate::assert_near;
use stillbeam::hub::HubState;
use stillbeam::motion::{Plan, Segment};
use stillbeam::{Angle, Error, Limits, Move, Profile, Scalar};

const REST: HubState<f64> = HubState::at_rest(Angle { turns: 0, part: 0.0 });

fn plan(profile: Profile, duration: f64, to: f64, tick: f64) -> Plan {
    let motion = Move::To { profile, duration, to };
    Plan::new(&motion, REST, &Limits::default(), tick).expect("plan")
}

/// The hub at every tick of the plan.
fn hubs<T: Scalar>(plan: &Plan) -> Vec<HubState<T>> {
    let of = |segment: &Segment<f64>| {
        let segment = segment.cast::<T>();
        (0..segment.count()).map(move |k| segment.hub(k))
    };
    plan.segments.iter().flat_map(of).collect()
}

/// `(s(u), s'(u))` of the textbook form.
fn textbook(profile: Profile, u: f64) -> (f64, f64) {
    match profile {
        Profile::Cubic => (3.0 * u * u - 2.0 * u.powi(3), 6.0 * u - 6.0 * u * u),
        Profile::Quintic => (
            10.0 * u.powi(3) - 15.0 * u.powi(4) + 6.0 * u.powi(5),
            30.0 * u * u - 60.0 * u.powi(3) + 30.0 * u.powi(4),
        ),
        Profile::Cycloid => (u - (TAU * u).sin() / TAU, 1.0 - (TAU * u).cos()),
        Profile::Trapezoid => {
            if u < 1.0 / 3.0 {
                (2.25 * u * u, 4.5 * u)
            } else if u < 2.0 / 3.0 {
                (0.25 + 1.5 * (u - 1.0 / 3.0), 1.5)
            } else {
                (1.0 - 2.25 * (1.0 - u).powi(2), 4.5 * (1.0 - u))
            }
        }
        Profile::SCurve => {
            // By the integral of a rate that is itself the integral of a trapezoid wave.
            let n = 70_000;
            let jerk = |x: f64| [1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0][((x * 7.0) as usize).min(6)];
            let (mut a, mut v, mut p) = (0.0, 0.0, 0.0);
            let d = 1.0 / f64::from(n);
            for i in 0..(u * f64::from(n)).round() as u32 {
                let j = 42.875 * jerk((f64::from(i) + 0.5) * d);
                p += v * d + a * d * d / 2.0 + j * d * d * d / 6.0;
                v += a * d + j * d * d / 2.0;
                a += j * d;
            }
            (p, v)
        }
        _ => panic!("{profile} has no textbook form here"),
    }
}

#[test]
fn every_profile_is_its_textbook_form_at_every_tick() {
    for profile in Profile::ALL {
        // 100 ticks: neither thirds nor sevenths are whole.
        let plan = plan(profile, 1.0, 2.0, 0.01);
        for (k, hub) in hubs::<f64>(&plan).iter().enumerate() {
            let (s, rate) = textbook(profile, k as f64 / 100.0);
            assert_near(profile.name(), hub.angle.radians(), 2.0 * s, 1e-8);
            assert_near(profile.name(), hub.rate, 2.0 * rate, 1e-6);
        }
        assert_eq!(hubs::<f64>(&plan).len(), 100, "{profile:?}");
        assert_near("end", plan.summary.end.angle.radians(), 2.0, 1e-15);
    }
}

#[test]
fn rate_and_acceleration_are_derivatives_of_the_angle() {
    for profile in Profile::ALL {
        let plan = plan(profile, 0.7, -1.3, 0.01);
        for segment in &plan.segments {
            let e = 1e-3;
            for i in 1..10 {
                let k = f64::from(segment.count() - 1) * f64::from(i) / 10.0;
                let hub = segment.hub_at(k);
                let (before, after) = (segment.hub_at(k - e), segment.hub_at(k + e));
                let step = 2.0 * e * 0.01;
                let slope = (after.angle.radians() - before.angle.radians()) / step;
                assert_near("rate", hub.rate, slope, 1e-6);
                let bend = (after.rate - before.rate) / step;
                assert_near("acceleration", hub.acceleration, bend, 1e-5);
            }
        }
    }
}

#[test]
fn stated_peaks_are_reached_and_not_exceeded() {
    for profile in Profile::ALL {
        let plan = plan(profile, 1.0, 2.0, 0.0001);
        let most = |of: fn(&HubState<f64>) -> f64| hubs(&plan).iter().map(of).fold(0.0, f64::max);
        let rate = most(|hub| hub.rate.abs());
        assert_near(profile.name(), rate, plan.summary.peaks.rate, 1e-3 * plan.summary.peaks.rate);
        let acceleration = most(|hub| hub.acceleration.abs());
        let expected = plan.summary.peaks.acceleration;
        assert_near(profile.name(), acceleration, expected, 1e-3 * expected);
    }
}

#[test]
fn spin_up_is_simo_and_vu_quocs() {
    let motion = Move::SpinUp { duration: 15.0, rate: 6.0 };
    let plan = Plan::new(&motion, REST, &Limits::default(), 0.01).expect("plan");
    for (k, hub) in hubs::<f64>(&plan).iter().enumerate() {
        let t = k as f64 * 0.01;
        let angle =
            6.0 / 15.0 * (t * t / 2.0 + (15.0 / TAU).powi(2) * ((TAU * t / 15.0).cos() - 1.0));
        assert_near("angle", hub.angle.radians(), angle, 1e-12);
    }
    assert_near("end", plan.summary.end.angle.radians(), 45.0, 1e-12);
    assert_eq!(plan.summary.end.rate, 6.0);
}

#[test]
fn many_turns_keep_their_fraction_in_f32() {
    let to = 250.25 * TAU;
    let plan = plan(Profile::Quintic, 100.0, to, 0.01);
    let single = hubs::<f32>(&plan);
    for (a, b) in single.iter().zip(hubs::<f64>(&plan)) {
        // The polynomial itself resolves 1e-7 of its turn in f32.
        assert_near("angle", a.angle.in_turns(), b.angle.in_turns(), 3e-5);
        assert!(a.angle.part.abs() <= 0.5);
    }
    assert_eq!((plan.summary.end.angle.turns, plan.summary.end.angle.part), (250, 0.25));
}

/// Days at constant rate lose nothing: the step is summed in integers.
#[test]
fn a_cruise_of_a_billion_ticks_is_exact() {
    let rate = 6.0;
    let start = HubState::turning(Angle { turns: -3, part: 0.4 }, rate);
    let dwell = Move::Dwell { duration: 1.0 };
    let plan = Plan::new(&dwell, start, &Limits::default(), 0.01).expect("plan");
    let long = Segment::cast::<f32>(&plan.segments[0]);
    for k in [0, 1, 7, 99, 1_000_003, 1_000_000_000] {
        // Whole and fractional turns separately: an f64 has not the digits for their sum.
        let turns_a_tick = rate * 0.01 / TAU;
        let high = (turns_a_tick * 2f64.powi(32)).floor();
        let low = turns_a_tick * 2f64.powi(32) - high;
        let exact = (high as u128 * u128::from(k as u64)) as f64 / 2f64.powi(32);
        let fraction = (exact.fract() + low * k as f64 / 2f64.powi(32) + 0.4).rem_euclid(1.0);
        let angle = long.hub(k).angle;
        let got = f64::from(angle.part).rem_euclid(1.0);
        let off = (got - fraction + 0.5).rem_euclid(1.0) - 0.5;
        assert!(off.abs() < 1e-6, "{k}: {off:e}");
        let whole = turns_a_tick * k as f64 + 0.4 - 3.0;
        assert_near("turns", angle.in_turns(), whole, 1e-3);
    }
    let back = HubState { rate: -rate, ..start };
    let plan = Plan::new(&dwell, back, &Limits::default(), 0.01).expect("plan");
    let hub = plan.segments[0].hub(1000);
    assert_near("backwards", hub.angle.radians(), -60.0 - 2.6 * TAU, 1e-9);
}

#[test]
fn durations_are_rounded_to_the_nearest_tick_and_say_so() {
    let rounded = plan(Profile::Cubic, 0.1234, 0.01, 0.01);
    assert_eq!(rounded.summary.ticks, 12);
    assert_near("rounded by", rounded.summary.rounded_by, -0.0034, 1e-12);
    assert_eq!(plan(Profile::Cubic, 0.006, 0.001, 0.01).summary.ticks, 1);
}

#[test]
fn moves_shorter_than_their_segments_still_arrive() {
    for profile in Profile::ALL {
        for ticks in 1..10u32 {
            let plan = plan(profile, f64::from(ticks) * 0.01, 0.02, 0.01);
            let total: u32 = plan.segments.iter().map(Segment::count).sum();
            assert_eq!(total, ticks, "{profile:?}");
            assert_near("end", plan.summary.end.angle.radians(), 0.02, 1e-15);
        }
    }
}

/// The moment of a border inside a tick, from angles and rates: `m = (Δθ − hθ̇₀)/h²`, of the
/// parabola `ū/2 + (u₀ − u₁)/12`. In short moves whole segments lie inside a tick; the last of them
/// has the moment of the move's last tick.
#[test]
fn borders_inside_a_tick_have_their_moment() {
    let tick = 0.01;
    let (mut inside, mut at_end) = (0, 0);
    for profile in [Profile::Trapezoid, Profile::SCurve] {
        for ticks in (2..30).chain([100, 1001]) {
            let plan = plan(profile, f64::from(ticks) * tick, 2e-3 * f64::from(ticks), tick);
            let peak = plan.summary.peaks.acceleration;
            assert_eq!(plan.segments[0].kink_moment(), 0.0);
            let (mut before, last) = (&plan.segments[0], plan.segments.len() - 1);
            for (i, segment) in plan.segments.iter().enumerate().skip(1) {
                if segment.count() == 0 && i < last {
                    continue;
                }
                let from = before.hub_at(f64::from(before.count()) - 1.0);
                let to = segment.hub_at(0.0);
                let turned = to.angle.radians() - from.angle.radians();
                let moment = (turned / tick - from.rate) / tick;
                let mean = (to.rate - from.rate) / tick;
                let parabola = 0.5 * mean + (from.acceleration - before.end_acceleration()) / 12.0;
                assert_near(profile.name(), segment.kink_moment(), moment - parabola, 1e-9 * peak);
                inside += u32::from(segment.kink_moment().abs() > 1e-3 * peak);
                at_end += u32::from(segment.count() == 0);
                before = segment;
            }
        }
    }
    // S-curves of 2 to 6 ticks, a trapezoid of 2.
    assert!(inside > 50 && at_end == 6, "{inside} {at_end}");
}

#[test]
fn limits_refuse_with_the_limit_by_name() {
    let refuse = |limits: Limits, profile| {
        let motion = Move::To { profile, duration: 1.0, to: PI };
        Plan::new(&motion, REST, &limits, 0.01).expect_err("above the limit")
    };
    let named = |error: Error| error.to_string().split(':').next().map(str::to_owned);
    let rate = Limits { rate: Some(4.7), ..Limits::default() };
    assert_eq!(named(refuse(rate, Profile::Cubic)).as_deref(), Some("limits.rate"));
    let acceleration = Limits { acceleration: Some(18.8), ..Limits::default() };
    assert_eq!(named(refuse(acceleration, Profile::Cubic)).as_deref(), Some("limits.acceleration"));
    let jerk = Limits { jerk: Some(1e6), ..Limits::default() };
    assert_eq!(named(refuse(jerk, Profile::Trapezoid)).as_deref(), Some("limits.jerk"));
    let generous = Limits { rate: Some(4.72), acceleration: Some(18.9), ..Limits::default() };
    let motion = Move::To { profile: Profile::Cubic, duration: 1.0, to: PI };
    assert!(Plan::new(&motion, REST, &generous, 0.01).is_ok());
}

#[test]
fn nonsense_is_refused_with_field_value_and_range() {
    let to = |duration, to| Move::To { profile: Profile::Cubic, duration, to };
    let cases = [
        (to(f64::NAN, 1.0), "move.duration = NaN"),
        (to(-1.0, 1.0), "move.duration = -1"),
        (to(0.001, 1.0), "move.duration = 0.001"),
        (to(1e9, 1.0), "move.duration = 1000000000"),
        (to(1.0, f64::INFINITY), "move.to = inf"),
        (to(0.01, 100.0), "move.duration"),
        (Move::SpinUp { duration: 1.0, rate: f64::NAN }, "move.rate = NaN"),
        (Move::SpinUp { duration: 1.0, rate: 1e4 }, "move.duration"),
    ];
    for (motion, beginning) in cases {
        let error = Plan::new(&motion, REST, &Limits::default(), 0.01).expect_err("nonsense");
        let text = error.to_string();
        assert!(text.starts_with(beginning) && text.contains("must be"), "{text}");
    }
}
