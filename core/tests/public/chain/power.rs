//! The motors' work is the change of energy and what damping takes.

use stillbeam::Scalar;

use super::scenes::{self, Scene};

const TICK: f64 = 0.001;

/// Work that is missing in the balance, over the integral of the motors' absolute power. A chain
/// that closes is balanced from its impact on as well.
fn imbalance<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>(
    scene: &Scene,
    impact: u32,
) -> f64 {
    let mut arm = scenes::generator::<T, LINKS, W, C, Q>(scene, TICK);
    let ticks = (scene.duration / TICK).round() as u32;
    let (mut work, mut lost, mut turnover): (f64, f64, f64) = (0.0, 0.0, 0.0);
    let mut worst: f64 = 0.0;
    let mut begin = None;
    let mut last = [0.0; 2];
    for k in 0..=ticks {
        let setpoint = arm.tick();
        let closes = arm.chain().closes_at();
        let before = closes.is_some_and(|closes| (closes..closes + impact).contains(&k));
        let power: f64 = setpoint.joints.iter().map(|j| j.torque.to_f64() * j.rate.to_f64()).sum();
        let energy = arm.chain().energy(arm.state());
        if k > 0 && !before {
            work += 0.5 * TICK * (last[0] + power);
            turnover += 0.5 * TICK * (last[0].abs() + power.abs());
            lost += 0.5 * TICK * (last[1] + energy.loss.to_f64());
        }
        last = [power, energy.loss.to_f64()];
        let total = energy.total().to_f64();
        if before {
            // Joints have been released and the rates have jumped: another balance begins.
            (work, lost, begin) = (0.0, 0.0, None);
            let released = &scene.mechanism.closure.as_ref().expect("it closes").release;
            last[0] = setpoint
                .joints
                .iter()
                .enumerate()
                .filter(|(j, _)| !released.contains(j))
                .map(|(_, joint)| joint.torque.to_f64() * joint.rate.to_f64())
                .sum();
        }
        let begun = *begin.get_or_insert(total);
        worst = worst.max((work - lost - (total - begun)).abs());
    }
    worst / turnover
}

fn assert_balanced<T: Scalar>(bound: f64) {
    let found = [
        imbalance::<T, 2, 3, 6, 3>(&scenes::arm_dd(), 1),
        imbalance::<T, 2, 3, 6, 3>(&scenes::arm_bc_sag(), 1),
        imbalance::<T, 2, 3, 6, 3>(&scenes::rigid_forearm(), 1),
        imbalance::<T, 3, 3, 9, 3>(&scenes::four_bar(), 1),
        imbalance::<T, 2, 4, 8, 5>(&scenes::arm_dd(), 1),
        imbalance::<T, 2, 4, 8, 5>(&scenes::arm_bc_sag(), 1),
        imbalance::<T, 2, 4, 8, 5>(&scenes::rigid_forearm(), 1),
        imbalance::<T, 3, 4, 12, 5>(&scenes::four_bar(), 1),
    ];
    println!("{found:.7?}");
    for impact in [1, 5, 10, 20, 50, 100, 200] {
        let latch = [
            imbalance::<T, 3, 3, 9, 3>(&scenes::latch(), impact),
            imbalance::<T, 3, 4, 12, 5>(&scenes::latch(), impact),
        ];
        println!("{impact}: {latch:.7?}");
    }
    assert!(found.iter().all(|found| *found <= bound), "{found:.7?}");
}

#[test]
fn the_motors_work_is_energy_and_loss_in_f32() {
    assert_balanced::<f32>(1e-4);
}

#[test]
fn the_motors_work_is_energy_and_loss_in_f64() {
    assert_balanced::<f64>(1e-4);
}
