//! One step of Newton's method on the program's conditions of optimality.

use super::{AIMS, Program};
use crate::math::{Band, Each, Ldl, Scalar, array, dot};
use crate::planner::fastest::grid::{TORQUE, zero};
use crate::planner::fastest::point::{Goal, Point, Step};

/// Most conditions that must hold: those, and the turn where it is not what is to be greatest.
const CONDITIONS: usize = AIMS + 1;

/// Weight of the turn's condition.
const TURN_WEIGHT: f64 = 1e5;

/// The factors of one round.
pub(super) struct Factors<T, const N: usize> {
    normal: Ldl<T, N, N>,
    /// `H⁻¹Eᵀ`.
    across: [[T; N]; CONDITIONS],
    gram: Ldl<T, CONDITIONS, CONDITIONS>,
}

impl<T: Scalar, const N: usize> Program<T, N> {
    /// `H = Rᵀ(z₊/s₊ + z₋/s₋)R + ρDᵀD`, and the Schur complement of the aims.
    #[inline(never)]
    pub(super) fn factors(&self, point: &Point<T, N>) -> Factors<T, N> {
        let mut weights = zero();
        for kind in self.limited_kinds() {
            for i in 0..N {
                let [above, below] = [0, 1]
                    .each(|side| point.multiplier[side][kind][i] / point.slack[side][kind][i]);
                weights[kind][i] = above + below;
            }
        }
        if self.effort != T::ZERO {
            for side in 0..2 {
                for i in 0..N {
                    weights[TORQUE + side][i] += self.effort;
                }
            }
        }
        let mut normal = Band::ZERO;
        self.rows.add_normal(&weights, &mut normal);
        for i in 0..N {
            normal.add(i, i, self.roughness);
            if i + 1 < N {
                normal.add(i + 1, i + 1, self.roughness);
                normal.add(i + 1, i, -self.roughness);
            }
        }
        if self.smooth {
            // So stiff that the first knot stays where it is, at zero.
            normal.add(0, 0, T::from_f64(1e12));
        }
        let normal = normal.factored();
        let mut across = [[T::ZERO; N]; CONDITIONS];
        let mut gram = Band::<T, CONDITIONS, CONDITIONS>::ZERO;
        for i in 0..CONDITIONS {
            let Some((row, _, weight)) = self.condition(i) else {
                gram.add(i, i, T::ONE);
                continue;
            };
            across[i] = normal.solve(row);
            for j in 0..=i {
                if let Some((other, ..)) = self.condition(j) {
                    gram.add(i, j, dot(other, &across[i]));
                }
            }
            gram.add(i, i, T::ONE / weight);
        }
        Factors { normal, across, gram: gram.factored() }
    }

    /// The change of the knots by Newton's method on the conditions of optimality.
    #[inline(never)]
    pub(super) fn step(
        &self,
        point: &Point<T, N>,
        factors: &Factors<T, N>,
        goal: &Goal<T, N>,
    ) -> Step<T, N> {
        let mut pull = zero();
        for kind in self.limited_kinds() {
            for i in 0..N {
                let value = point.values[kind][i];
                let [above, below] = [(0, value), (1, -value)].map(|(side, value)| {
                    let s = point.slack[side][kind][i];
                    let z = point.multiplier[side][kind][i];
                    let left = goal.centred - goal.products[side][kind][i];
                    (left + z * (value + s - T::ONE)) / s
                });
                pull[kind][i] = above - below;
            }
        }
        if self.effort != T::ZERO {
            for side in 0..2 {
                for i in 0..N {
                    pull[TORQUE + side][i] += self.effort * point.values[TORQUE + side][i];
                }
            }
        }
        let pulled = self.rows.transposed(&pull);
        let rough = self.rough(&point.knots);
        let gain = if self.effort == T::ZERO { T::ONE } else { T::ZERO };
        let right = array(|k| gain * self.gain[k] - rough[k] - pulled[k]);
        let free = factors.normal.solve(&right);
        let mut miss = [T::ZERO; CONDITIONS];
        for i in 0..CONDITIONS {
            if let Some((row, target, _)) = self.condition(i) {
                miss[i] = dot(row, &free) - (target - dot(row, &point.knots));
            }
        }
        let force = factors.gram.solve(&miss);
        let mut knots = free;
        for i in 0..CONDITIONS {
            for k in 0..N {
                knots[k] -= force[i] * factors.across[i][k];
            }
        }
        let along = self.rows.times(&knots);
        Step { knots, along }
    }

    /// A condition: its row, its target, its weight.
    fn condition(&self, i: usize) -> Option<(&[T; N], T, T)> {
        if i < self.count {
            return Some((&self.aims[i], self.targets[i], self.weights[i]));
        }
        let turns = i == AIMS && self.effort != T::ZERO;
        turns.then_some((&self.gain, self.turn, T::from_f64(TURN_WEIGHT)))
    }

    /// `ρDᵀD y`.
    fn rough(&self, y: &[T; N]) -> [T; N] {
        array(|k| {
            let before = if k > 0 { y[k] - y[k - 1] } else { T::ZERO };
            let after = if k + 1 < N { y[k] - y[k + 1] } else { y[k] };
            self.roughness * (before + after)
        })
    }
}
