//! The work of the hub torque is the change of energy plus what damping takes.

use stillbeam::Generator;
use stillbeam::model::{EightElements, Model, Modes, Rod};
use stillbeam::stepper::{Elastica, Modal, ModalState, Newmark, Quality, Stepper};
use stillbeam_energy::{self as energy, Balance, Energy, imbalance};
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_tests::features::featured;
use stillbeam_tests::{TRUTH_SCENES, truth};

const TICK: f64 = 0.001;

/// The imbalance of a scene's moves with a stepper; `energy` is the arm's at the present tick.
fn along<S: Stepper<Scalar = f64>>(
    scene: &SceneFile,
    stepper: S,
    energy: impl Fn(&Generator<S, 8>) -> Energy,
) -> f64 {
    assert_eq!(stepper.tick(), TICK);
    let mut arm = Generator::<_, 8>::new(stepper, scene.from).expect("generator");
    let mut stretches: Vec<Vec<Balance>> = vec![Vec::new()];
    let ends: Vec<u32> = scene
        .queue()
        .expect("moves alone")
        .iter()
        .scan(0, |total, motion| {
            *total += arm.push(motion).expect("move").ticks;
            Some(*total)
        })
        .collect();
    let total = *ends.last().expect("a move");
    for k in 0..=total {
        let torque = arm.tick().torque;
        // At a border the stretch before it ends with the left-hand torque.
        if ends.contains(&k) {
            let left = arm.setpoint_before().torque;
            let left = energy(&arm).under(left, arm.hub().rate);
            stretches.last_mut().expect("a stretch").push(left);
            stretches.push(Vec::new());
        }
        if k < total {
            let right = energy(&arm).under(torque, arm.hub().rate);
            stretches.last_mut().expect("a stretch").push(right);
        }
    }
    imbalance(&stretches[..stretches.len() - 1], TICK)
}

/// The imbalance of four elements, balanced by the energy of small deflections.
fn newmark(scene: &SceneFile) -> f64 {
    let model = Model::<8, 4>::consistent(&scene.arm).expect("model");
    let stepper = Newmark::<f64, 8, 4>::new(&model, TICK).expect("stepper");
    along(scene, stepper, |arm| {
        let state = arm.state();
        let q_dot = arm.stepper().deflection_rate(state);
        energy::small(&model, arm.hub(), &state.deflection, &q_dot)
    })
}

/// The same of two modes.
fn modal(scene: &SceneFile) -> f64 {
    let model = EightElements::consistent(&scene.arm).expect("model");
    let modes = Modes::of(&model);
    let stepper = Modal::<f64, 2>::new(&model, TICK).expect("stepper");
    along(scene, stepper, |arm| {
        let ModalState { coordinate, rate, .. } = arm.state();
        let [q, q_dot] = [coordinate, rate].map(|modal| energy::nodal(&modes, modal));
        energy::small(&model, arm.hub(), &q, &q_dot)
    })
}

/// The imbalance of exact kinematics, whose tip turns by up to `bend` rad.
fn elastica<const K: usize>(scene: &SceneFile, quality: Quality, bend: f64) -> f64 {
    let rod = Rod::<K>::new(&scene.arm).expect("rod");
    let stepper = Elastica::new(&rod, TICK, quality, bend).expect("stepper");
    along(scene, stepper, |arm| {
        let flex = arm.stepper().arm_state(arm.state(), arm.hub());
        energy::exact(&rod, arm.hub(), &flex.coordinate, &flex.rate)
    })
}

/// Every truth scene's imbalance with a stepper that is set up for its scene, in the order of the
/// list.
fn all(mut of: impl FnMut(&SceneFile) -> f64) -> Vec<(&'static str, f64)> {
    TRUTH_SCENES
        .map(|name| {
            let imbalance = of(&truth(name).0);
            println!("{name}: {imbalance:.1e}");
            (name, imbalance)
        })
        .to_vec()
}

fn assert_below(bound: f64, found: &[(&'static str, f64)]) {
    for (name, imbalance) in found {
        assert!(*imbalance < bound, "{name}: {imbalance:e}");
    }
}

/// The torque of small deflections is that of the energy to second order in them, which balances as
/// the exact one does. What is left is the step's: 7e-5 on d-fast, 2e-6 elsewhere.
#[test]
fn newmark_balances_its_own_energy() {
    assert_below(1e-4, &all(newmark));
}

/// The same of steps that are exact but for the spin coupling: 2e-7 at most.
#[test]
fn modal_balances_its_own_energy() {
    assert_below(1e-5, &all(modal));
}

fn all_elastica<const K: usize>(quality: Quality) -> Vec<(&'static str, f64)> {
    all(|scene| elastica::<K>(scene, quality, 0.5))
}

#[test]
fn exact_kinematics_balance_to_a_ten_thousandth() {
    for quality in [Quality::Fast, Quality::Fine] {
        assert_below(1e-4, &all_elastica::<1>(quality));
        assert_below(1e-4, &all_elastica::<2>(quality));
        assert_below(1e-4, &all_elastica::<3>(quality));
    }
}

/// A carriage with a bent link on a vertical axis, one with a link that hangs and is damped, and a
/// hub that turns in a plane that leans, under turned gravity.
const MOUNTED: [&str; 3] = [
    "axis = \"linear\"\nhub.mass = 0.2\ngravity.acceleration = 9.81\n",
    "axis = \"linear\"\nhub.mass = 0.2\ngravity = { acceleration = 9.81, direction = 1.5 }\n\
     damping = { alpha = 0.2, beta = 0.0003 }\n",
    "gravity = { acceleration = 9.81, tilt = 0.6, direction = 0.8 }\nhub.radius = 0.05\n",
];

/// The imbalance of every mounted arm with a stepper that is set up for it.
fn all_mounted(bound: f64, mut of: impl FnMut(&SceneFile) -> f64) {
    for mount in MOUNTED {
        let text = format!(
            "{mount}payload.mass = 0.02\n[link]\nlength = 0.4\nmass = 0.0224\n\
             bending_stiffness = 0.46\n[move]\nprofile = \"cubic\"\nduration = 0.3\nto = 0.5\n\
             settle = 0.2\n"
        );
        let imbalance = of(&SceneFile::parse("mounted", &text).expect("a scene"));
        println!("{mount}: {imbalance:.1e}");
        assert!(imbalance < bound, "{mount}: {imbalance:e}");
    }
}

#[test]
fn the_force_on_a_carriage_balances_the_energy() {
    all_mounted(1e-4, newmark);
    all_mounted(1e-5, modal);
    for quality in [Quality::Fast, Quality::Fine] {
        all_mounted(1e-4, |scene| elastica::<2>(scene, quality, 0.7));
    }
}

/// Arms with joints that give, payloads beyond the tip, sections and masses balance too.
#[test]
fn every_feature_balances() {
    for name in ["d-fast", "a-tip30", "s-gravity"] {
        let (plain, _) = truth(name);
        for (feature, arm) in featured(&plain.arm) {
            let scene = SceneFile { arm, ..plain.clone() };
            let newmark = newmark(&scene);
            let elastica = elastica::<2>(&scene, Quality::Fast, 1.2);
            println!("{name}, {feature}: {newmark:.1e} {elastica:.1e}");
            assert!(
                newmark < 1e-4 && elastica < 1e-4,
                "{name}, {feature}: {newmark:e} {elastica:e}"
            );
        }
    }
}
