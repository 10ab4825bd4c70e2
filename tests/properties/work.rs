//! The work of the hub torque is what the energy gains and damping takes, for any arm.

use proptest::prelude::*;
use stillbeam::model::{EightElements, FourElements, Model, Modes, Rod};
use stillbeam::stepper::{Elastica, Modal, Newmark, Quality};
use stillbeam::{Generator, Move, Profile, Scene, Stepper};

use crate::arms::{BEND, Turn, arms, turns};
use crate::cases;

/// Energy, and the powers of torque and damping, at one instant.
#[derive(Clone, Copy)]
struct Balance {
    energy: f64,
    work: f64,
    loss: f64,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Small deflections: `T = ½(J_h + J_r)ω² + ωFᵀq̇ + ½q̇ᵀMq̇ − ½ω²qᵀGq`,
/// `V = ½qᵀKq + g[sinθ(S − ½qᵀK_Pq) + cosθ f_gᵀq]`; drag takes `2αT` of link and payload, the
/// strip `βq̇ᵀKq̇`, the joint its own.
fn small<S: Stepper<Scalar = f64>, const N: usize, const W: usize>(
    model: &Model<N, W>,
    arm: &Generator<S, 16>,
    q: &[f64; N],
    rate: &[f64; N],
) -> Balance {
    let (scene, omega) = (model.scene(), arm.hub().rate);
    let (sin, cos) = arm.hub().angle.sin_cos();
    let carried = 0.5 * model.rigid_inertia() * omega * omega
        + omega * dot(model.coupling(), rate)
        + model.mass().half_form().at(rate)
        - omega * omega * model.spin().half_form().at(q);
    let raised = sin * (model.first_moment() - model.tension().half_form().at(q))
        + cos * dot(model.weight(), q);
    let energy = 0.5 * scene.hub.inertia * omega * omega
        + carried
        + model.stiffness().half_form().at(q)
        + scene.gravity * raised;
    let loss = 2.0 * scene.damping.alpha * carried
        + 2.0 * scene.damping.beta * model.stiffness().half_form().at(rate)
        + 2.0 * model.joint_damping().half_form().at(rate);
    Balance { energy, loss, work: arm.setpoint().torque * omega }
}

/// The bent rod: `T = ½J_hω² + ½vᵀMv + ωhᵀv + ½ω²T_θθ`, `V = ½Σωₖ²aₖ² + g(X sinθ + Y cosθ)`; the
/// strip takes `Σβₖωₖ²vₖ²`.
fn large(rod: &Rod<2>, arm: &Generator<Elastica<f64, 2>, 16>) -> Balance {
    let (scene, omega) = (rod.scene(), arm.hub().rate);
    let (sin, cos) = arm.hub().angle.sin_cos();
    let flex = arm.stepper().arm_state(arm.state(), arm.hub());
    let kinetics = rod.kinetics(&flex.coordinate);
    let moved = kinetics.mass.map(|row| dot(&row, &flex.rate));
    let carried = 0.5 * dot(&moved, &flex.rate)
        + omega * dot(&kinetics.coupling, &flex.rate)
        + 0.5 * omega * omega * kinetics.inertia;
    let elastic = |x: &[f64; 2]| -> f64 {
        (0..2).map(|k| rod.frequency()[k] * rod.frequency()[k] * x[k] * x[k]).sum()
    };
    let [x, y] = kinetics.moment;
    let energy = 0.5 * scene.hub.inertia * omega * omega
        + carried
        + 0.5 * elastic(&flex.coordinate)
        + scene.gravity * (x * sin + y * cos);
    let beta = rod.stiffness_damping();
    let lost: f64 = (0..2).map(|k| beta[k] * (rod.frequency()[k] * flex.rate[k]).powi(2)).sum();
    let loss = 2.0 * scene.damping.alpha * carried + lost;
    Balance { energy, loss, work: arm.setpoint().torque * omega }
}

/// |work − energy gained − loss| over the integral of |power|, by Simpson's rule.
fn imbalance<S: Stepper<Scalar = f64>>(
    stepper: S,
    turn: &Turn,
    balance: impl Fn(&Generator<S, 16>) -> Balance,
) -> f64 {
    let tick = stepper.tick();
    let mut arm = Generator::<_, 16>::new(stepper, 0.4).expect("an angle");
    let ticks = arm.push(&turn.from(0.4)).expect("a gentle move").ticks;
    arm.push(&Move::Dwell { duration: 9.0 * tick }).expect("a dwell");
    let samples: Vec<Balance> = (0..=2 * (ticks / 2 + 1))
        .map(|_| {
            arm.tick();
            balance(&arm)
        })
        .collect();
    let last = samples.len() - 1;
    let integral = |of: &dyn Fn(&Balance) -> f64| -> f64 {
        let weight = |i: usize| if i == 0 || i == last { 1.0 } else { (2 + 2 * (i % 2)) as f64 };
        samples.iter().enumerate().map(|(i, s)| weight(i) * of(s)).sum::<f64>() * tick / 3.0
    };
    let gained = samples[last].energy - samples[0].energy;
    (integral(&|s| s.work) - gained - integral(&|s| s.loss)).abs() / integral(&|s| s.work.abs())
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
        let exact = imbalance(stepper.expect("a stepper"), &turn, |arm| large(&rod, arm));
        prop_assert!(exact < 1e-3, "elastica: {exact:e}");

        // Their torque is complete to second order only.
        let turn = turn.times(0.2);
        let model = FourElements::consistent(&scene).expect("a model");
        let stepper = Newmark::<f64, 8, 4>::new(&model, tick).expect("a stepper");
        let newmark = imbalance(stepper, &turn, |arm| {
            let rate = arm.stepper().deflection_rate(arm.state());
            small(&model, arm, &arm.state().deflection, &rate)
        });
        prop_assert!(newmark < 2e-3, "newmark: {newmark:e}");

        let model = EightElements::consistent(&scene).expect("a model");
        let modes = Modes::of(&model);
        // The state holds `ωa`.
        let lift = |y: &[f64; 3]| -> [f64; 16] {
            core::array::from_fn(|i| {
                (0..3).map(|k| modes.shape[k][i] * y[k] / modes.frequency[k]).sum()
            })
        };
        let stepper = Modal::<f64, 3>::new(&model, tick).expect("a stepper");
        let modal = imbalance(stepper, &turn, |arm| {
            small(&model, arm, &lift(&arm.state().coordinate), &lift(&arm.state().rate))
        });
        prop_assert!(modal < 2e-3, "modal: {modal:e}");
    }
}
