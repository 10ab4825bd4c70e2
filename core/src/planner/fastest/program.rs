//! The farthest turn of a given duration within the limits: a quadratic program in the knots.

use super::grid::{Grid, KINDS, zero};
use super::point::{Point, Step, changes, product, signs};
use super::rows::Rows;
use crate::math::{Band, Ldl, Scalar, dot};

/// Most amplitudes that the knots are to leave: both of two modes.
pub(super) const AIMS: usize = 4;

/// Most rounds; five to nine are usual.
const MAX_ROUNDS: u32 = 20;

/// Part of the longest step to the boundary that is gone.
const WITHIN: f64 = 0.97;

/// Least slack and first multiplier of a row, and of the latter times the slack.
const LEAST_SLACK: f64 = 0.1;

/// The program: knots `y` that maximise `g·y − ½Σκᵢ(Eᵢy − eᵢ)² − ½ρΣ(Δy)²` with `|Ry + o| ≤ 1`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Program<T, const N: usize> {
    /// g: turn by each knot, in parts of the turn asked for.
    pub gain: [T; N],
    /// E: amplitude by each knot, of L. The first `count` are in use.
    pub aims: [[T; N]; AIMS],
    /// e, of L.
    pub targets: [T; AIMS],
    /// κ.
    pub weights: [T; AIMS],
    pub count: usize,
    /// ρ.
    pub roughness: T,
    /// True if the first knot is zero: the acceleration does not jump.
    pub smooth: bool,
    /// R.
    pub rows: Rows<T, N>,
    /// o.
    pub offsets: Grid<T, N>,
    /// Gap to the optimum with which the rounds end, in parts of the turn.
    pub gap: T,
}

/// Knots of the farthest turn, and the turn in parts of the one asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Farthest<T, const N: usize> {
    pub knots: [T; N],
    pub reach: T,
}

/// The factors of one round.
struct Factors<T, const N: usize> {
    normal: Ldl<T, N, N>,
    /// `H⁻¹Eᵀ`.
    across: [[T; N]; AIMS],
    gram: Ldl<T, AIMS, AIMS>,
}

impl<T: Scalar, const N: usize> Program<T, N> {
    /// Solves the program by Mehrotra's predictor and corrector, from an infeasible start.
    pub fn solve(&self) -> Farthest<T, N> {
        let mut point = self.start();
        let mut infeasible = T::ONE;
        for _ in 0..MAX_ROUNDS {
            let values = self.values(&point.knots);
            let mu = self.complementarity(&point, None);
            let reach = dot(&self.gain, &point.knots);
            let gap = mu * T::from_u32(2 * self.limited());
            if gap < self.gap * reach && infeasible < T::from_f64(1e-3) {
                break;
            }
            let factors = self.factors(&point);
            let affine = self.step(&point, &values, &factors, T::ZERO, None);
            let ahead = self.longest(&point, &values, &affine, T::ZERO, None);
            let ratio = self.complementarity(&point, Some((&values, &affine, ahead))) / mu;
            let centred = ratio * ratio * ratio * mu;
            let step = self.step(&point, &values, &factors, centred, Some(&affine));
            let [primal, dual] = self.longest(&point, &values, &step, centred, Some(&affine));
            // A matrix that rounding has made singular: the point before is good enough.
            if !dot(&self.gain, &step.knots).is_finite() || !primal.is_finite() {
                break;
            }
            self.advance(&mut point, &values, &step, centred, Some(&affine), [primal, dual]);
            infeasible = infeasible * (T::ONE - primal);
        }
        if self.smooth {
            point.knots[0] = T::ZERO;
        }
        Farthest { knots: point.knots, reach: dot(&self.gain, &point.knots) }
    }

    /// Number of limited rows.
    fn limited(&self) -> u32 {
        (0..KINDS).filter(|&kind| self.rows.is_limited(kind)).count() as u32 * N as u32
    }

