//! State of the arm between two ticks.

use super::nonlinear::Value;
use crate::math::{Each, Scalar};

/// The arm's state; [`Elastica::arm_state`](super::Elastica::arm_state) says what it means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticaState<T, const K: usize> {
    /// `(ωₖaₖ, p̃ₖ)` of each mode, m √kg/s.
    pub(super) y: [[T; 2]; K],
    /// The offset from what each mode turns about, and how far that moved in the last step.
    pub(super) offset: [[T; 2]; K],
    pub(super) drift: [[T; 2]; K],
    /// The hub torque but for what is proportional to θ̈, and the inertia that is, the hub's
    /// included.
    pub(super) torque: T,
    pub(super) inertia: T,
}

impl<T: Scalar, const K: usize> ElasticaState<T, K> {
    /// With offsets that do not drift.
    pub(super) fn at(y: [[T; 2]; K], value: Value<T, K>) -> Self {
        let Value { offset, torque, inertia } = value;
        Self { y, offset, drift: [[T::ZERO; 2]; K], torque, inertia }
    }

    /// From the prediction `guess` to the corrected state: `correct` is given the mode, its guess
    /// and how much further than expected its offset drifted.
    #[inline(always)]
    pub(super) fn follow(
        &mut self,
        guess: [[T; 2]; K],
        value: Value<T, K>,
        correct: impl Fn(usize, [T; 2], [T; 2]) -> [T; 2],
    ) {
        for k in 0..K {
            let moved = [0, 1].each(|r| value.offset[k][r] - self.offset[k][r]);
            self.y[k] = correct(k, guess[k], [0, 1].map(|r| moved[r] - self.drift[k][r]));
            self.drift[k] = moved;
        }
        self.offset = value.offset;
        self.torque = value.torque;
        self.inertia = value.inertia;
    }
}
