//! The work of the hub torque is what the energy gains and damping takes, for any arm.

use proptest::prelude::*;
use stillbeam::model::{EightElements, FourElements, Modes, Rod};
use stillbeam::stepper::{Elastica, Modal, Newmark, Quality};
use stillbeam::{Generator, Move, Profile, Scene, Stepper};
use stillbeam_energy::{self as energy, Energy, imbalance};

use crate::arms::{BEND, Turn, arms, turns};
use crate::cases;

/// The imbalance of a turn with a stepper; `energy` is the arm's at the present tick.
fn along<S: Stepper<Scalar = f64>>(
    stepper: S,
    turn: &Turn,
    energy: impl Fn(&Generator<S, 16>) -> Energy,
) -> f64 {
    let tick = stepper.tick();
    let mut arm = Generator::<_, 16>::new(stepper, 0.4).expect("an angle");
    let ticks = arm.push(&turn.from(0.4)).expect("a gentle move").ticks;
    arm.push(&Move::Dwell { duration: 9.0 * tick }).expect("a dwell");
    let samples = (0..=2 * (ticks / 2 + 1)).map(|_| {
        let torque = arm.tick().torque;
        energy(&arm).under(torque, arm.hub().rate)
    });
    imbalance(&[samples.collect()], tick)
}

/// An arm and a smooth move of some periods at a tick that resolves two modes.
fn resolved() -> impl Strategy<Value = (Scene, Turn, f64)> {
    (arms(), turns(), 0.5_f64..3.0, any::<bool>()).prop_map(|(scene, turn, periods, quintic)| {
        let rod = Rod::<2>::new(&scene).expect("a rod");
        let [first, second] = rod.frequency().map(|omega| std::f64::consts::TAU / omega);
        let tick = second / 24.0;
        let profile = if quintic { Profile::Quintic } else { Profile::Cycloid };
        let duration = (periods * first / tick).ceil() * tick;
        let turn = Turn { profile, duration, ..turn }.gentle(&scene);
        (scene, turn, tick)
    })
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn the_torque_does_the_work((scene, turn, tick) in resolved()) {
        // Half as far as the tip may turn, where the expansion is good to 1e-4.
        let turn = turn.times(0.5);
        let rod = Rod::<2>::new(&scene).expect("a rod");
        let stepper = Elastica::<f64, 2>::new(&rod, tick, Quality::Fine, 0.6 * BEND);
        let exact = along(stepper.expect("a stepper"), &turn, |arm| {
            let flex = arm.stepper().arm_state(arm.state(), arm.hub());
            energy::exact(&rod, arm.hub(), &flex.coordinate, &flex.rate)
        });
        prop_assert!(exact < 1e-3, "elastica: {exact:e}");

        // Their torque is complete to second order only.
        let turn = turn.times(0.2);
        let model = FourElements::consistent(&scene).expect("a model");
        let stepper = Newmark::<f64, 8, 4>::new(&model, tick).expect("a stepper");
        let newmark = along(stepper, &turn, |arm| {
            let rate = arm.stepper().deflection_rate(arm.state());
            energy::small(&model, arm.hub(), &arm.state().deflection, &rate)
        });
        prop_assert!(newmark < 2e-3, "newmark: {newmark:e}");

        let model = EightElements::consistent(&scene).expect("a model");
        let modes = Modes::of(&model);
        let stepper = Modal::<f64, 3>::new(&model, tick).expect("a stepper");
        let modal = along(stepper, &turn, |arm| {
            let state = arm.state();
            let [q, rate] = [&state.coordinate, &state.rate].map(|modal| energy::nodal(&modes, modal));
            energy::small(&model, arm.hub(), &q, &rate)
        });
        prop_assert!(modal < 2e-3, "modal: {modal:e}");
    }
}
