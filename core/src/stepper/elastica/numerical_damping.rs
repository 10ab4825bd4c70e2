//! Numerical damping: keeps an undamped arm from gaining energy while its hub rests.

use crate::math::{Each, Scalar, array, sqrt, words};
use crate::model::Rod;

/// Relative energy growth per step, divided by `b²(ω₁h)⁴`, `b` the bend in rad, in one mode and in
/// several: 9e-4 to 1.1e-3 of small bends as measured on bare and loaded links from ω₁h = 0.03 to
/// 3; of one mode up to 3.5e-3 at one radian, where others take energy from it.
const ENERGY_GROWTH: [f64; 2] = [3.5e-3, 1.2e-3];

/// Greatest `(ωh)⁴` that counts, of the first mode and of the others, which are left more of their
/// vibration than they may gain.
const LARGEST_TURN: [f64; 2] = [32.0, 1.0];

/// Fraction of a rounding, 5e-9 a step of which were gained in f32.
const ROUNDING: f64 = 0.25;

/// The corrector of [`Elastica`](super::Elastica) is explicit in the remainder: a step feeds an arm
/// by `ENERGY_GROWTH b²(ω₁h)⁴` of its energy, nothing within a move, a lot over a million ticks. An
/// arm that rings on with its hub at rest is drawn towards its centre by as much, and a little
/// more.
#[derive(Clone, Copy, Debug)]
pub(super) struct NumericalDamping<T, const K: usize> {
    /// `b²` per square of the first mode's offset, and its greatest.
    bend: T,
    most: T,
    weight: [T; K],
}

impl<T: Scalar, const K: usize> NumericalDamping<T, K> {
    /// For steps of `step` s.
    pub(super) fn new(rod: &Rod<K>, step: f64, range: &[f64; K]) -> Self {
        let omega = rod.frequency();
        let slope = rod.tip_slope()[0];
        let (bend, most) = (slope / omega[0], slope * range[0]);
        let gain = if K == 1 { ENERGY_GROWTH[0] } else { ENERGY_GROWTH[1] };
        Self {
            bend: T::from_f64(bend * bend),
            most: T::from_f64(most * most),
            weight: array(|k| {
                let turn = omega[k] * step;
                let fourth = (turn * turn * turn * turn).min(LARGEST_TURN[k.min(1)]);
                // Half of the energy is amplitude, half of that turns by in one of the two.
                T::from_f64(gain * fourth)
            }),
        }
    }

    /// Returns the offset of the first mode that bends the tip by `bend` rad.
    pub(super) fn offset(&self, bend: f64) -> T {
        T::from_f64(bend / sqrt(self.bend.to_f64()))
    }

    /// The fraction by which each mode is drawn to its centre in a step, by how far the first is
    /// off.
    #[inline(always)]
    pub(super) fn at(&self, off: &[T; 2]) -> [T; K] {
        let bend = self.bend * (off[0] * off[0] + off[1] * off[1]);
        let bend = if bend < self.most { bend } else { self.most };
        let rounding = T::EPSILON * T::from_f64(ROUNDING);
        self.weight.each(|weight| weight * bend + rounding)
    }
}

words! {
    [T: Scalar, const K: usize] NumericalDamping<T, K>: bend, most, weight;
}
