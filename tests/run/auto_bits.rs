//! `Auto` ticks exactly as the rung that it holds: the same bits, and the same energy at rest.

use stillbeam::model::{EightElements, Rod};
use stillbeam::planner::{Planner, Request, StillMove, Target};
use stillbeam::select::{Auto, Rung};
use stillbeam::stepper::{Elastica, FastPaths, Modal, Quality, Rigid, Stepper};
use stillbeam::{Damping, Generator, Hub, Link, Move, Payload, Profile, Scalar, Scene};

const TICK: f64 = 0.01;

/// Tip angle that the rungs are set up for, rad.
const BEND: f64 = 1.0;

fn arm() -> Scene {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.05 });
    scene.payload = Payload { mass: 0.02, inertia: 1e-5, offset: 0.0 };
    scene.hub = Hub { radius: 0.03, inertia: 1e-4, stiffness: None };
    scene
}

fn scenes() -> [Scene; 4] {
    let damping = Damping { alpha: 0.8, beta: 0.004, joint: 0.0 };
    let plain = arm();
    let heavy = Scene { gravity: 2.0, ..plain };
    [plain, Scene { damping, ..plain }, heavy, Scene { damping, ..heavy }]
}

/// Every profile, a spin-up and down, rests short and long enough to sleep.
fn moves() -> Vec<Move> {
    let mut moves = Vec::new();
    let mut to = 0.0;
    for profile in Profile::ALL {
        to += 0.4;
        // Not whole thirds or sevenths of ticks: kinks fall inside.
        moves.push(Move::To { profile, duration: 0.71, to });
        moves.push(Move::Dwell { duration: 0.13 });
    }
    moves.push(Move::SpinUp { duration: 0.8, rate: 0.7 });
    moves.push(Move::Dwell { duration: 0.2 });
    moves.push(Move::SpinUp { duration: 0.8, rate: 0.0 });
    moves
}

/// Setpoints, before and after, of the moves, a rest behind them and a change of course in one
/// more.
fn bits<S: Stepper>(stepper: S, course: &StillMove) -> Vec<[f64; 7]> {
    let mut arm = Generator::<_, 64>::new(stepper, 0.0).expect("generator");
    let mut rows = Vec::new();
    let mut tick = |arm: &mut Generator<S, 64>| {
        let before = arm.setpoint_before();
        let s = arm.tick();
        let all = [s.rate, s.acceleration, s.torque, s.tip[0], s.tip[1], before.torque];
        let [a, b, c, d, e, f] = all.map(Scalar::to_f64);
        rows.push([s.angle.radians(), a, b, c, d, e, f]);
    };
    let first = Move::To { profile: Profile::Cubic, duration: 0.5, to: 0.3 };
    arm.push(&first).expect("move");
    for _ in 0..8 {
        tick(&mut arm);
    }
    arm.redirect(4, course).expect("redirect");
    for _ in 0..500 {
        tick(&mut arm);
    }
    for motion in moves() {
        arm.push(&motion).expect("move");
    }
    for _ in 0..2500 {
        tick(&mut arm);
    }
    rows
}

/// A course from where the first move is at its twelfth tick.
fn course(scene: &Scene) -> StillMove {
    let mut arm =
        Generator::<_, 2>::new(Rigid::<f64>::new(scene, TICK).expect("rigid"), 0.0).expect("start");
    arm.push(&Move::To { profile: Profile::Cubic, duration: 0.5, to: 0.3 }).expect("move");
    for _ in 0..13 {
        arm.tick();
    }
    let planner = Planner::<f64, 2>::new(scene, TICK).expect("planner");
    let request = Request::from_hub(arm.hub().precise(), Target::Angle(0.5)).duration(1.2);
    planner.plan(&request.any_deflection()).expect("plan")
}

fn course_in<T: Scalar>(scene: &Scene) -> StillMove {
    let rigid = Rigid::<T>::new(scene, TICK).expect("rigid");
    let mut arm = Generator::<_, 2>::new(rigid, 0.0).expect("start");
    arm.push(&Move::To { profile: Profile::Cubic, duration: 0.5, to: 0.3 }).expect("move");
    for _ in 0..13 {
        arm.tick();
    }
    StillMove { from: arm.hub().precise(), ..course(scene) }
}

