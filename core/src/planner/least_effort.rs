//! The bulge of least effort: of all that leave given amplitudes, the one with the least peak.

use super::Objective;
use super::curve::{bulges, quintic};
use super::linear::{Linear, MAX_AMPLITUDES, NODES};
use crate::math::{Band, Each, Ldl, Scalar, array, dot};
use crate::motion::BULGE;

/// Rounds of re-weighting towards the least greatest value.
const ROUNDS: usize = 2;

/// The bulge of least effort for any target: `base + Σ zᵢ vᵢ` (turns) leaves the amplitudes `z`.
pub(crate) struct LeastEffort<T> {
    pub base: [T; BULGE],
    pub towards: [[T; BULGE]; MAX_AMPLITUDES],
    /// Factors of the effort's matrix.
    factors: Ldl<T, BULGE, BULGE>,
}

impl<T: Scalar> Linear<T> {
    /// Minimises `∫ weight x² dt`, where `x` is the derivative that the objective keeps small. The
    /// weights are moved towards the least greatest `|x|` by Lawson's rule, except where
    /// a mean square is the objective.
    pub fn least_effort(&self, quintic_c: &[T; 5], objective: Objective) -> LeastEffort<T> {
        let order = objective.order();
        let rounds = if objective.is_mean() { 0 } else { ROUNDS };
        let mut weights = [T::ONE; NODES + 1];
        let mut found = self.weighted(quintic_c, order, &weights);
        for _ in 0..rounds {
            let mut most = T::ZERO;
            let mut efforts = [T::ZERO; NODES + 1];
            for node in 0..=NODES {
                let u = node_at(node);
                let x = quintic(quintic_c, u)[order] + dot(&found.base, &bulges(u)[order]);
                efforts[node] = if x < T::ZERO { -x } else { x };
                most = if efforts[node] > most { efforts[node] } else { most };
            }
            if most == T::ZERO {
                break;
            }
            for node in 0..=NODES {
                weights[node] = weights[node] * (T::from_f64(0.05) + efforts[node] / most);
            }
            found = self.weighted(quintic_c, order, &weights);
        }
        found
    }

    /// Minimises `∫ weight x² dt` under the linear model's amplitudes.
    fn weighted(
        &self,
        quintic_c: &[T; 5],
        order: usize,
        weights: &[T; NODES + 1],
    ) -> LeastEffort<T> {
        let mut normal = Band::<T, BULGE, BULGE>::ZERO;
        let mut right = [T::ZERO; BULGE];
        for node in 0..=NODES {
            let u = node_at(node);
            let (b, q) = (bulges(u)[order], quintic(quintic_c, u)[order]);
            for i in 0..BULGE {
                let weighted = weights[node] * b[i];
                right[i] -= weighted * q;
                for j in 0..=i {
                    normal.add(i, j, weighted * b[j]);
                }
            }
        }
        let factors = normal.factor();
        let free = factors.solve(&right);
        let across: [[T; BULGE]; MAX_AMPLITUDES] =
            array(|i| if i < self.count { factors.solve(&self.rows[i]) } else { [T::ZERO; BULGE] });
        let mut gram = Band::<T, MAX_AMPLITUDES, MAX_AMPLITUDES>::ZERO;
        for i in 0..MAX_AMPLITUDES {
            if i >= self.count {
                gram.add(i, i, T::ONE);
                continue;
            }
            for j in 0..=i {
                gram.add(i, j, dot(&self.rows[i], &across[j]));
            }
            gram.add(i, i, gram.get(i, i) * T::EPSILON * T::from_f64(16.0));
        }
        let gram = gram.factor();
        let towards: [[T; BULGE]; MAX_AMPLITUDES] = array(|target| {
            let mut unit = [T::ZERO; MAX_AMPLITUDES];
            unit[target] = T::ONE;
            let share = gram.solve(&unit);
            array(|k| {
                let mut sum = T::ZERO;
                for i in 0..MAX_AMPLITUDES {
                    sum += share[i] * across[i][k];
                }
                sum
            })
        });
        let mut base = free;
        for target in 0..self.count {
            let miss = self.offset[target] + dot(&self.rows[target], &free);
            for k in 0..BULGE {
                base[k] -= miss * towards[target][k];
            }
        }
        LeastEffort { base, towards, factors }
    }
}

/// Position `u` of a node, −1 to 1.
fn node_at<T: Scalar>(node: usize) -> T {
    T::from_f64(2.0 / NODES as f64) * T::from_u32(node as u32) - T::ONE
}

impl<T: Scalar> LeastEffort<T> {
    /// Finds the bulges (turns) of least effort that change one amplitude of `others` by 1 each and
    /// none of `own`, the amplitudes that this was made for. `others` has one or two rows.
    pub fn aside(&self, own: &Linear<T>, others: &Linear<T>) -> [[T; BULGE]; 2] {
        let free: [[T; BULGE]; 2] = array(|j| {
            let mut v = self.factors.solve(&others.rows[j]);
            let on = own.rows.each(|row| dot(&row, &v));
            for i in 0..own.count {
                for k in 0..BULGE {
                    v[k] -= on[i] * self.towards[i][k];
                }
            }
            v
        });
        let mut gram = Band::<T, 2, 2>::ZERO;
        for i in 0..2 {
            for j in 0..=i {
                gram.add(i, j, dot(&others.rows[i], &free[j]));
            }
        }
        if others.count == 1 {
            gram.add(1, 1, T::ONE);
        }
        let gram = gram.factor();
        [[T::ONE, T::ZERO], [T::ZERO, T::ONE]].each(|unit| {
            let share = gram.solve(&unit);
            array(|k| share[0] * free[0][k] + share[1] * free[1][k])
        })
    }

    /// The bulge that leaves the amplitudes `target` by the linear model, turns.
    pub fn bulge(&self, target: &[T; MAX_AMPLITUDES]) -> [T; BULGE] {
        array(|k| {
            let mut sum = self.base[k];
            for i in 0..MAX_AMPLITUDES {
                sum += target[i] * self.towards[i][k];
            }
            sum
        })
    }
}
