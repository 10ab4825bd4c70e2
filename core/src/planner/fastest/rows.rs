//! Rows of the program: every limited quantity as a linear function of the knots, over its limit.

mod normal;

use super::grid::{ACCELERATION, Grid, JERK, KINDS, Nodes, RATE, TORQUE, WINDOW, zero};
use crate::math::{Each, Scalar, array, dot};

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
    /// Torque in parts of which its rows are written where it has no limit but counts.
    pub effort: Option<T>,
}

/// The rows, which are shifted copies of a few tables.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rows<T, const N: usize> {
    /// `1/limit` of each kind; zero where there is none.
    per_limit: [T; KINDS],
    /// True for the kinds that have a limit.
    limited: [bool; KINDS],
    /// Torque at the nodes after the beginning of a hat, and of the falling half.
    hat: Nodes<T, N>,
    half: Nodes<T, N>,
    /// Amplitudes by each knot, over what may be left; rows without one are zero.
    windows: [[T; N]; N],
}

impl<T: Scalar, const N: usize> Rows<T, N> {
    /// Makes the rows from the torque that a hat and the falling half of one need.
    pub fn new(bounds: &Bounds<T>, hat: Nodes<T, N>, half: Nodes<T, N>) -> Self {
        let per = |limit: Option<T>| limit.map_or(T::ZERO, |limit| T::ONE / limit);
        let Bounds { acceleration, jerk, rate, torque, effort } = *bounds;
        let limits = [acceleration, jerk, rate, rate, torque, torque, None];
        let limited = limits.map(|limit| limit.is_some());
        let mut per_limit = limits.map(per);
        if torque.is_none() {
            (per_limit[TORQUE], per_limit[TORQUE + 1]) = (per(effort), per(effort));
        }
        Self { per_limit, limited, hat, half, windows: [[T::ZERO; N]; N] }
    }

    /// Keeps the amplitudes that `windows` give, each over what may be left, within `±1`.
    pub fn within(mut self, windows: &[[T; N]; N]) -> Self {
        (self.windows, self.limited[WINDOW], self.per_limit[WINDOW]) = (*windows, true, T::ONE);
        self
    }

    /// True if the kind has rows, with a limit or without one.
    pub fn is_used(&self, kind: usize) -> bool {
        self.per_limit[kind] != T::ZERO
    }

    /// True if the kind is limited.
    pub fn is_limited(&self, kind: usize) -> bool {
        self.limited[kind]
    }

    /// `R y`. Rates are running sums and torques shifted copies of one response, so that no row is
    /// ever written out.
    pub fn times(&self, y: &[T; N]) -> Grid<T, N> {
        let mut values = zero();
        let next = |i: usize| if i + 1 < N { y[i + 1] } else { T::ZERO };
        let mut rate = T::ZERO;
        for i in 0..N {
            values[ACCELERATION][i] = self.per_limit[ACCELERATION] * y[i];
            values[JERK][i] = self.per_limit[JERK] * (next(i) - y[i]);
            values[RATE][i] =
                self.per_limit[RATE] * (rate + eighths::<T>(3) * y[i] + eighths::<T>(1) * next(i));
            rate += T::HALF * (y[i] + next(i));
            values[RATE + 1][i] = self.per_limit[RATE] * rate;
        }
        if self.is_used(TORQUE) {
            for side in 0..2 {
                let (hat, per) = (&self.hat[side], self.per_limit[TORQUE]);
                for i in 0..N {
                    let mut sum = self.half[side][i] * y[0];
                    for k in 1..(i + 2).min(N) {
                        sum += hat[i + 1 - k] * y[k];
                    }
                    values[TORQUE + side][i] = per * sum;
                }
            }
        }
        if self.is_used(WINDOW) {
            values[WINDOW] = array(|i| dot(&self.windows[i], y));
        }
        values
    }

    /// `Rᵀ w`.
    pub fn transposed(&self, weights: &Grid<T, N>) -> [T; N] {
        let mut sum = [T::ZERO; N];
        let [acceleration, jerk, rate] =
            [ACCELERATION, JERK, RATE].map(|kind| self.per_limit[kind]);
        // Weights of the rates of all later intervals.
        let mut later = T::ZERO;
        for k in (0..N).rev() {
            let before = |kind: usize| if k > 0 { weights[kind][k - 1] } else { T::ZERO };
            let mut areas = full::<T>(k) * later;
            for side in 0..2 {
                areas += area::<T>(k, side) * weights[RATE + side][k];
                areas += begun::<T>(side) * before(RATE + side);
                later += weights[RATE + side][k];
            }
            sum[k] = acceleration * weights[ACCELERATION][k]
                + jerk * (before(JERK) - weights[JERK][k])
                + rate * areas;
        }
        if self.is_used(TORQUE) {
            for side in 0..2 {
                let (hat, per) = (&self.hat[side], self.per_limit[TORQUE]);
                let weight = weights[TORQUE + side].each(|weight| per * weight);
                sum[0] = added(sum[0], &weight, &self.half[side]);
                for k in 1..N {
                    sum[k] = added(sum[k], &weight[k - 1..], hat);
                }
            }
        }
        if self.is_used(WINDOW) {
            for i in 0..N {
                for k in 0..N {
                    sum[k] += weights[WINDOW][i] * self.windows[i][k];
                }
            }
        }
        sum
    }
}

