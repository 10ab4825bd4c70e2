//! The motors' work is the change of energy and what damping takes.

use stillbeam::Scalar;
use stillbeam::chain::{Chain, ChainGenerator, ChainSetpoint, ChainState};

use super::scenes::{self, Scene};

const TICK: f64 = 0.001;

/// Power of the motors, W.
fn power<T: Scalar, const LINKS: usize>(setpoint: &ChainSetpoint<T, LINKS>) -> f64 {
    setpoint.joints.iter().map(|joint| joint.torque.to_f64() * joint.rate.to_f64()).sum()
}

/// Work and loss in a tick that begins at `state`, its driven joints at rest, from ticks of a
/// hundredth. Directly after an impact the highest modes die out in some hundredths of a
/// millisecond: what they lose does not show in powers at the ends of a millisecond.
fn resolved<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>(
    scene: &Scene,
    state: ChainState<T, LINKS, W>,
    tick: f64,
) -> [f64; 2] {
    let fine = 0.01 * tick;
    let chain = Chain::<T, LINKS, W, C, Q>::new(&scene.mechanism, fine).expect("a chain");
    let mut arm = ChainGenerator::<T, LINKS, W, C, Q, 1>::from_state(chain, state);
    arm.tick();
    let [mut work, mut lost] = [0.0; 2];
    // Released motors give nothing, and the driven joint rests: no power before.
    let mut last = [0.0, chain.energy(&state).loss.to_f64()];
    for _ in 0..100 {
        let setpoint = arm.tick();
        let next = [power(&setpoint), chain.energy(arm.state()).loss.to_f64()];
        work += 0.5 * fine * (last[0] + next[0]);
        lost += 0.5 * fine * (last[1] + next[1]);
        last = next;
    }
    [work, lost]
}

/// Work that is missing in the balance in ticks of `tick` s, over the integral of the motors'
/// absolute power. Another balance begins when a chain has closed: its rates have jumped.
fn imbalance<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>(
    scene: &Scene,
    tick: f64,
) -> f64 {
    let mut arm = scenes::generator::<T, LINKS, W, C, Q>(scene, tick);
    let ticks = (scene.duration / tick).round() as u32;
    let (mut work, mut lost, mut turnover): (f64, f64, f64) = (0.0, 0.0, 0.0);
    let (mut worst, mut begin, mut last): (f64, Option<f64>, _) = (0.0, None, [0.0; 2]);
    let mut impact = None;
    for k in 0..=ticks {
        let setpoint = arm.tick();
        let energy = arm.chain().energy(arm.state());
        let next = [power(&setpoint), energy.loss.to_f64()];
        let total = energy.total().to_f64();
        if arm.chain().closes_at() == Some(k) {
            (work, lost, begin) = (0.0, 0.0, Some(total));
            impact = Some(*arm.state());
            continue;
        }
        if let Some(state) = impact.take() {
            [work, lost] = resolved::<T, LINKS, W, C, Q>(scene, state, tick);
        } else if k > 0 {
            work += 0.5 * tick * (last[0] + next[0]);
            turnover += 0.5 * tick * (last[0].abs() + next[0].abs());
            lost += 0.5 * tick * (last[1] + next[1]);
        }
        last = next;
        let begun = *begin.get_or_insert(total);
        worst = worst.max((work - lost - (total - begun)).abs());
    }
    worst / turnover
}

/// Measured at 1 ms with n = 2, and the same to two digits with n = 3: arm-dd 5.3e-6, arm-bc-sag
/// 2.6e-6, rigid-forearm 4.2e-5, four-bar 9.6e-6.
#[test]
fn the_motors_work_is_energy_and_loss() {
    let found = [
        imbalance::<f32, 2, 3, 6, 3>(&scenes::arm_dd(), TICK),
        imbalance::<f32, 2, 3, 6, 3>(&scenes::arm_bc_sag(), TICK),
        imbalance::<f32, 2, 3, 6, 3>(&scenes::rigid_forearm(), TICK),
        imbalance::<f32, 3, 3, 9, 3>(&scenes::four_bar(), TICK),
        imbalance::<f32, 2, 4, 8, 5>(&scenes::arm_dd(), TICK),
        imbalance::<f32, 2, 4, 8, 5>(&scenes::arm_bc_sag(), TICK),
        imbalance::<f32, 2, 4, 8, 5>(&scenes::rigid_forearm(), TICK),
        imbalance::<f32, 3, 4, 12, 5>(&scenes::four_bar(), TICK),
    ];
    println!("{found:.7?}");
    assert!(found.iter().all(|found| *found <= 1e-4), "{found:.7?}");
}

/// From the impact on.
#[test]
fn a_chain_that_closes_keeps_the_balance() {
    let latch = scenes::latch();
    let found = [
        imbalance::<f32, 3, 3, 9, 3>(&latch, TICK),
        imbalance::<f32, 3, 4, 12, 5>(&latch, TICK),
        imbalance::<f64, 3, 3, 9, 3>(&latch, TICK),
        imbalance::<f64, 3, 4, 12, 5>(&latch, TICK),
    ];
    println!("{found:.7?}");
    assert!(found.iter().all(|found| *found <= 1e-4), "{found:.7?}");
}
