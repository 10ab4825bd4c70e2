//! What the compiler knows of a stepper, or where it stands, changes no bit of the setpoints.

use stillbeam::model::Rod;
use stillbeam::stepper::{Elastica, Quality};
use stillbeam::{Damping, Generator, Link, Move, Profile, Scene, Setpoint, Stepper};

const LINK: Link = Link { length: 0.4, mass: 0.02, bending_stiffness: 0.05 };
const DAMPING: Damping = Damping { alpha: 0.15, beta: 0.002, joint: 0.0 };

fn stepper(scene: &Scene, quality: Quality) -> Elastica<f32, 2> {
    let rod = Rod::new(scene).expect("a rod");
    Elastica::new(&rod, 0.01, quality, 1.5).expect("a stepper")
}

/// The setpoints of a move with linear acceleration, one without, and a rest.
fn run<S: Stepper<Scalar = f32>>(stepper: S) -> Vec<Setpoint<f32>> {
    let mut arm = Generator::<S, 4>::new(stepper, 0.1).expect("a generator");
    for (profile, to) in [(Profile::Cubic, 0.9), (Profile::Quintic, -0.4)] {
        arm.push(&Move::To { profile, duration: 0.7, to }).expect("a move");
    }
    (0..200).map(|_| arm.tick()).collect()
}

/// Owned, borrowed or known to be fast: the same bits, on every path of a tick.
#[test]
fn a_borrowed_and_a_fast_stepper_give_the_same_bits() {
    let plain = Scene::new(LINK);
    let full = Scene { damping: DAMPING, gravity: 0.5, ..plain };
    for scene in [plain, full] {
        let stepper = stepper(&scene, Quality::Fast);
        let owned = run(stepper);
        let borrowed = &stepper;
        assert_eq!(run(borrowed), owned);
        assert_eq!(run(stepper.fast().expect("it is fast")), owned);
    }
}

#[test]
fn what_is_fine_is_not_fast() {
    assert!(stepper(&Scene::new(LINK), Quality::Fine).fast().is_none());
}
