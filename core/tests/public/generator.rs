use std::f64::consts::TAU;

use crate::assert_near;
use stillbeam::model::{EightElements, OneElement, Rod};
use stillbeam::stepper::{Elastica, Modal, Newmark, Quality, Rigid};
use stillbeam::{Error, Generator, Link, Move, Profile, Scene};

type Arm = Generator<Newmark<f64, 2, 2>, 7>;

fn scene() -> Scene {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.02, bending_stiffness: 0.05 });
    scene.payload.mass = 0.03;
    scene
}

fn arm(from: f64) -> Arm {
    let model = OneElement::consistent(&scene()).expect("model");
    Arm::new(Newmark::new(&model, 0.01).expect("stepper"), from).expect("generator")
}

fn to(profile: Profile, duration: f64, to: f64) -> Move {
    Move::To { profile, duration, to }
}

#[test]
fn the_first_tick_is_the_beginning_with_the_right_hand_acceleration() {
    let mut arm = arm(0.5);
    arm.push(&to(Profile::Cubic, 1.0, 1.5)).expect("move");
    let first = arm.tick();
    assert_near("angle", first.angle.radians(), 0.5, 1e-15);
    assert_near("rate", first.rate, 0.0, 0.0);
    assert_near("acceleration", first.acceleration, 6.0, 1e-12);
    assert_near("deflection", first.deflection(), 0.0, 0.0);
}

#[test]
fn the_end_of_a_move_is_seen_from_both_sides() {
    let mut arm = arm(0.0);
    arm.push(&to(Profile::Cubic, 1.0, 1.0)).expect("move");
    let last = (0..=100).map(|_| arm.tick()).last().expect("ticks");
    let before = arm.setpoint_before();
    assert_near("right", last.acceleration, 0.0, 0.0);
    assert_near("left", before.acceleration, -6.0, 1e-9);
    assert_near("angle", last.angle.radians(), 1.0, 1e-15);
    assert_eq!(last.tip, before.tip);
    // Only what moves with the hub at once feels the jump: here most of a light link's inertia.
    assert!(before.torque < last.torque);
    assert!(arm.is_holding());
}

#[test]
fn an_idle_arm_holds_and_a_move_pushed_then_begins_at_the_next_tick() {
    let mut arm = arm(0.2);
    for _ in 0..10 {
        assert_near("hold", arm.tick().angle.radians(), 0.2, 1e-15);
    }
    arm.push(&to(Profile::Quintic, 0.1, 0.4)).expect("move");
    assert!(!arm.is_holding());
    let ticks: Vec<_> = (0..=10).map(|_| arm.tick().angle.radians()).collect();
    assert_near("begins", ticks[0], 0.2, 1e-15);
    assert_near("middle", ticks[5], 0.3, 1e-12);
    assert_near("ends", ticks[10], 0.4, 1e-15);
}

#[test]
fn queued_moves_follow_without_a_gap() {
    let mut arm = arm(0.0);
    arm.push(&to(Profile::Cubic, 0.2, 1.0)).expect("move");
    arm.push(&to(Profile::Trapezoid, 0.3, -0.5)).expect("move");
    arm.push(&Move::Dwell { duration: 0.1 }).expect("move");
    arm.push(&to(Profile::Cycloid, 0.2, 0.0)).expect("move");
    let angles: Vec<_> = (0..=80).map(|_| arm.tick().angle.radians()).collect();
    for (k, expected) in [(20, 1.0), (50, -0.5), (60, -0.5), (80, 0.0)] {
        assert_near("border", angles[k], expected, 1e-12);
    }
}

#[test]
fn a_full_queue_refuses_the_whole_move_and_keeps_the_rest() {
    let mut arm = arm(0.0);
    arm.push(&to(Profile::Cubic, 0.1, 1.0)).expect("move");
    let error = arm.push(&to(Profile::SCurve, 0.1, 2.0)).expect_err("seven do not fit");
    assert_eq!(error, Error::QueueFull { needed: 7, free: 6 });
    // The refused move has left no trace: the next one starts from the first one's end.
    let plan = arm.push(&to(Profile::Cubic, 0.1, 1.0)).expect("fits");
    assert_near("peak", plan.peaks.rate, 0.0, 0.0);
}

