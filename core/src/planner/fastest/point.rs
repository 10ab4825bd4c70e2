//! An interior point of the program, and the changes that belong to a step from it.

use super::grid::Grid;
use crate::math::Scalar;

/// Numbers of the upper and of the lower limit of each row.
pub(super) type Pair<T, const N: usize> = [Grid<T, N>; 2];

/// An interior point.
pub(super) struct Point<T, const N: usize> {
    pub knots: [T; N],
    /// `Ry + o`.
    pub values: Grid<T, N>,
    pub slack: Pair<T, N>,
    pub multiplier: Pair<T, N>,
}

/// Changes in a step: knots, and `R` times that.
pub(super) struct Step<T, const N: usize> {
    pub knots: [T; N],
    pub along: Grid<T, N>,
}

/// Goal of a step: `z s = centred − product` on each side of each row, the products being those of
/// the predictor's changes.
pub(super) struct Goal<T, const N: usize> {
    pub centred: T,
    pub products: Pair<T, N>,
}

/// Longest steps to the boundary, and what `s z` sums up to behind a step.
pub(super) struct Ahead<T> {
    /// Lengths of the step, of slacks and of multipliers, that leave all of them positive.
    pub longest: [T; 2],
    /// Sum of `s z` here, of its slopes by either length, and of the products of the changes.
    pub sums: [T; 4],
}

impl<T: Scalar> Ahead<T> {
    /// Sum of `s z` behind a step of the longest lengths.
    pub fn complementarity(&self) -> T {
        let ([primal, dual], [here, slack, multiplier, both]) = (self.longest, self.sums);
        here + primal * slack + dual * (multiplier + primal * both)
    }
}

/// The upper side and the lower, with their signs.
pub(super) fn signs<T: Scalar>() -> [(usize, T); 2] {
    [(0, T::ONE), (1, -T::ONE)]
}

impl<T: Scalar, const N: usize> Point<T, N> {
    /// Changes of the slack and of the multiplier of one side of a row that belong to a step.
    #[inline(always)]
    pub fn changes(&self, step: &Step<T, N>, goal: &Goal<T, N>, at: [usize; 3]) -> [T; 2] {
        let [side, kind, i] = at;
        let (s, z) = (self.slack[side][kind][i], self.multiplier[side][kind][i]);
        let slack = self.slack_change(step, at);
        let left = goal.centred - goal.products[side][kind][i];
        [slack, (left - z * slack) / s - z]
    }

    /// Change of the slack alone.
    #[inline(always)]
    pub fn slack_change(&self, step: &Step<T, N>, [side, kind, i]: [usize; 3]) -> T {
        let sum = self.values[kind][i] + step.along[kind][i];
        T::ONE - self.slack[side][kind][i] - if side == 0 { sum } else { -sum }
    }
}