fn same<S: Stepper>(scene: &Scene, rung: Rung, linked: S) {
    let course = course_in::<S::Scalar>(scene);
    let auto = Auto::<S::Scalar>::new(scene, TICK, rung, BEND).expect("rung");
    // How often the code at rest is linked changes no bit.
    let paths = |FastPaths { linear, at_rest, .. }| (linear, at_rest);
    assert_eq!(paths(Auto::<S::Scalar>::FAST), paths(S::FAST), "{rung}: other paths");
    let (chosen, linked) = (bits(auto, &course), bits(linked, &course));
    for (k, (a, b)) in chosen.iter().zip(&linked).enumerate() {
        assert_eq!(a.map(f64::to_bits), b.map(f64::to_bits), "{rung}, {scene:?}, tick {k}");
    }
}

fn every_rung<T: Scalar>() {
    for scene in scenes() {
        let model = EightElements::consistent(&scene).expect("model");
        same(&scene, Rung::Rigid, Rigid::<T>::new(&scene, TICK).expect("rigid"));
        same(&scene, Rung::Modal(1), Modal::<T, 1>::new(&model, TICK).expect("modal"));
        same(&scene, Rung::Modal(2), Modal::<T, 2>::new(&model, TICK).expect("modal"));
        same(&scene, Rung::Modal(3), Modal::<T, 3>::new(&model, TICK).expect("modal"));
        for quality in [Quality::Fast, Quality::Fine] {
            elastica::<T, 1>(&scene, quality);
            elastica::<T, 2>(&scene, quality);
            elastica::<T, 3>(&scene, quality);
        }
    }
}

fn elastica<T: Scalar, const K: usize>(scene: &Scene, quality: Quality) {
    let rod = Rod::<K>::new(scene).expect("rod");
    let linked = Elastica::<T, K>::new(&rod, TICK, quality, BEND).expect("elastica");
    same(scene, Rung::Elastica(K, quality), linked);
}

#[test]
fn every_rung_has_the_bits_of_its_linked_stepper_in_f32() {
    every_rung::<f32>();
}

#[test]
fn every_rung_has_the_bits_of_its_linked_stepper_in_f64() {
    every_rung::<f64>();
}

/// Largest deflection in the first and in the last hundred of so many ticks at rest, after a move.
fn ringing<S: Stepper>(stepper: S, ticks: usize) -> [f64; 2] {
    let mut arm = Generator::<_, 2>::new(stepper, 0.0).expect("generator");
    let motion = Move::To { profile: Profile::Cubic, duration: 0.05, to: 0.4 };
    let moved = arm.push(&motion).expect("move").ticks;
    for _ in 0..=moved {
        arm.tick();
    }
    let mut most = |ticks: usize| {
        let swings = (0..ticks).map(|_| arm.tick().deflection().to_f64().abs());
        swings.fold(0.0, f64::max)
    };
    let first = most(100);
    most(ticks - 200);
    [first, most(100)]
}

/// An undamped arm whose first mode turns by 0.96 a tick: stepped off the path for rests, it gained
/// two thirds of its energy in 1e5 ticks.
#[test]
fn an_undamped_arm_at_rest_gains_no_energy() {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.05 });
    let now = Rod::<1>::new(&scene).expect("rod").frequency()[0];
    scene.link.bending_stiffness *= (0.96 / TICK / now).powi(2);
    for rung in Rung::LADDER.into_iter().filter(|&rung| rung != Rung::Rigid) {
        let auto = Auto::<f32>::new(&scene, TICK, rung, BEND).expect("rung");
        let [first, last] = ringing(auto, 100_000);
        assert!(first > 1e-4, "{rung}: it hardly rings, {first} m");
        assert!(last <= 1.001 * first, "{rung}: {first} grew to {last} m");
    }
}