#[test]
fn a_rest_to_rest_move_behind_a_turning_hub_is_refused_until_it_is_braked() {
    let mut arm = arm(0.0);
    arm.push(&Move::SpinUp { duration: 1.0, rate: 3.0 }).expect("spin-up");
    let error = arm.push(&to(Profile::Cubic, 1.0, 0.0)).expect_err("turning");
    assert_eq!(error, Error::NotAtRest { rate: 3.0 });
    for _ in 0..400 {
        arm.tick();
    }
    assert_near("cruise", arm.setpoint().rate, 3.0, 1e-15);
    assert_near("angle", arm.setpoint().angle.radians(), 1.5 + 3.0 * 2.99, 1e-12);
    // Pushed while cruising: begins where the hub will be at the next tick.
    let plan = arm.push(&Move::SpinUp { duration: 1.0, rate: 0.0 }).expect("brake");
    let next = arm.tick();
    assert_near("begins", next.angle.radians(), 1.5 + 3.0 * 3.0, 1e-12);
    for _ in 0..100 {
        arm.tick();
    }
    assert_near("rest", arm.setpoint().rate, 0.0, 1e-12);
    assert_near("end", arm.setpoint().angle.radians(), plan.end.angle.radians(), 1e-12);
    arm.push(&to(Profile::Cubic, 2.0, 0.0)).expect("at rest again");
}

#[test]
fn two_runs_share_nothing_but_the_stepper() {
    let model = OneElement::consistent(&scene()).expect("model");
    let stepper = Newmark::<f32, 2, 2>::new(&model, 0.01).expect("stepper");
    let fresh = || Generator::<_, 4>::new(stepper, 0.0).expect("generator");
    let (mut first, mut second) = (fresh(), fresh());
    first.push(&to(Profile::Cubic, 0.5, 1.0)).expect("move");
    second.push(&to(Profile::Cubic, 0.5, 1.0)).expect("move");
    let a: Vec<_> = (0..100).map(|_| first.tick()).collect();
    let b: Vec<_> = (0..100).map(|_| second.tick()).collect();
    assert_eq!(a, b);
}

/// `τ = (J_h + J_r) θ̈ + J_r α θ̇ + g S cos θ`, by hand for a point mass on a light link.
#[test]
fn the_rigid_arm_needs_the_textbook_torque() {
    let mut scene = Scene::new(Link { length: 1.0, mass: 1e-7, bending_stiffness: 1.0 });
    scene.hub.radius = 0.5;
    scene.hub.inertia = 0.25;
    scene.payload.mass = 2.0;
    scene.damping.alpha = 0.1;
    scene.gravity = 10.0;
    let rigid = Rigid::<f64>::new(&scene, 0.01).expect("stepper");
    let mut arm = Generator::<_, 4>::new(rigid, 0.3).expect("generator");
    arm.push(&to(Profile::Quintic, 1.0, 1.0)).expect("move");
    for _ in 0..=100 {
        let s = arm.tick();
        let inertia = 2.0 * 2.25;
        let torque = (0.25 + inertia) * s.acceleration
            + 0.1 * inertia * s.rate
            + 10.0 * 3.0 * s.angle.radians().cos();
        assert_near("torque", s.torque, torque, 1e-5);
        assert_near("tip", s.tip[0].hypot(s.tip[1]), 1.5, 1e-12);
        assert_near("deflection", s.deflection(), 0.0, 0.0);
    }
}

/// A hub that holds because nothing was asked for and one that dwells by order are the same.
#[test]
fn a_hold_is_a_dwell() {
    let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    let model = EightElements::consistent(&scene).expect("model");
    let stepper = Modal::<f32, 2>::new(&model, 0.01).expect("stepper");
    let motion = Move::To { profile: Profile::Cubic, duration: 0.2, to: 2.0 };
    let mut holds = Generator::<_, 4>::new(stepper, 0.0).expect("generator");
    holds.push(&motion).expect("move");
    let mut dwells = holds.clone();
    dwells.push(&Move::Dwell { duration: 1.0 }).expect("dwell");
    for k in 0..120 {
        assert_eq!(holds.tick(), dwells.tick(), "tick {k}");
    }
}

