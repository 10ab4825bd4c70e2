//! An interior point of the program, and the changes that belong to a step from it.

use super::grid::Grid;
use crate::math::Scalar;

/// Slacks or multipliers of the upper and of the lower limit of each row.
pub(super) type Pair<T, const N: usize> = [Grid<T, N>; 2];

/// An interior point.
pub(super) struct Point<T, const N: usize> {
    pub knots: [T; N],
    pub slack: Pair<T, N>,
    pub multiplier: Pair<T, N>,
}

/// Changes in a step: knots, and `R` times that.
pub(super) struct Step<T, const N: usize> {
    pub knots: [T; N],
    pub along: Grid<T, N>,
}

/// The upper side and the lower, with their signs.
pub(super) fn signs<T: Scalar>() -> [(usize, T); 2] {
    [(0, T::ONE), (1, -T::ONE)]
}

/// Product of the changes that the predictor makes to slack and multiplier; zero for itself.
pub(super) fn product<T: Scalar, const N: usize>(
    point: &Point<T, N>,
    values: &Grid<T, N>,
    affine: Option<&Step<T, N>>,
    at: [usize; 3],
) -> T {
    affine.map_or(T::ZERO, |affine| {
        let [s, z] = changes(point, values, affine, at, T::ZERO, T::ZERO);
        s * z
    })
}

/// Changes of the slack and of the multiplier of one side of a row that belong to a step.
pub(super) fn changes<T: Scalar, const N: usize>(
    point: &Point<T, N>,
    values: &Grid<T, N>,
    step: &Step<T, N>,
    [side, kind, i]: [usize; 3],
    centred: T,
    product: T,
) -> [T; 2] {
    let sign = if side == 0 { T::ONE } else { -T::ONE };
    let (s, z) = (point.slack[side][kind][i], point.multiplier[side][kind][i]);
    let slack = T::ONE - sign * values[kind][i] - s - sign * step.along[kind][i];
    [slack, (centred - product - z * slack) / s - z]
}
