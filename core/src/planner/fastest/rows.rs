//! Rows of the program: every limited quantity as a linear function of the knots, over its limit.

use super::grid::{ACCELERATION, Grid, JERK, KINDS, Nodes, RATE, TORQUE, zero};
use crate::math::{Band, Scalar};

/// Largest values that the rows may take; `None` is unlimited. In units of the knots' scale:
/// acceleration, and jerk, rate and torque per acceleration.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds<T> {
    pub acceleration: Option<T>,
    /// Change of θ̈ over an interval.
    pub jerk: Option<T>,
    /// Rate, in units of the area of a hat.
    pub rate: Option<T>,
    /// Torque.
    pub torque: Option<T>,
}

/// The rows, which are shifted copies of a few tables.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rows<T, const N: usize> {
    /// `1/limit` of each kind; zero where there is none.
    per_limit: [T; KINDS],
    /// Torque at the nodes after the beginning of a hat, and of the falling half.
    hat: Nodes<T, N>,
    half: Nodes<T, N>,
}

impl<T: Scalar, const N: usize> Rows<T, N> {
    /// Makes the rows from the torque that a hat and the falling half of one need.
    pub fn new(bounds: &Bounds<T>, hat: Nodes<T, N>, half: Nodes<T, N>) -> Self {
        let per = |limit: Option<T>| limit.map_or(T::ZERO, |limit| T::ONE / limit);
        let Bounds { acceleration, jerk, rate, torque } = *bounds;
        let per_limit =
            [per(acceleration), per(jerk), per(rate), per(rate), per(torque), per(torque)];
        Self { per_limit, hat, half }
    }

    /// True if the kind is limited.
    pub fn is_limited(&self, kind: usize) -> bool {
        self.per_limit[kind] != T::ZERO
    }

    /// Returns a row and the number of knots on which it depends.
    pub fn row(&self, kind: usize, i: usize) -> ([T; N], usize) {
        let mut row = [T::ZERO; N];
        let per = self.per_limit[kind];
        let eighth = |n: u32| T::from_f64(0.125) * T::from_u32(n) * per;
        match kind {
            ACCELERATION => row[i] = per,
            JERK => {
                row[i] = -per;
                if i + 1 < N {
                    row[i + 1] = per;
                }
            }
            _ => {
                let side = kind % 2;
                let rates = kind < TORQUE;
                for k in 0..=i {
                    let after = i - k;
                    row[k] = match (rates, k, after) {
                        // Areas of a hat up to a node, in parts of an interval.
                        (true, 0, 0) if side == 0 => eighth(3),
                        (true, 0, _) => eighth(4),
                        (true, _, 0) if side == 0 => eighth(7),
                        (true, ..) => eighth(8),
                        (false, 0, _) => per * self.half[side][after],
                        (false, ..) if after + 1 < N => per * self.hat[side][after + 1],
                        (false, ..) => T::ZERO,
                    };
                }
                // The hat that has begun within this interval.
                if i + 1 < N {
                    let begun = if rates { eighth(if side == 0 { 1 } else { 4 }) } else { per };
                    row[i + 1] = if rates { begun } else { per * self.hat[side][0] };
                }
            }
        }
        (row, (i + 2).min(N))
    }

    /// `R y`.
    pub fn times(&self, y: &[T; N]) -> Grid<T, N> {
        let mut values = zero();
        self.each(|kind, i, row, count| {
            let mut sum = T::ZERO;
            for k in 0..count {
                sum += row[k] * y[k];
            }
            values[kind][i] = sum;
        });
        values
    }

    /// `Rᵀ w`.
    pub fn transposed(&self, weights: &Grid<T, N>) -> [T; N] {
        let mut sum = [T::ZERO; N];
        self.each(|kind, i, row, count| {
            for k in 0..count {
                sum[k] += row[k] * weights[kind][i];
            }
        });
        sum
    }

    /// Adds `Rᵀ diag(w) R`.
    pub fn add_normal(&self, weights: &Grid<T, N>, normal: &mut Band<T, N, N>) {
        self.each(|kind, i, row, count| {
            let from = if kind < RATE { i } else { 0 };
            for p in from..count {
                let weighted = weights[kind][i] * row[p];
                for q in from..=p {
                    normal.add(p, q, weighted * row[q]);
                }
            }
        });
    }

    /// Calls for every row of the limited kinds.
    fn each(&self, mut call: impl FnMut(usize, usize, &[T; N], usize)) {
        for kind in 0..KINDS {
            if !self.is_limited(kind) {
                continue;
            }
            for i in 0..N {
                let (row, count) = self.row(kind, i);
                call(kind, i, &row, count);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Bounds, Rows};
    use crate::planner::fastest::grid::{RATE, TORQUE};

    /// The rate at the nodes is the integral of the knots' straight lines.
    #[test]
    fn rates_are_areas() {
        let bounds =
            Bounds { acceleration: None, jerk: None, rate: Some(1.0), torque: None::<f64> };
        let rows = Rows::<f64, 4>::new(&bounds, [[0.0; 4]; 2], [[0.0; 4]; 2]);
        let y = [3.0, -1.0, 2.0, 5.0];
        let values = rows.times(&y);
        let (mut rate, mut before) = (0.0, y[0]);
        for i in 0..4 {
            let after = if i < 3 { y[i + 1] } else { 0.0 };
            let middle = 0.5 * (before + after);
            let half = rate + 0.25 * (before + middle);
            rate += 0.5 * (before + after);
            assert!((values[RATE][i] - half).abs() < 1e-15, "{values:?}");
            assert!((values[RATE + 1][i] - rate).abs() < 1e-15, "{values:?}");
            before = after;
        }
    }

    /// A row of the torque holds the response to each knot, shifted by whole intervals.
    #[test]
    fn responses_are_shifted() {
        let hat = [[1.0, 2.0, 3.0, 4.0], [10.0, 20.0, 30.0, 40.0]];
        let half = [[5.0, 6.0, 7.0, 8.0], [50.0, 60.0, 70.0, 80.0]];
        let bounds = Bounds { acceleration: None, jerk: None, rate: None, torque: Some(2.0_f64) };
        let rows = Rows::<f64, 4>::new(&bounds, hat, half);
        assert_eq!(rows.row(TORQUE, 0).0, [2.5, 0.5, 0.0, 0.0]);
        assert_eq!(rows.row(TORQUE + 1, 2).0, [35.0, 15.0, 10.0, 5.0]);
        assert_eq!(rows.row(TORQUE, 3).0, [4.0, 2.0, 1.5, 1.0]);
    }
}
