//! A move begins exactly where the hub is and ends exactly at its target, in both scalars.

use std::f64::consts::TAU;

use proptest::prelude::*;
use stillbeam::hub::Angle;
use stillbeam::planner::{Planner, Request, Target};
use stillbeam::stepper::Rigid;
use stillbeam::{Generator, Link, Move, Profile, Scalar, Scene, Setpoint};

const TICK: f64 = 0.01;

type Arm<T> = Generator<Rigid<T>, 16>;

fn scene() -> Scene {
    Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 })
}

fn arm<T: Scalar>(from: f64) -> Arm<T> {
    Generator::new(Rigid::new(&scene(), TICK).expect("a stepper"), from).expect("a generator")
}

/// Angle, rate and acceleration to the bit.
#[track_caller]
fn assert_at<T: Scalar>(setpoint: &Setpoint<T>, angle: Angle<T>, rate: f64, acceleration: f64) {
    let Setpoint { angle: at, rate: turning, acceleration: gaining, .. } = *setpoint;
    assert_eq!((at, turning, gaining), (angle, T::from_f64(rate), T::from_f64(acceleration)));
}

fn target<T: Scalar>(to: f64) -> Angle<T> {
    Angle::from_radians(to).cast()
}

/// Jump of the acceleration at the beginning of a turn by 1 in a time of 1; at the end it is the
/// negative of that.
fn jump(profile: Profile) -> f64 {
    match profile {
        Profile::Cubic => 6.0,
        Profile::Trapezoid => 4.5,
        Profile::Quintic | Profile::Cycloid | Profile::SCurve => 0.0,
        _ => panic!("the jump of {profile} is not told here"),
    }
}

/// The acceleration where a profile begins, correctly rounded up to an f64's last digits.
fn assert_begins<T: Scalar>(setpoint: &Setpoint<T>, angle: Angle<T>, acceleration: f64) {
    assert_eq!((setpoint.angle, setpoint.rate), (angle, T::ZERO));
    let found = setpoint.acceleration.to_f64();
    let room = T::EPSILON.to_f64().max(4.0 * f64::EPSILON) * acceleration.abs();
    assert!((found - acceleration).abs() <= room, "{found} for {acceleration}");
}

/// Two moves, queued before the first tick or one after the other at rest, planned here or beside.
fn assert_exact<T: Scalar>(profile: Profile, ticks: u32, from: f64, to: [f64; 2], beside: bool) {
    let mut arm = arm::<T>(from);
    let duration = TICK * f64::from(ticks);
    let mut begins = from;
    for to in to {
        let motion = Move::To { profile, duration, to };
        if beside {
            let planned = arm.plan_context().plan::<T>(&motion).expect("a plan");
            arm.take(&planned).expect("room");
        } else {
            arm.push(&motion).expect("a move");
        }
        let first = arm.tick();
        // From where the hub is, which the scalar has rounded.
        let hub = target::<T>(begins);
        let start = hub.precise();
        let turn = TAU * Angle::from_radians(to).since(start);
        assert_begins(&first, hub, jump(profile) * turn / (duration * duration));
        for _ in 1..ticks {
            arm.tick();
        }
        let last = arm.tick();
        assert_at(&last, target(to), 0.0, 0.0);
        let landing = arm.setpoint_before();
        assert_eq!((landing.angle, landing.rate), (target(to), T::ZERO));
        // Of a move in fewer ticks than it has segments, the last one may hold no tick.
        if jump(profile) == 0.0 && ticks >= 7 {
            assert_eq!(landing.acceleration, T::ZERO);
        }
        begins = to;
    }
}

/// In a queue each begins at the tick that the one before ends at.
fn assert_queued<T: Scalar>(profile: Profile, ticks: u32, to: [f64; 2]) {
    let mut arm = arm::<T>(0.0);
    for to in to {
        let motion = Move::To { profile, duration: TICK * f64::from(ticks), to };
        arm.push(&motion).expect("a move");
    }
    let all: Vec<_> = (0..=2 * ticks).map(|_| arm.tick()).collect();
    for (k, to) in [(0, 0.0), (ticks, to[0]), (2 * ticks, to[1])] {
        let setpoint = &all[k as usize];
        assert_eq!((setpoint.angle, setpoint.rate), (target(to), T::ZERO), "{profile:?}");
    }
}

