//! Energy is positive, and an arm on a resting hub gains none.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use stillbeam::math::Band;
use stillbeam::model::{EightElements, FourElements, Model, Modes, Rod};
use stillbeam::stepper::{Elastica, Modal, Newmark, Quality};
use stillbeam::{Angle, Generator, HubState, Move, Scene, Stepper};
use stillbeam_energy as energy;

use crate::arms::{BEND, TICK, Turn, arms, level_arms, turns};
use crate::cases;

/// True if `xᵀAx` is positive for every `x`, by the signs of the pivots; and for this one.
fn positive<const N: usize, const W: usize>(a: &Band<f64, N, W>, x: &[f64]) -> TestCaseResult {
    prop_assert!(a.factor().is_positive());
    let x: [f64; N] = core::array::from_fn(|i| x[i] / a.get(i, i).sqrt());
    prop_assert!(a.half_form().at(&x) > 0.0);
    Ok(())
}

fn of_model<const N: usize, const W: usize>(model: &Model<N, W>, x: &[f64]) -> TestCaseResult {
    positive(model.mass(), x)?;
    positive(model.stiffness(), x)?;
    positive(model.shortening(), x)
}

fn vector() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.0..1.0, 16).prop_filter("not zero", |x| x.iter().any(|x| *x != 0.0))
}

/// The energies at the ticks after a move, its hub at rest.
fn afterwards<S: Stepper<Scalar = f64>>(
    stepper: S,
    turn: &Turn,
    energy: impl Fn(&Generator<S, 16>) -> f64,
) -> Vec<f64> {
    let mut arm = Generator::<_, 16>::new(stepper, 0.0).expect("an angle");
    let ticks = arm.push(&turn.from(0.0)).expect("a gentle move").ticks;
    arm.push(&Move::Dwell { duration: 4.0 }).expect("a dwell");
    for _ in 0..=ticks + 1 {
        arm.tick();
    }
    (0..300)
        .map(|_| {
            arm.tick();
            energy(&arm)
        })
        .collect()
}

/// Fails if an energy exceeds any before it by more than `slack` of the first.
fn never_grows(energies: &[f64], slack: f64) -> TestCaseResult {
    let mut least = energies[0];
    for (k, &energy) in energies.iter().enumerate() {
        prop_assert!(energy >= 0.0);
        let gained = energy - least;
        prop_assert!(gained <= slack * energies[0], "tick {k}: {gained:e} of {:e}", energies[0]);
        least = least.min(energy);
    }
    Ok(())
}

fn newmark(scene: &Scene, turn: &Turn) -> Vec<f64> {
    let model = FourElements::consistent(scene).expect("a model");
    let stepper = Newmark::<f64, 8, 4>::new(&model, TICK).expect("a stepper");
    afterwards(stepper, turn, |arm| {
        let (q, rate) = (arm.state().deflection, arm.stepper().deflection_rate(arm.state()));
        energy::small(&model, arm.hub(), &q, &rate).of_vibration()
    })
}

fn modal(scene: &Scene, turn: &Turn) -> Vec<f64> {
    let model = EightElements::consistent(scene).expect("a model");
    let modes = Modes::of(&model);
    let stepper = Modal::<f64, 3>::new(&model, TICK).expect("a stepper");
    afterwards(stepper, turn, |arm| {
        let state = arm.state();
        let [q, rate] = [&state.coordinate, &state.rate].map(|modal| energy::nodal(&modes, modal));
        energy::small(&model, arm.hub(), &q, &rate).of_vibration()
    })
}

fn elastica(scene: &Scene, turn: &Turn) -> Vec<f64> {
    let rod = Rod::<2>::new(scene).expect("a rod");
    let stepper = Elastica::<f64, 2>::new(&rod, TICK, Quality::Fine, 1.5 * BEND);
    afterwards(stepper.expect("a stepper"), turn, |arm| {
        let flex = arm.stepper().arm_state(arm.state(), arm.hub());
        energy::exact(&rod, arm.hub(), &flex.coordinate, &flex.rate).of_vibration()
    })
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn matrices_are_positive_definite(scene in arms(), x in vector()) {
        of_model(&FourElements::consistent(&scene).expect("a model"), &x)?;
        of_model(&EightElements::consistent(&scene).expect("a model"), &x)?;
        if scene.payload.inertia > 0.0 {
            of_model(&Model::<5, 5>::lumped::<8>(&scene).expect("a model"), &x)?;
        } else {
            of_model(&Model::<4, 4>::lumped::<8>(&scene).expect("a model"), &x)?;
        }
    }

    /// `½vᵀMv + ωhᵀv + ½ω²T_θθ` of the bent rod, whatever it does.
    #[test]
    fn kinetic_energy_is_positive(scene in arms(), x in vector(), omega in -1.0..1.0) {
        let rod = Rod::<3>::new(&scene).expect("a rod");
        let a = core::array::from_fn(|k| x[k] / rod.tip_slope()[k]);
        let kinetics = rod.kinetics(&a);
        let v: [f64; 3] = core::array::from_fn(|k| x[3 + k] / kinetics.mass[k][k].sqrt());
        let hub = HubState::turning(Angle::from_radians(0.0), omega / kinetics.inertia.sqrt());
        let energy = energy::exact(&rod, &hub, &a, &v).carried;
        prop_assert!(energy > 0.0, "{energy:e}");
    }

    /// Damped or not: the linear methods to rounding.
    #[test]
    fn a_ringing_arm_gains_no_energy(scene in level_arms(), turn in turns()) {
        let turn = turn.gentle(&scene);
        never_grows(&newmark(&scene, &turn), 1e-9)?;
        never_grows(&modal(&scene, &turn), 1e-9)?;
        // Its energy as the exact kinematics count it swings with the error of the expansion, and
        // of a step that the second mode may turn far in.
        never_grows(&elastica(&scene, &turn), 5e-2)?;
    }
}
