//! Peaks are those of the curve itself, between the ticks as well as on them, to 1e-3.

use std::f64::consts::{PI, TAU};

use proptest::prelude::*;
use stillbeam::hub::Angle;
use stillbeam::motion::{BULGE, Peaks, Plan, Segment};
use stillbeam::planner::{Planner, Request, StillMove, Target};
use stillbeam::stepper::Rigid;
use stillbeam::{Error, Generator, HubState, Limits, Link, Move, Profile, Scene};

const LOOKS: u32 = 20_000;

/// Greatest magnitudes of segments end to end.
fn dense(plan: &Plan, tick: f64) -> Peaks {
    let mut most = Peaks { rate: 0.0, acceleration: 0.0, jerk: 0.0 };
    for (n, segment) in plan.segments.iter().enumerate() {
        let begin = -segment.ticks_before();
        let next = plan.segments.get(n + 1).map_or(0.0, |next| next.ticks_before());
        let end = f64::from(segment.count()) - next;
        let Peaks { rate, acceleration, jerk } = within(segment, begin, end, tick);
        most.rate = most.rate.max(rate);
        most.acceleration = most.acceleration.max(acceleration);
        most.jerk = most.jerk.max(jerk);
    }
    most
}

/// Greatest magnitudes of a segment between two instants, in ticks, sampled far more often than
/// every tick. Its jerk is the change of the acceleration from look to look, and what a straight
/// line through the outer two of those says of the ends.
fn within(segment: &Segment<f64>, begin: f64, end: f64, tick: f64) -> Peaks {
    let step = (end - begin) / f64::from(LOOKS);
    // Just inside, as an end is stored apart and would be a step in the jerk.
    let hubs: Vec<_> =
        (0..LOOKS).map(|look| segment.hub_at(begin + step * (f64::from(look) + 0.5))).collect();
    let most = |all: &mut dyn Iterator<Item = f64>| all.fold(0.0, |a: f64, b| a.max(b.abs()));
    let mut jerks: Vec<_> = hubs
        .windows(2)
        .map(|pair| (pair[1].acceleration - pair[0].acceleration) / (step * tick))
        .collect();
    let last = jerks.len() - 1;
    jerks.extend([2.0 * jerks[0] - jerks[1], 2.0 * jerks[last] - jerks[last - 1]]);
    let ends = [begin, end].map(|at| segment.hub_at(at));
    Peaks {
        rate: most(&mut hubs.iter().chain(&ends).map(|hub| hub.rate)),
        acceleration: most(&mut hubs.iter().chain(&ends).map(|hub| hub.acceleration)),
        jerk: most(&mut jerks.into_iter()),
    }
}

/// `of` the curve is what is `stated`, to 1e-3; nothing finite is stated of a jump.
fn assert_true(stated: &Peaks, of: &Peaks, what: &str) {
    let near = |name: &str, stated: f64, found: f64| {
        let room = 1e-3 * found + 1e-9;
        assert!((stated - found).abs() <= room, "{what}: {name} {stated}, the curve has {found}");
    };
    near("rate", stated.rate, of.rate);
    near("acceleration", stated.acceleration, of.acceleration);
    if stated.jerk.is_finite() {
        near("jerk", stated.jerk, of.jerk);
    }
}

fn start(turning: f64) -> HubState<f64> {
    HubState::turning(Angle::from_radians(0.3), turning)
}

fn assert_plan_true(motion: &Move, start: HubState<f64>, tick: f64) {
    let plan = Plan::new(motion, start, &Limits::default(), tick).expect("a plan");
    assert_true(&plan.summary.peaks, &dense(&plan, tick), &format!("{motion:?}"));
}

/// Durations of any number of ticks, so that borders of thirds and sevenths lie between them.
#[test]
fn every_profile_peaks_as_stated() {
    for profile in Profile::ALL {
        for ticks in [20, 21, 22, 23, 24, 25, 26, 100, 997] {
            let duration = 0.01 * f64::from(ticks);
            assert_plan_true(&Move::To { profile, duration, to: 1.9 }, start(0.0), 0.01);
        }
    }
}

#[test]
fn spin_ups_and_dwells_peak_as_stated_from_a_turning_hub_too() {
    for turning in [0.0, 2.0, -3.0] {
        for rate in [0.0, 2.0, 5.0, -3.0, 1e-3] {
            assert_plan_true(&Move::SpinUp { duration: 0.37, rate }, start(turning), 0.01);
        }
        assert_plan_true(&Move::Dwell { duration: 0.37 }, start(turning), 0.01);
    }
}

/// Only a cubic and a trapezoid jump.
#[test]
fn a_jump_has_no_finite_jerk() {
    for profile in Profile::ALL {
        let jumps = matches!(profile, Profile::Cubic | Profile::Trapezoid);
        assert_eq!(profile.peaks(1.0, 1.0).jerk.is_infinite(), jumps, "{profile:?}");
    }
}

