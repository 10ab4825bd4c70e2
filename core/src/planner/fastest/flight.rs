//! Simulates the arm in its exact kinematics through the first half of a move.

use core::f64::consts::TAU;

use super::grid::Nodes;
use super::half::Half;
use crate::math::Scalar;
use crate::model::RodPoints;
use crate::planner::prediction::Peak;
use crate::planner::simulate::Arm;
use crate::stepper::ArmState;

/// Angles that the highest and the first mode may turn by in a step of a search, rad, and in the
/// last simulation.
pub(super) const COARSE: [f64; 2] = [1.0, 0.2];
pub(super) const FINE: [f64; 2] = [0.5, 0.1];

/// The arm where the half ends.
pub(super) struct Landing<T, const K: usize, const N: usize> {
    pub arm: ArmState<T, K>,
    /// Torque of largest magnitude within half a node, N m.
    pub torque: Nodes<T, N>,
}

/// Greatest magnitudes over the half.
pub(super) struct Loads<T> {
    pub torque: T,
    pub moment: T,
    pub deflection: T,
}

/// Returns the steps of an interval of `interval` s, an even number.
pub(super) fn parts<T: Scalar, const K: usize>(
    arm: &Arm<T, K>,
    interval: f64,
    radians: [f64; 2],
) -> u32 {
    let [first, highest] = [0, K - 1].map(|k| arm.mode(k)[0].to_f64());
    let turns = (highest / radians[0]).max(first / radians[1]) * interval;
    2 * libm::ceil(0.5 * turns).clamp(1.0, TAU * 1e3) as u32
}

/// Simulates from rest to the end of the half; with the torque at the nodes if `loaded`.
pub(super) fn fly<T: Scalar, const K: usize, const N: usize>(
    arm: &Arm<T, K>,
    points: &RodPoints<T, K>,
    half: &Half<T, N>,
    loaded: bool,
) -> Landing<T, K, N> {
    let interval = half.interval.to_f64();
    let parts = parts(arm, interval, COARSE);
    let step = interval / f64::from(parts);
    let arm = arm.undamped(step);
    let mut torque = [[T::ZERO; N]; 2];
    let mut done = 0;
    let end = arm.simulate(
        points,
        T::from_f64(1.0 / step),
        |k| half.hub(k, parts),
        N as u32 * parts,
        &ArmState::STRAIGHT,
        |flex, hub| {
            done += 1;
            if !loaded {
                return;
            }
            let here = arm.load(points, flex, hub).torque;
            // Nearest node, counted from 1: two an interval.
            let node = ((4 * done + parts) / (2 * parts)).clamp(1, 2 * N as u32) as usize - 1;
            let greatest = &mut torque[node % 2][node / 2];
            if here.abs() > greatest.abs() {
                *greatest = here;
            }
        },
    );
    Landing { arm: end, torque }
}

/// Simulates in fine steps and returns the greatest loads.
pub(super) fn fly_finely<T: Scalar, const K: usize, const N: usize>(
    arm: &Arm<T, K>,
    points: &RodPoints<T, K>,
    half: &Half<T, N>,
) -> (ArmState<T, K>, Loads<T>) {
    let interval = half.interval.to_f64();
    let parts = parts(arm, interval, FINE);
    let step = interval / f64::from(parts);
    let arm = arm.undamped(step);
    let load = arm.load(points, &ArmState::STRAIGHT, &half.hub(0, parts));
    let mut torque = Peak::new(load.torque);
    let mut moment = Peak::new(load.moment);
    let mut bend = Peak::new(load.tip[1]);
    let end = arm.simulate(
        points,
        T::from_f64(1.0 / step),
        |k| half.hub(k, parts),
        N as u32 * parts,
        &ArmState::STRAIGHT,
        |flex, hub| {
            let load = arm.load(points, flex, hub);
            torque.see(load.torque);
            moment.see(load.moment);
            bend.see(load.tip[1]);
        },
    );
    (end, Loads { torque: torque.most, moment: moment.most, deflection: bend.most })
}
