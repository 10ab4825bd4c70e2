//! The farthest turn of a given duration within the limits: a quadratic program in the knots.

mod newton;

use super::grid::{Grid, KINDS, zero};
use super::point::{Ahead, Goal, Pair, Point, Step, signs};
use super::rows::Rows;
use crate::math::{Scalar, dot};

/// Most amplitudes that the knots are to leave: both of two modes.
pub(super) const AIMS: usize = 4;

/// Most rounds; five to nine are usual.
const MAX_ROUNDS: u32 = 20;

/// Part of the longest step to the boundary that is gone.
const WITHIN: f64 = 0.97;

/// Least slack and first multiplier of a row, and of the latter times the slack.
const LEAST_SLACK: f64 = 0.1;

/// The program: knots `y` that maximise `g·y − ½Σκᵢ(Eᵢy − eᵢ)² − ½ρΣ(Δy)²` with `|Ry + o| ≤ 1`.
///
/// With an effort it is the turn that is asked for, and `½ηΣτ²` that is least.
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
    /// Turn that is asked for with an effort, in parts of the turn asked for.
    pub turn: T,
    /// η, the weight of the squared torque at the nodes; zero where the turn is to be greatest.
    pub effort: T,
    /// Gap to the optimum with which the rounds end, in parts of the turn.
    pub gap: T,
}

/// Knots of the farthest turn, and the turn in parts of the one asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Farthest<T, const N: usize> {
    pub knots: [T; N],
    pub reach: T,
}

impl<T: Scalar, const N: usize> Program<T, N> {
    /// Solves the program by Mehrotra's predictor and corrector, from an infeasible start.
    pub fn solve(&self) -> Farthest<T, N> {
        let mut point = self.start();
        let mut infeasible = T::ONE;
        for _ in 0..MAX_ROUNDS {
            let sum = self.complementarity(&point);
            let reach = dot(&self.gain, &point.knots);
            if sum < self.gap * reach && infeasible < T::from_f64(1e-3) {
                break;
            }
            let factors = self.factors(&point);
            let mut goal = Goal { centred: T::ZERO, products: [zero(), zero()] };
            let affine = self.step(&point, &factors, &goal);
            let ahead = self.ahead(&point, &affine, &mut goal, |[ds, dz]| ds * dz);
            let ratio = if sum > T::ZERO { ahead.complementarity() / sum } else { T::ZERO };
            goal.centred = ratio * ratio * ratio * sum / T::from_u32(2 * self.limited().max(1));
            let step = self.step(&point, &factors, &goal);
            // The products have done their part, and leave their place to the multipliers' changes.
            let [primal, dual] = self.ahead(&point, &step, &mut goal, |[_, dz]| dz).longest;
            // A matrix that rounding has made singular: the point before is good enough.
            if !dot(&self.gain, &step.knots).is_finite() || !primal.is_finite() {
                break;
            }
            self.advance(&mut point, &step, &goal.products, [primal, dual]);
            infeasible = infeasible * (T::ONE - primal);
        }
        if self.smooth {
            point.knots[0] = T::ZERO;
        }
        Farthest { knots: point.knots, reach: dot(&self.gain, &point.knots) }
    }

    /// Number of limited rows.
    fn limited(&self) -> u32 {
        self.limited_kinds().count() as u32 * N as u32
    }

    fn start(&self) -> Point<T, N> {
        let mut point = Point {
            knots: [T::ZERO; N],
            values: self.offsets,
            slack: [zero(), zero()],
            multiplier: [zero(), zero()],
        };
        let least = T::from_f64(LEAST_SLACK);
        for kind in self.limited_kinds() {
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

    fn limited_kinds(&self) -> impl Iterator<Item = usize> + '_ {
        (0..KINDS).filter(|&kind| self.rows.is_limited(kind))
    }

    /// Looks along a step to the boundary. In place of the goal's products it keeps what `keep`
    /// makes of the changes of slack and multiplier, so that these are computed once.
    #[inline(never)]
    fn ahead(
        &self,
        point: &Point<T, N>,
        step: &Step<T, N>,
        goal: &mut Goal<T, N>,
        keep: impl Fn([T; 2]) -> T,
    ) -> Ahead<T> {
        let within = T::from_f64(WITHIN);
        let mut most = [T::ONE / within; 2];
        let mut sums = [T::ZERO; 4];
        self.each(|at| {
            let [side, kind, i] = at;
            let [ds, dz] = point.changes(step, goal, at);
            let (s, z) = (point.slack[side][kind][i], point.multiplier[side][kind][i]);
            if s + most[0] * ds < T::ZERO {
                most[0] = -(s / ds);
            }
            if z + most[1] * dz < T::ZERO {
                most[1] = -(z / dz);
            }
            sums[0] += s * z;
            sums[1] += z * ds;
            sums[2] += s * dz;
            sums[3] += ds * dz;
            goal.products[side][kind][i] = keep([ds, dz]);
        });
        Ahead { longest: most.map(|most| within * most), sums }
    }

    /// Sum of `s z` over the limits.
    fn complementarity(&self, point: &Point<T, N>) -> T {
        let mut sum = T::ZERO;
        self.each(|[side, kind, i]| {
            sum += point.slack[side][kind][i] * point.multiplier[side][kind][i];
        });
        sum
    }

    /// Goes along a step, whose changes of the multipliers are given.
    #[inline(never)]
    fn advance(
        &self,
        point: &mut Point<T, N>,
        step: &Step<T, N>,
        multipliers: &Pair<T, N>,
        [primal, dual]: [T; 2],
    ) {
        self.each(|at| {
            let [side, kind, i] = at;
            point.slack[side][kind][i] += primal * point.slack_change(step, at);
            point.multiplier[side][kind][i] += dual * multipliers[side][kind][i];
        });
        for k in 0..N {
            point.knots[k] += primal * step.knots[k];
        }
        for kind in (0..KINDS).filter(|&kind| self.rows.is_used(kind)) {
            for i in 0..N {
                point.values[kind][i] += primal * step.along[kind][i];
            }
        }
    }

    /// Calls for both sides of every limited row.
    #[inline(always)]
    fn each(&self, mut call: impl FnMut([usize; 3])) {
        for kind in self.limited_kinds() {
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
        let acceleration = Some(1.0);
        let bounds = Bounds { acceleration, jerk: None, rate, torque: None, effort: None };
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
            turn: 1.0,
            effort: 0.0,
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

    /// Torques as the knots themselves: of all knots with `g·y = 1` the least sum of squares is
    /// proportional to g.
    #[test]
    fn the_least_effort_is_along_the_gain() {
        let mut program = program([0.0; 4], 0, None);
        let none = None;
        let effort = Some(1.0);
        let bounds = Bounds { acceleration: none, jerk: none, rate: none, torque: none, effort };
        // Middle of an interval: nothing. Its end: the knot that begins there.
        let unit = [[0.0; 4], [1.0, 0.0, 0.0, 0.0]];
        program.rows = Rows::new(&bounds, unit, [[0.0; 4]; 2]);
        program.effort = 1.0;
        program.gain = [0.0, 3.0, 2.0, 1.0];
        program.smooth = true;
        let found = program.solve();
        assert!((found.reach - 1.0).abs() < 1e-4, "{found:?}");
        for (knot, gain) in found.knots.iter().zip(program.gain) {
            assert!((knot - gain / 14.0).abs() < 1e-4, "{found:?}");
        }
    }
}