fn assert_spin_ups<T: Scalar>(ticks: u32, rates: [f64; 2], idle: u32) {
    let mut arm = arm::<T>(0.2);
    let mut turning = 0.0;
    for rate in rates.into_iter().chain([0.0]) {
        // Planned, then taken some ticks later: the hub has turned on.
        let planned = arm
            .plan_context()
            .plan::<T>(&Move::SpinUp { duration: TICK * f64::from(ticks), rate })
            .expect("a plan");
        for _ in 0..idle {
            arm.tick();
        }
        let mut held = arm.clone();
        arm.take(&planned).expect("room");
        // Where a hub that holds its rate would be.
        let next = held.tick();
        assert_at(&arm.tick(), next.angle, turning, 0.0);
        for _ in 1..ticks {
            arm.tick();
        }
        let last = arm.tick();
        assert_eq!((last.rate, last.acceleration), (T::from_f64(rate), T::ZERO));
        assert_eq!(arm.setpoint_before().acceleration, T::ZERO);
        turning = rate;
    }
}

/// Broken off anywhere: the plan goes on from the hub's own bits.
fn assert_redirected<T: Scalar>(profile: Profile, when: u32, to: f64) {
    let planner = Planner::<f32, 2>::new(&scene(), TICK).expect("a planner");
    let mut arm = arm::<T>(0.1);
    arm.push(&Move::To { profile, duration: 0.3, to: 1.2 }).expect("a move");
    for _ in 0..=when {
        arm.tick();
    }
    let mut straight = arm.clone();
    let next = straight.tick();
    let request = Request::from_hub(straight.hub().precise(), Target::Angle(to)).duration(0.4);
    let plan = planner.plan(&request.any_deflection()).expect("a plan");
    arm.redirect(0, &plan).expect("a course");
    let Setpoint { angle, rate, acceleration, .. } = next;
    assert_at(&arm.tick(), angle, rate.to_f64(), acceleration.to_f64());
    for _ in 1..plan.ticks {
        arm.tick();
    }
    assert_at(&arm.tick(), target(to), 0.0, 0.0);
    assert_eq!(arm.setpoint_before().acceleration, T::ZERO);
}

fn angle() -> impl Strategy<Value = f64> {
    prop_oneof![-10.0..10.0, -1e3..1e3_f64]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn moves_begin_at_the_hub_and_end_at_the_target(
        profile in proptest::sample::select(Profile::ALL.to_vec()),
        ticks in 1_u32..100,
        from in angle(),
        by in proptest::array::uniform2(-0.09..0.09),
        beside in any::<bool>(),
    ) {
        let to = [from + f64::from(ticks) * by[0], from + f64::from(ticks) * by[1]];
        assert_exact::<f32>(profile, ticks, from, to, beside);
        assert_exact::<f64>(profile, ticks, from, to, beside);
        let to = [f64::from(ticks) * by[0], f64::from(ticks) * by[1]];
        assert_queued::<f32>(profile, ticks, to);
        assert_queued::<f64>(profile, ticks, to);
    }

    #[test]
    fn spin_ups_begin_and_end_at_their_rates(
        ticks in 1_u32..300,
        rates in proptest::array::uniform2(-9.0..9.0),
        idle in 0_u32..2000,
    ) {
        assert_spin_ups::<f32>(ticks, rates, idle);
        assert_spin_ups::<f64>(ticks, rates, idle);
    }
}

#[test]
fn a_changed_course_begins_with_the_hubs_own_bits() {
    for profile in Profile::ALL {
        for when in [0, 1, 9, 10, 17, 29, 30, 31] {
            assert_redirected::<f32>(profile, when, -0.7);
            assert_redirected::<f64>(profile, when, 1.9);
        }
    }
}

/// A still move like every other.
#[test]
fn a_still_move_begins_and_ends_exactly() {
    let planner = Planner::<f32, 2>::new(&scene(), TICK).expect("a planner");
    for to in [0.3, -1.1, 2.7] {
        let mut arm = arm::<f32>(0.0);
        let motion = planner
            .plan(&Request::from_rest(0.0, to).duration(0.31).any_deflection())
            .expect("a plan")
            .motion();
        arm.push(&motion).expect("a move");
        assert_at(&arm.tick(), target(0.0), 0.0, 0.0);
        for _ in 1..31 {
            arm.tick();
        }
        assert_at(&arm.tick(), target(to), 0.0, 0.0);
        assert_eq!(arm.setpoint_before().acceleration, 0.0);
    }
}
