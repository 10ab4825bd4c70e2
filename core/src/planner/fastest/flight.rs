//! Simulates the arm in its exact kinematics through the first half of a move.

use core::f64::consts::TAU;

use super::grid::Nodes;
use super::half::Half;
use crate::hub::HubState;
use crate::math::Scalar;
use crate::model::{Load, RodPoints};
use crate::planner::prediction::Peak;
use crate::planner::simulate::Arm;
use crate::stepper::ArmState;

/// Angles that the highest and the first mode may turn by in a step of a search, rad: in a long
/// move whose torque does not matter, and in any other.
const LONG: [f64; 2] = [2.0, 0.4];
const COARSE: [f64; 2] = [1.0, 0.2];
/// The same in the last simulation.
const FINE: [f64; 2] = [0.5, 0.1];

/// The arm where the half ends.
pub(super) struct Landing<T, const K: usize, const N: usize> {
    pub arm: ArmState<T, K>,
    /// Torque of largest magnitude within half a node, N m.
    pub torque: Nodes<T, N>,
    /// Greatest magnitude of the torque, between the steps too, N m.
    pub most: T,
}

/// Greatest magnitudes over the half.
pub(super) struct Loads<T> {
    pub torque: T,
    pub moment: T,
    pub deflection: T,
}

/// Returns the steps of an interval of `interval` s, an even number.
fn parts<T: Scalar, const K: usize>(arm: &Arm<T, K>, interval: f64, radians: [f64; 2]) -> u32 {
    let [first, highest] = [0, K - 1].map(|k| arm.mode(k)[0].to_f64());
    let turns = (highest / radians[0]).max(first / radians[1]) * interval;
    2 * libm::ceil(0.5 * turns).clamp(1.0, TAU * 1e3) as u32
}

/// The first half of a move, cut into steps for the arm.
struct Flight<'a, T, const K: usize, const N: usize> {
    /// The arm, set up for the steps.
    arm: Arm<T, K>,
    points: &'a RodPoints<T, K>,
    half: &'a Half<T, N>,
    /// Steps an interval.
    parts: u32,
    /// Steps a second.
    rate: T,
}

impl<'a, T: Scalar, const K: usize, const N: usize> Flight<'a, T, K, N> {
    fn new(
        arm: &Arm<T, K>,
        points: &'a RodPoints<T, K>,
        half: &'a Half<T, N>,
        radians: [f64; 2],
    ) -> Self {
        let interval = half.interval.to_f64();
        let parts = parts(arm, interval, radians);
        let step = interval / f64::from(parts);
        Self { arm: arm.undamped(step), points, half, parts, rate: T::from_f64(1.0 / step) }
    }

    /// Loads of a state.
    fn load(&self, flex: &ArmState<T, K>, hub: &HubState<T>) -> Load<T> {
        self.arm.load(self.points, flex, hub)
    }

    /// Simulates from rest to the end of the half. `each` sees the arm and the hub after each step.
    fn fly(&self, each: impl FnMut(&ArmState<T, K>, &HubState<T>)) -> ArmState<T, K> {
        self.arm.simulate(
            self.points,
            self.rate,
            |k| self.half.hub(k, self.parts),
            N as u32 * self.parts,
            &ArmState::STRAIGHT,
            each,
        )
    }
}

/// How a simulation of a search looks at the arm.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// True if the move is long enough for long steps.
    pub long: bool,
    /// True if the torque at the nodes is asked for.
    pub loaded: bool,
}

/// Simulates from rest to the end of the half.
pub(super) fn fly<T: Scalar, const K: usize, const N: usize>(
    arm: &Arm<T, K>,
    points: &RodPoints<T, K>,
    half: &Half<T, N>,
    view: View,
) -> Landing<T, K, N> {
    let long = view.long && !view.loaded;
    let flight = Flight::new(arm, points, half, if long { LONG } else { COARSE });
    let parts = flight.parts;
    let mut torque = [[T::ZERO; N]; 2];
    let mut most = Peak::new(T::ZERO);
    let mut done = 0;
    let end = flight.fly(|flex, hub| {
        done += 1;
        // A node has four steps then, and two looks do.
        let skipped = parts >= 8 && done % 2 == 1;
        if !view.loaded || skipped {
            return;
        }
        let here = flight.load(flex, hub).torque;
        most.see(here);
        // Nearest node, counted from 1: two an interval.
        let node = ((4 * done + parts) / (2 * parts)).clamp(1, 2 * N as u32) as usize - 1;
        let greatest = &mut torque[node % 2][node / 2];
        if here.abs() > greatest.abs() {
            *greatest = here;
        }
    });
    Landing { arm: end, torque, most: most.most }
}

/// Simulates in fine steps and returns the greatest loads.
pub(super) fn fly_finely<T: Scalar, const K: usize, const N: usize>(
    arm: &Arm<T, K>,
    points: &RodPoints<T, K>,
    half: &Half<T, N>,
) -> (ArmState<T, K>, Loads<T>) {
    let flight = Flight::new(arm, points, half, FINE);
    let load = flight.load(&ArmState::STRAIGHT, &half.hub(0, flight.parts));
    let mut torque = Peak::new(load.torque);
    let mut moment = Peak::new(load.moment);
    let mut bend = Peak::new(load.tip[1]);
    let end = flight.fly(|flex, hub| {
        let load = flight.load(flex, hub);
        torque.see(load.torque);
        moment.see(load.moment);
        bend.see(load.tip[1]);
    });
    (end, Loads { torque: torque.most, moment: moment.most, deflection: bend.most })
}
