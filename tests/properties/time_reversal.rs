//! Without damping the way back leads where the way there came from: the hub's motion and the arm's
//! velocities turned round, tick by tick.

use proptest::prelude::*;
use stillbeam::hub::HubState;
use stillbeam::model::{EightElements, FourElements, Rod};
use stillbeam::stepper::{AnyMotion, Elastica, Modal, Newmark, Quality};
use stillbeam::{Damping, Generator, Move, Profile, Scalar, Scene, Stepper};

use crate::arms::{BEND, TICK, Turn, arms, turns};
use crate::cases;

/// The state when time is turned round.
trait Reverse: Stepper {
    fn reversed(&self, state: &Self::State, hub: &HubState<Self::Scalar>) -> Self::State;
}

impl<T: Scalar, const N: usize, const W: usize> Reverse for Newmark<T, N, W> {
    fn reversed(&self, state: &Self::State, _: &HubState<T>) -> Self::State {
        let mut state = *state;
        state.gain = state.gain.map(|gain| -gain);
        state
    }
}

impl<T: Scalar, const K: usize> Reverse for Modal<T, K> {
    fn reversed(&self, state: &Self::State, _: &HubState<T>) -> Self::State {
        let mut state = *state;
        state.rate = state.rate.map(|rate| -rate);
        state
    }
}

impl<T: Scalar, const K: usize> Reverse for Elastica<T, K> {
    fn reversed(&self, state: &Self::State, hub: &HubState<T>) -> Self::State {
        let mut flex = self.arm_state(state, hub);
        flex.rate = flex.rate.map(|rate| -rate);
        self.state_of(&flex, &turned_round(hub))
    }
}

fn turned_round<T: Scalar>(hub: &HubState<T>) -> HubState<T> {
    HubState { rate: -hub.rate, ..*hub }
}

/// By how much the tip misses its way on the way back, in its greatest deflection or a thousandth
/// of the reach.
fn miss<S: Reverse<Scalar = f64> + Copy>(stepper: S, from: f64, motion: &Move) -> f64 {
    let mut arm = Generator::<_, 8>::new(stepper, from).expect("an angle");
    let ticks = arm.push(motion).expect("a gentle move").ticks;
    arm.push(&Move::Dwell { duration: 50.0 * stepper.tick() }).expect("a dwell");
    let there: Vec<_> = (0..ticks + 50)
        .map(|_| {
            arm.tick();
            (*arm.hub(), *arm.state())
        })
        .collect();
    let tip = |state: &S::State, hub: &HubState<f64>| stepper.response::<AnyMotion>(state, hub).tip;
    let reach = tip(&stepper.equilibrium(&there[0].0), &there[0].0)[0];
    let (hub, state) = there[there.len() - 1];
    let (mut state, mut before) = (stepper.reversed(&state, &hub), turned_round(&hub));
    let (mut apart, mut peak) = (0.0_f64, 1e-3 * reach);
    for (hub, old) in there.iter().rev().skip(1) {
        let after = turned_round(hub);
        stepper.step::<AnyMotion>(&mut state, &before, &after);
        before = after;
        apart = apart.max((tip(&state, &after)[1] - tip(old, hub)[1]).abs());
        peak = peak.max(tip(old, hub)[1].abs());
    }
    apart / peak
}

fn undamped() -> impl Strategy<Value = (Scene, Turn)> {
    (arms(), turns()).prop_map(|(scene, turn)| {
        let scene = Scene { damping: Damping::default(), ..scene };
        // Accelerations that jump between two ticks have no place in a list of ticks.
        (scene, Turn { profile: Profile::Quintic, ..turn }.gentle(&scene))
    })
}

proptest! {
    #![proptest_config(cases(128))]

    /// The trapezoidal rule is its own mirror image in time, spin and weight included.
    #[test]
    fn newmark_comes_back((scene, turn) in undamped(), from in -4.0..4.0) {
        let model = FourElements::consistent(&scene).expect("a model");
        let stepper = Newmark::<f64, 8, 4>::new(&model, TICK).expect("a stepper");
        let miss = miss(stepper, from, &turn.from(from));
        prop_assert!(miss < 1e-7, "{miss:e}");
    }

    /// The exact step of a linear mode is too; its weight and spin are forces that are known at
    /// both ends of a tick only in the second order.
    #[test]
    fn exact_steps_come_back((scene, turn) in undamped()) {
        let scene = Scene { gravity: 0.0, ..scene };
        let model = EightElements::consistent(&scene).expect("a model");
        let stepper = Modal::<f64, 3>::new(&model, TICK).expect("a stepper").without_spin();
        let miss = miss(stepper, 0.0, &turn.from(0.0));
        prop_assert!(miss < 1e-9, "{miss:e}");
    }

    /// A predictor and its corrector are not symmetric: they come back to their own order, with the
    /// error of one mode at 200 steps a period.
    #[test]
    fn exact_kinematics_come_back_to_second_order((scene, turn) in undamped()) {
        let rod = Rod::<1>::new(&scene).expect("a rod");
        let tick = (std::f64::consts::TAU / rod.frequency()[0] / 200.0).min(TICK);
        let miss = |tick: f64| {
            let stepper = Elastica::<f64, 1>::new(&rod, tick, Quality::Fine, 1.5 * BEND);
            miss(stepper.expect("a stepper"), 0.3, &turn.from(0.3))
        };
        let (coarse, fine) = (miss(tick), miss(0.5 * tick));
        prop_assert!(coarse < 1e-3, "{coarse:e}");
        prop_assert!(fine < 0.35 * coarse + 1e-6, "{fine:e} of {coarse:e}");
    }
}