    fn start(&self) -> Point<T, N> {
        let mut point =
            Point { knots: [T::ZERO; N], slack: [zero(), zero()], multiplier: [zero(), zero()] };
        let least = T::from_f64(LEAST_SLACK);
        for kind in 0..KINDS {
            for i in 0..N {
                for (side, sign) in signs::<T>() {
                    let slack = T::ONE - sign * self.offsets[kind][i];
                    let slack = if slack > least { slack } else { least };
                    point.slack[side][kind][i] = slack;
                    point.multiplier[side][kind][i] = least / slack;
                }
            }
        }
        point
    }

    /// `Ry + o`.
    pub fn values(&self, knots: &[T; N]) -> Grid<T, N> {
        let mut values = self.rows.times(knots);
        for kind in 0..KINDS {
            for i in 0..N {
                values[kind][i] += self.offsets[kind][i];
            }
        }
        values
    }

    /// `H = Rᵀ(z₊/s₊ + z₋/s₋)R + ρDᵀD`, and the Schur complement of the aims.
    #[inline(never)]
    fn factors(&self, point: &Point<T, N>) -> Factors<T, N> {
        let mut weights = zero();
        for kind in 0..KINDS {
            for i in 0..N {
                for side in 0..2 {
                    weights[kind][i] +=
                        point.multiplier[side][kind][i] / point.slack[side][kind][i];
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
        let mut across = [[T::ZERO; N]; AIMS];
        let mut gram = Band::<T, AIMS, AIMS>::ZERO;
        for i in 0..AIMS {
            if i >= self.count {
                gram.add(i, i, T::ONE);
                continue;
            }
            across[i] = normal.solve(&self.aims[i]);
            for j in 0..=i {
                gram.add(i, j, dot(&self.aims[j], &across[i]));
            }
            gram.add(i, i, T::ONE / self.weights[i]);
        }
        Factors { normal, across, gram: gram.factored() }
    }

    /// The change of the knots by Newton's method on the conditions of optimality, `z s = centred`
    /// less the product of the predictor's changes.
    #[inline(never)]
    fn step(
        &self,
        point: &Point<T, N>,
        values: &Grid<T, N>,
        factors: &Factors<T, N>,
        centred: T,
        affine: Option<&Step<T, N>>,
    ) -> Step<T, N> {
        let mut pull = zero();
        for kind in 0..KINDS {
            for i in 0..N {
                for (side, sign) in signs::<T>() {
                    let slack = point.slack[side][kind][i];
                    let weight = point.multiplier[side][kind][i] / slack;
                    let excess = sign * values[kind][i] + slack - T::ONE;
                    let product = product(point, values, affine, [side, kind, i]);
                    pull[kind][i] += sign * ((centred - product) / slack + weight * excess);
                }
            }
        }
        let pulled = self.rows.transposed(&pull);
        let rough = self.rough(&point.knots);
        let right = core::array::from_fn(|k| self.gain[k] - rough[k] - pulled[k]);
        let free = factors.normal.solve(&right);
        let mut miss = [T::ZERO; AIMS];
        for i in 0..self.count {
            let here = dot(&self.aims[i], &point.knots);
            miss[i] = dot(&self.aims[i], &free) - (self.targets[i] - here);
        }
        let force = factors.gram.solve(&miss);
        let mut knots = free;
        for i in 0..self.count {
            for k in 0..N {
                knots[k] -= force[i] * factors.across[i][k];
            }
        }
        let along = self.rows.times(&knots);
        Step { knots, along }
    }

    /// `ρDᵀD y`.
    fn rough(&self, y: &[T; N]) -> [T; N] {
        core::array::from_fn(|k| {
            let before = if k > 0 { y[k] - y[k - 1] } else { T::ZERO };
            let after = if k + 1 < N { y[k] - y[k + 1] } else { y[k] };
            self.roughness * (before + after)
        })
    }

    /// Lengths of the step, of slacks and of multipliers, that leave all of them positive.
    fn longest(
        &self,
        point: &Point<T, N>,
        values: &Grid<T, N>,
        step: &Step<T, N>,
        centred: T,
        affine: Option<&Step<T, N>>,
    ) -> [T; 2] {
        let within = T::from_f64(WITHIN);
        let mut most = [T::ONE / within; 2];
        self.each(|at| {
            let [side, kind, i] = at;
            let product = product(point, values, affine, at);
            let change = changes(point, values, step, at, centred, product);
            let here = [point.slack[side][kind][i], point.multiplier[side][kind][i]];
            for n in 0..2 {
                if here[n] + most[n] * change[n] < T::ZERO {
                    most[n] = -(here[n] / change[n]);
                }
            }
        });
        most.map(|most| within * most)
    }

    /// Mean of `s z` over the limits, here or a step ahead.
    fn complementarity(
        &self,
        point: &Point<T, N>,
        ahead: Option<(&Grid<T, N>, &Step<T, N>, [T; 2])>,
    ) -> T {
        let mut sum = T::ZERO;
        self.each(|at| {
            let [side, kind, i] = at;
            let mut s = point.slack[side][kind][i];
            let mut z = point.multiplier[side][kind][i];
            if let Some((values, step, [primal, dual])) = ahead {
                let [ds, dz] = changes(point, values, step, at, T::ZERO, T::ZERO);
                (s, z) = (s + primal * ds, z + dual * dz);
            }
            sum += s * z;
        });
        sum / T::from_u32(2 * self.limited())
    }

    fn advance(
        &self,
        point: &mut Point<T, N>,
        values: &Grid<T, N>,
        step: &Step<T, N>,
        centred: T,
        affine: Option<&Step<T, N>>,
        [primal, dual]: [T; 2],
    ) {
        self.each(|at| {
            let [side, kind, i] = at;
            let product = product(point, values, affine, at);
            let [s, z] = changes(point, values, step, at, centred, product);
            point.slack[side][kind][i] += primal * s;
            point.multiplier[side][kind][i] += dual * z;
        });
        for k in 0..N {
            point.knots[k] += primal * step.knots[k];
        }
    }

    /// Calls for both sides of every limited row.
    fn each(&self, mut call: impl FnMut([usize; 3])) {
        for kind in (0..KINDS).filter(|&kind| self.rows.is_limited(kind)) {
            for i in 0..N {
                for side in 0..2 {
                    call([side, kind, i]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{AIMS, Program};
    use crate::planner::fastest::grid::{RATE, zero};
    use crate::planner::fastest::rows::{Bounds, Rows};

    fn program(aim: [f64; 4], count: usize, rate: Option<f64>) -> Program<f64, 4> {
        let bounds = Bounds { acceleration: Some(1.0), jerk: None, rate, torque: None };
        let mut aims = [[0.0; 4]; AIMS];
        aims[0] = aim;
        Program {
            gain: [4.0, 3.0, 2.0, 1.0],
            aims,
            targets: [0.0; AIMS],
            weights: [1e9; AIMS],
            count,
            roughness: 1e-12,
            smooth: false,
            rows: Rows::new(&bounds, [[0.0; 4]; 2], [[0.0; 4]; 2]),
            offsets: zero(),
            gap: 1e-10,
        }
    }

    /// Without anything else every knot is at its limit.
    #[test]
    fn limits_are_reached() {
        let found = program([0.0; 4], 0, None).solve();
        assert!((found.reach - 10.0).abs() < 1e-7, "{found:?}");
    }

    /// `y₀ + y₁ + y₂ + y₃ = 0` takes the sign of the two least knots.
    #[test]
    fn an_aim_is_met_at_the_least_cost() {
        let found = program([1.0; 4], 1, None).solve();
        assert!((found.reach - 4.0).abs() < 1e-6, "{found:?}");
        assert!(found.knots.iter().sum::<f64>().abs() < 1e-6, "{found:?}");
    }

    /// The rate reaches its limit, the area of a hat, and does not exceed it at any node.
    #[test]
    fn the_rate_binds() {
        let program = program([0.0; 4], 0, Some(1.0));
        let found = program.solve();
        assert!((found.knots[0] - 1.0).abs() < 1e-6, "{found:?}");
        let values = program.values(&found.knots);
        let most = values[RATE..RATE + 2].iter().flatten().copied().fold(0.0, f64::max);
        assert!((most - 1.0).abs() < 1e-6, "{most} {found:?}");
    }
}
