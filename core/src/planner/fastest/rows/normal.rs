//! The normal matrix of the rows, `Rᵀ diag(w) R`. It is formed anew in every round of a program,
//! row by row, so that a loop runs along slices and sums in a register.

use super::{Rows, added, area, begun, full};
use crate::math::{Band, Each, Scalar};
use crate::planner::fastest::grid::{ACCELERATION, Grid, JERK, RATE, TORQUE, WINDOW};

impl<T: Scalar, const N: usize> Rows<T, N> {
    /// Adds `Rᵀ diag(w) R`.
    pub fn add_normal(&self, weights: &Grid<T, N>, normal: &mut Band<T, N, N>) {
        let square = |kind: usize| self.per_limit[kind] * self.per_limit[kind];
        for i in 0..N {
            let jerk = square(JERK) * weights[JERK][i];
            normal.add(i, i, square(ACCELERATION) * weights[ACCELERATION][i] + jerk);
            if i + 1 < N {
                normal.add(i + 1, i + 1, jerk);
                normal.add(i + 1, i, -jerk);
            }
        }
        if self.is_limited(RATE) {
            self.add_rates(square(RATE), weights, normal);
        }
        if self.is_used(TORQUE) {
            self.add_torques(square(TORQUE), weights, normal);
        }
        if self.is_used(WINDOW) {
            for i in 0..N {
                let row = &self.windows[i];
                for p in 0..N {
                    let weighted = weights[WINDOW][i] * row[p];
                    let entries = normal.row_mut(p)[..=p].iter_mut().rev();
                    entries.zip(row).for_each(|(entry, other)| *entry += weighted * *other);
                }
            }
        }
    }

    /// Adds the rates' part of the normal matrix. A knot's area is the same for all later
    /// intervals, so those enter by the sum of their weights.
    fn add_rates(&self, square: T, weights: &Grid<T, N>, normal: &mut Band<T, N, N>) {
        let mut later = T::ZERO;
        for p in (0..N).rev() {
            let weight = [0, 1].each(|side| weights[RATE + side][p]);
            let areas = |k: usize| [0, 1].each(|side| area::<T>(k, side));
            // By interval p, by interval p − 1, in which the hat of knot p begins, and by later
            // ones, the other knot's areas being given.
            let here = [0, 1].each(|side| weight[side] * area::<T>(p, side));
            let before = [0, 1].each(|side| {
                if p > 0 { weights[RATE + side][p - 1] * begun::<T>(side) } else { T::ZERO }
            });
            let product = |behind: T, by: [T; 2], begun: [T; 2]| {
                let mut sum = full::<T>(p) * behind * later;
                for side in 0..2 {
                    sum += here[side] * by[side];
                    sum += before[side] * begun[side];
                }
                square * sum
            };
            let row = &mut normal.row_mut(p)[..=p];
            row[0] += product(full(p), areas(p), [0, 1].each(begun::<T>));
            if p > 0 {
                let own = full::<T>(p - 1);
                row[1] += product(own, [own; 2], areas(p - 1));
            }
            if p > 1 {
                // All earlier knots have the same areas here, the first one half of them.
                let product = product(T::ONE, [T::ONE; 2], [T::ONE; 2]);
                row[2..p].iter_mut().for_each(|entry| *entry += product);
                row[p] += T::HALF * product;
            }
            later += weight[0] + weight[1];
        }
    }

    /// Adds the torques' part of the normal matrix. Both factors of a product run through the same
    /// response, a fixed distance apart.
    fn add_torques(&self, square: T, weights: &Grid<T, N>, normal: &mut Band<T, N, N>) {
        for side in 0..2 {
            let (hat, half) = (&self.hat[side], &self.half[side]);
            let weight = weights[TORQUE + side].each(|weight| square * weight);
            let mut sum = normal.row_mut(0)[0];
            for (weight, half) in weight.iter().zip(half) {
                sum += *weight * *half * *half;
            }
            normal.row_mut(0)[0] = sum;
            for p in 1..N {
                // From the interval on in which the hat of knot p begins.
                let row = &mut normal.row_mut(p)[..=p];
                add_row(row, &weight[p - 1..], hat, &half[p - 1..]);
            }
        }
    }
}

/// Adds the products of one knot's torques with those of the knots before it, nearest first: `hat`
/// shifted by none, one, …, and at last the first knot's `half`. On its own, since unrolled for
/// each knot it takes 10 KB.
#[inline(never)]
fn add_row<T: Scalar, const N: usize>(row: &mut [T], weight: &[T], hat: &[T; N], half: &[T]) {
    let mut weighted = *hat;
    for (weighted, weight) in weighted.iter_mut().zip(weight) {
        *weighted = *weight * *weighted;
    }
    // All slices but `weighted` are as long as there are intervals left.
    if let Some((first, others)) = row.split_last_mut() {
        for (sum, hat) in others.iter_mut().zip(hat.windows(weight.len())) {
            *sum = added(*sum, &weighted, hat);
        }
        *first = added(*first, &weighted, half);
    }
}