/// An arm that has come to rest sleeps, and wakes with the tick of the next move.
#[test]
fn an_arm_at_rest_sleeps_and_wakes() {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    scene.damping.beta = 2e-3;
    let rod = Rod::<2>::new(&scene).expect("rod");
    let stepper = Elastica::<f32, 2>::new(&rod, 0.01, Quality::Fine, 0.5).expect("stepper");
    let motion = |to| Move::To { profile: Profile::Quintic, duration: 0.3, to };
    let mut arm = Generator::<_, 4>::new(stepper, 0.0).expect("generator");
    arm.push(&motion(1.0)).expect("move");
    let setpoints: Vec<_> = (0..500).map(|_| arm.tick()).collect();
    let asleep = setpoints.windows(2).position(|pair| pair[0] == pair[1]).expect("sleeps");
    assert!(asleep > 31, "asleep in the move's tick {asleep}");
    assert!(setpoints[asleep..].iter().all(|setpoint| *setpoint == setpoints[asleep]));
    assert!(setpoints[asleep].deflection().abs() < 2e-6 * 0.4);
    arm.push(&motion(0.0)).expect("move");
    let (first, second) = (arm.tick(), arm.tick());
    assert!((first.tip[1] - setpoints[499].tip[1]).abs() < 2e-6 * 0.4, "no jump on waking");
    assert!(second.angle != first.angle && second.tip != first.tip, "awake");
}

/// The segments that a tick evaluates are planned in the tick's precision: the angle is as exact as
/// one f32 polynomial of the move's turn, rate and acceleration are as exact as their peaks.
#[test]
fn a_plan_in_single_precision_is_exact_to_its_rounding() {
    let scene = scene();
    for (ticks, turns) in [(7u32, 0.001), (100, 0.3), (12_345, 0.77), (99_997, 250.25)] {
        let duration = f64::from(ticks) * 0.01;
        let to = |profile| to(profile, duration, turns * TAU);
        let spin_up = Move::SpinUp { duration, rate: 2.0 * turns * TAU / duration };
        for motion in Profile::ALL.map(to).into_iter().chain([spin_up]) {
            let single = Rigid::<f32>::new(&scene, 0.01).expect("stepper");
            let double = Rigid::<f64>::new(&scene, 0.01).expect("stepper");
            let mut single = Generator::<_, 7>::new(single, 0.1).expect("generator");
            let mut double = Generator::<_, 7>::new(double, 0.1).expect("generator");
            let peaks = single.push(&motion).expect("move").peaks;
            double.push(&motion).expect("move");
            for _ in 0..ticks {
                let (a, b) = (single.tick(), double.tick());
                let apart = f64::from(a.angle.turns - b.angle.turns)
                    + (f64::from(a.angle.part) - b.angle.part);
                // A remainder of up to half a turn resolves 3e-8 turn.
                assert_near("angle", apart, 0.0, 2e-7 * turns + 6e-8);
                assert_near("rate", f64::from(a.rate), b.rate, 5e-7 * peaks.rate);
                let (a, b) = (f64::from(a.acceleration), b.acceleration);
                assert_near("acceleration", a, b, 1e-6 * peaks.acceleration);
            }
            assert_eq!(single.tick().angle, double.tick().angle.cast(), "{motion:?}");
        }
    }
}

/// A stiff arm or a slow move bends by less than the least range: it is fitted for that one.
#[test]
fn a_range_below_the_least_is_the_least() {
    let rod = Rod::<2>::new(&scene()).expect("rod");
    let fitted = |bend| Elastica::<f64, 2>::new(&rod, 0.01, Quality::Fast, bend);
    let run = |bend| {
        let mut arm = Generator::<_, 8>::new(fitted(bend).expect("stepper"), 0.0).expect("arm");
        arm.push(&to(Profile::Cubic, 3.0, 0.1)).expect("move");
        (0..300).map(|_| arm.tick()).collect::<Vec<_>>()
    };
    let least = run(Elastica::<f64, 2>::BEND.0);
    for bend in [0.0, 1e-9, 0.0497] {
        assert_eq!(run(bend), least, "{bend}");
    }
    for bend in [f64::NAN, -1e-3, 2.1, f64::INFINITY] {
        let error = fitted(bend).expect_err("no range").to_string();
        assert!(error.starts_with("bend = ") && error.contains("must be 0 to 2 rad"), "{error}");
    }
}
