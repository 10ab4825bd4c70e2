//! The work of the hub torque is the change of energy plus what damping takes.

use stillbeam::Generator;
use stillbeam::beam::Model;
use stillbeam::stepper::{Newmark, Stepper};
use stillbeam_tests::{TRUTH_SCENES, truth};

const TICK: f64 = 0.001;

/// Powers at one instant, and the energy.
#[derive(Clone, Copy)]
struct Balance {
    work: f64,
    dissipation: f64,
    energy: f64,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// `T = ½(J_h + J_r)ω² + ωFᵀq̇ + ½q̇ᵀMq̇ − ½ω²qᵀGq`,
/// `V = ½qᵀKq + g[sinθ(S − ½qᵀK_Pq) + cosθ f_gᵀq]`; drag takes `2α T` of link and payload,
/// the strip `β q̇ᵀKq̇`.
fn balance(model: &Model<8, 4>, arm: &Generator<Newmark<f64, 8, 4>, 8>, torque: f64) -> Balance {
    let (hub, state, scene) = (arm.hub(), arm.state(), model.scene());
    let q = &state.deflection;
    let q_dot = arm.stepper().deflection_rate(state);
    let omega = hub.rate;
    let carried = 0.5 * scene.rigid_inertia() * omega * omega
        + omega * dot(model.coupling(), &q_dot)
        + 0.5 * dot(&model.mass().times(&q_dot), &q_dot)
        - 0.5 * omega * omega * dot(&model.spin().times(q), q);
    let bending = 0.5 * dot(&model.stiffness().times(q), q);
    let raised = scene.gravity
        * (hub.sin * (scene.first_moment() - 0.5 * dot(&model.tension().times(q), q))
            + hub.cos * dot(model.weight(), q));
    let damping = scene.damping;
    Balance {
        work: torque * omega,
        dissipation: 2.0 * damping.alpha * carried
            + damping.beta * dot(&model.stiffness().times(&q_dot), &q_dot),
        energy: 0.5 * scene.hub.inertia * omega * omega + carried + bending + raised,
    }
}

/// Simpson's rule over samples a tick apart, an even number of intervals.
fn simpson(samples: &[Balance], of: impl Fn(&Balance) -> f64) -> f64 {
    assert!(samples.len() % 2 == 1, "an even number of intervals");
    let last = samples.len() - 1;
    let weight = |i: usize| match i {
        0 => 1.0,
        i if i == last => 1.0,
        i if i % 2 == 1 => 4.0,
        _ => 2.0,
    };
    samples.iter().enumerate().map(|(i, s)| weight(i) * of(s)).sum::<f64>() * TICK / 3.0
}

/// |work − energy gained − dissipation| over the integral of the absolute power.
fn imbalance(name: &str) -> f64 {
    let (scene, _) = truth(name);
    let model = Model::<8, 4>::consistent(&scene.arm).expect("model");
    let stepper = Newmark::<f64, 8, 4>::new(&model, TICK).expect("stepper");
    assert_eq!(stepper.tick(), TICK);
    let mut arm = Generator::<_, 8>::new(stepper, scene.from).expect("generator");
    let mut stretches: Vec<Vec<Balance>> = vec![Vec::new()];
    let ends: Vec<u32> = scene
        .motions()
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
            let left = balance(&model, &arm, arm.setpoint_before().torque);
            stretches.last_mut().expect("a stretch").push(left);
            stretches.push(Vec::new());
        }
        if k < total {
            let right = balance(&model, &arm, torque);
            stretches.last_mut().expect("a stretch").push(right);
        }
    }
    let stretches = &stretches[..stretches.len() - 1];
    let sum = |of: fn(&Balance) -> f64| -> f64 { stretches.iter().map(|s| simpson(s, of)).sum() };
    let gained =
        stretches.last().and_then(|s| s.last()).expect("samples").energy - stretches[0][0].energy;
    let balance = sum(|b| b.work) - gained - sum(|b| b.dissipation);
    balance.abs() / sum(|b| b.work.abs())
}

#[test]
fn the_torque_does_the_work() {
    for name in TRUTH_SCENES {
        let imbalance = imbalance(name);
        assert!(imbalance < 2e-3, "{name}: {imbalance:e}");
    }
}