/// A curve from a hub that turns and speeds up to rest, as a plan from a moving hub has it.
fn moving() -> impl Strategy<Value = StillMove> {
    let state = (-3.0..3.0, -40.0..40.0, -3.0..3.0);
    (state, 7_u32..200, proptest::array::uniform6(-1.0..1.0)).prop_map(
        |((rate, acceleration, to), ticks, bulge): (_, _, [f64; BULGE])| {
            let from =
                HubState { acceleration, ..HubState::turning(Angle::from_radians(0.4), rate) };
            let peaks = Peaks { rate: 0.0, acceleration: 0.0, jerk: 0.0 };
            StillMove {
                from,
                to,
                rate: 0.0,
                ticks,
                tick: 0.01,
                bulge,
                peaks,
                residual: 0.0,
                simulations: 0,
            }
        },
    )
}

/// A generator whose hub is where `from` is at the coming tick cannot be had for any `from`; what
/// refuses a plan first is its limits. The curve's true peaks pass, 0.2 % less of any does not.
fn judged(plan: &StillMove, limits: Limits) -> Result<(), Error> {
    let mut arm = Generator::<_, 8>::new(rigid(), 0.4)?;
    arm.limit(limits)?;
    match arm.redirect(0, plan) {
        // Beyond the limits, or a radian a tick.
        Err(error @ (Error::LimitExceeded { .. } | Error::TooFast { .. })) => Err(error),
        _ => Ok(()),
    }
}

fn rigid() -> Rigid<f32> {
    let scene = Scene::new(Link { length: 0.4, mass: 0.02, bending_stiffness: 0.05 });
    Rigid::new(&scene, 0.01).expect("a stepper")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// In f32, whatever the plan says of itself: here, nothing.
    #[test]
    fn a_redirected_curve_is_judged_by_its_own_peaks(plan in moving()) {
        let ticks = f64::from(plan.ticks);
        let Peaks { rate, acceleration, jerk } = within(&plan.segment(), 0.0, ticks, plan.tick);
        prop_assume!(rate < 95.0);
        let limits = |factor: [f64; 3]| Limits {
            rate: Some(factor[0] * rate),
            acceleration: Some(factor[1] * acceleration),
            jerk: Some(factor[2] * jerk),
            ..Limits::default()
        };
        prop_assert_eq!(judged(&plan, limits([1.001; 3])), Ok(()));
        for tight in [[0.999, 2.0, 2.0], [2.0, 0.999, 2.0], [2.0, 2.0, 0.999]] {
            prop_assert!(judged(&plan, limits(tight)).is_err(), "{:?}", tight);
        }
    }

    /// The same of a still move that is pushed, in both scalars.
    #[test]
    fn a_pushed_curve_is_judged_by_its_own_peaks(
        bulge in proptest::array::uniform6(-1.0..1.0),
        to in -3.0..3.0,
        ticks in 7_u32..200,
    ) {
        let motion = Move::Still { duration: 0.01 * f64::from(ticks), to, bulge };
        let plan = Plan::new(&motion, start(0.0), &Limits::default(), 0.01);
        prop_assume!(plan.is_ok());
        let plan = plan.expect("a plan");
        let found = dense(&plan, 0.01);
        assert_true(&plan.summary.peaks, &found, "f64");
        let mut arm = Generator::<_, 8>::new(rigid(), 0.3).expect("a generator");
        assert_true(&arm.push(&motion).expect("a move").peaks, &found, "f32");
    }
}

/// A plan that says it needs nothing passed every limit.
#[test]
fn a_plan_that_lies_is_refused() {
    let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    let planner = Planner::<f32, 2>::new(&scene, 0.01).expect("a planner");
    let arm = || Generator::<_, 8>::new(rigid(), 0.4).expect("a generator");
    let request = Request::from_hub(arm().hub().precise(), Target::Angle(PI)).duration(0.3);
    let honest = planner.plan(&request.any_deflection()).expect("a plan");
    let limits = Limits { rate: Some(0.99 * honest.peaks.rate), ..Limits::default() };
    let nothing = Peaks { rate: 0.0, acceleration: 0.0, jerk: 0.0 };
    let lie = StillMove { peaks: nothing, ..honest };
    assert_eq!(arm().redirect(0, &lie), Ok(()));
    for lie in [
        // Of another tick: twice as fast as its own says.
        StillMove { tick: 0.02, ..honest },
        StillMove { ticks: 0, ..honest },
        StillMove { ticks: 1, ..honest },
        StillMove { to: f64::NAN, ..honest },
        StillMove { bulge: [f64::NAN; BULGE], ..honest },
        StillMove { to: 1e3 * TAU, ..honest },
    ] {
        let mut arm = arm();
        assert!(arm.redirect(0, &lie).is_err(), "{lie:?}");
        assert!(arm.is_holding());
    }
    let mut arm = arm();
    arm.limit(limits).expect("limits");
    let refused = arm.redirect(0, &lie).expect_err("too fast").to_string();
    assert!(refused.starts_with("limits.rate"), "{refused}");
}