/// `sum + Σ aᵢ bᵢ`.
#[inline(always)]
fn added<T: Scalar>(mut sum: T, a: &[T], b: &[T]) -> T {
    for (a, b) in a.iter().zip(b) {
        sum += *a * *b;
    }
    sum
}

/// Area of knot `k` behind its hat, in parts of an interval. The first knot has half a hat.
fn full<T: Scalar>(k: usize) -> T {
    if k == 0 { T::HALF } else { T::ONE }
}

/// Area of knot `k` up to a node of interval `k`: its middle or its end.
fn area<T: Scalar>(k: usize, side: usize) -> T {
    match (side, k) {
        (0, 0) => eighths(3),
        (0, _) => eighths(7),
        _ => full(k),
    }
}

/// Area of a hat up to a node of the interval in which it begins.
fn begun<T: Scalar>(side: usize) -> T {
    if side == 0 { eighths(1) } else { T::HALF }
}

fn eighths<T: Scalar>(n: u32) -> T {
    T::from_f64(0.125) * T::from_u32(n)
}

#[cfg(test)]
mod tests {
    use super::{Bounds, Rows};
    use crate::math::Band;
    use crate::planner::fastest::grid::{Grid, KINDS, RATE, TORQUE};

    /// The rate at the nodes is the integral of the knots' straight lines.
    #[test]
    fn rates_are_areas() {
        let bounds =
            Bounds { rate: Some(1.0), acceleration: None, jerk: None, torque: None, effort: None };
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
        let rows = all_kinds();
        let row = |kind: usize, i: usize| column_by_column(&rows)[kind][i];
        assert_eq!(row(TORQUE, 0), [2.5, 0.5, 0.0, 0.0]);
        assert_eq!(row(TORQUE + 1, 2), [35.0, 15.0, 10.0, 5.0]);
        assert_eq!(row(TORQUE, 3), [4.0, 2.0, 1.5, 1.0]);
    }

    fn all_kinds() -> Rows<f64, 4> {
        let hat = [[1.0, 2.0, 3.0, 4.0], [10.0, 20.0, 30.0, 40.0]];
        let half = [[5.0, 6.0, 7.0, 8.0], [50.0, 60.0, 70.0, 80.0]];
        let (acceleration, jerk) = (Some(0.5), Some(0.25));
        let (rate, torque) = (Some(0.125), Some(2.0));
        let mut windows = [[0.0; 4]; 4];
        windows[0] = [0.3, -0.2, 0.5, 0.7];
        windows[1] = [-0.1, 0.4, 0.6, -0.8];
        Rows::new(&Bounds { acceleration, jerk, rate, torque, effort: None }, hat, half)
            .within(&windows)
    }

    /// All rows, from their products with unit vectors.
    fn column_by_column(rows: &Rows<f64, 4>) -> [[[f64; 4]; 4]; KINDS] {
        let mut all = [[[0.0; 4]; 4]; KINDS];
        for k in 0..4 {
            let values = rows.times(&core::array::from_fn(|i| if i == k { 1.0 } else { 0.0 }));
            for kind in 0..KINDS {
                for i in 0..4 {
                    all[kind][i][k] = values[kind][i];
                }
            }
        }
        all
    }

    /// The transposed product and the normal matrix are those of the rows written out.
    #[test]
    fn products_are_those_of_the_matrix() {
        let rows = all_kinds();
        let all = column_by_column(&rows);
        let weights: Grid<f64, 4> = core::array::from_fn(|kind| {
            core::array::from_fn(|i| 1.0 + 0.3 * kind as f64 - 0.7 * i as f64)
        });
        let transposed = rows.transposed(&weights);
        let mut normal = Band::ZERO;
        rows.add_normal(&weights, &mut normal);
        for p in 0..4 {
            let sum = |other: &dyn Fn(&[f64; 4]) -> f64| {
                let mut sum = 0.0;
                for kind in 0..KINDS {
                    for i in 0..4 {
                        sum += weights[kind][i] * all[kind][i][p] * other(&all[kind][i]);
                    }
                }
                sum
            };
            let (found, is) = (transposed[p], sum(&|_| 1.0));
            assert!((found - is).abs() < 1e-9 * is.abs().max(1.0), "{p}: {found} is not {is}");
            for q in 0..=p {
                let (found, is) = (normal.get(p, q), sum(&|row| row[q]));
                assert!((found - is).abs() < 1e-9 * is.abs().max(1.0), "{p}, {q}: {found}, {is}");
            }
        }
    }
}
