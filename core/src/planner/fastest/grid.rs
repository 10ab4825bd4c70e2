//! Numbers that belong to the rows of the program: one for each limit and place.

use crate::math::Scalar;

/// Kinds of rows: acceleration at the knots, jerk between them, rate and torque at the two nodes of
/// each interval, amplitudes of the first mode that may be left.
pub(super) const KINDS: usize = 7;

/// Index of the acceleration's rows; row `i` is knot `i`.
pub(super) const ACCELERATION: usize = 0;
/// Index of the jerk's rows; row `i` is interval `i`.
pub(super) const JERK: usize = 1;
/// Index of the rate's rows in the middle of the intervals; those at their ends follow.
pub(super) const RATE: usize = 2;
/// Index of the torque's rows in the middle of the intervals; those at their ends follow.
pub(super) const TORQUE: usize = 4;
/// Index of the amplitudes' rows.
pub(super) const WINDOW: usize = 6;

/// A number for each row.
pub(super) type Grid<T, const N: usize> = [[T; N]; KINDS];

/// Values at the nodes: the middle of interval `i` and its end.
pub(super) type Nodes<T, const N: usize> = [[T; N]; 2];

/// All zero.
pub(super) fn zero<T: Scalar, const N: usize>() -> Grid<T, N> {
    [[T::ZERO; N]; KINDS]
}
