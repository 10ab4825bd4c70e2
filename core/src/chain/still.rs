//! Moves of all joints of an open chain after which its links do not vibrate.
//!
//! Each joint turns by a quintic that bulges by `(1 − u²)³ (b₀ + b₁u + b₂u²)`. The bulges leave the
//! first modes, one a link that bends, at rest at the final pose, place and rate, with the least
//! `∫Σ(J_j b̈_j)² dt`, `J_j` the inertia that joint j turns. What a bulge does is found by flights,
//! runs of the chain itself; the derivative is renewed where progress stalls.

use super::modes::ChainModes;
use super::solve::Factors;
use super::{Chain, ChainGenerator, ChainState};
use crate::Error;
use crate::math::{Complex, Scalar, sqrt};
use crate::mechanism::Mechanism;
use crate::motion::{BULGE, Limits, Move};

/// Coefficients of a joint's bulge.
const TERMS: usize = 3;
/// Most flights of a plan.
const FLIGHTS: u32 = 90;
/// Flights are made in steps of a tick over this.
const FINER: u32 = 4;
/// Amplitude at the tip, of all lengths, at which the search has ended.
const DONE: f64 = 2e-6;
/// Deviation of any joint or the tip in the first period after the end, of all lengths, up to which
/// a plan is given out.
const STILL: f64 = 1e-3;
/// A search that leaves more than this of the amplitude before takes the derivative anew.
const STALLED: f64 = 0.25;
/// Change of a coefficient for the derivative, rad.
const NUDGE: f64 = 4e-3;

/// A planned move of all joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainPlan<const LINKS: usize> {
    /// The move of each joint; they take equally long.
    pub moves: [Move; LINKS],
    /// Largest deviation of a joint or the tip from its final place in the first period after the
    /// end, over the sum of the lengths.
    pub residual: f64,
    /// Largest torque of each joint's motor on the way, N m.
    pub torque: [f64; LINKS],
    /// Flights that the search took.
    pub flights: u32,
}

/// Plans moves of an open chain between two poses at rest.
#[derive(Clone, Copy, Debug)]
pub struct ChainPlanner<T, const LINKS: usize, const W: usize, const C: usize, const Q: usize> {
    /// The chain in the steps of flights.
    chain: Chain<T, LINKS, W, C, Q>,
    tick: f64,
    limits: [Limits; LINKS],
}

/// Bulges of all joints.
type Bulges<const LINKS: usize> = [[f64; TERMS]; LINKS];
/// What is left of each mode: tip deflection by its place and by its rate over its frequency, m.
type Left<const LINKS: usize> = [[f64; 2]; LINKS];

/// One search: the request and what does not change in it.
struct Search<'a, T, const LINKS: usize, const W: usize, const C: usize, const Q: usize> {
    planner: &'a ChainPlanner<T, LINKS, W, C, Q>,
    begin: ChainState<T, LINKS, W>,
    end: ChainState<T, LINKS, W>,
    modes: ChainModes<LINKS, C>,
    to: [f64; LINKS],
    duration: f64,
    flights: u32,
}

/// What a flight shows.
struct Flight<T, const LINKS: usize, const W: usize> {
    state: ChainState<T, LINKS, W>,
    torque: [f64; LINKS],
    /// Largest deviation after the end, m.
    deviation: f64,
}

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    ChainPlanner<T, LINKS, W, C, Q>
{
    /// For setpoints every `tick` s. Computes in `T` where it flies, in f64 elsewhere.
    ///
    /// # Errors
    /// Those of [`Chain::new`]; a passive joint or a loop, which nothing brings to rest.
    pub fn new(mechanism: &Mechanism, tick: f64) -> Result<Self, Error> {
        let chain = Chain::new(mechanism, tick / f64::from(FINER))?;
        for j in 0..LINKS {
            if !chain.is_driven(j, false) || mechanism.closure.is_some() {
                return Err(Error::PassiveJoint { parameter: "joints", joint: j + 1 });
            }
        }
        Ok(Self { chain, tick, limits: [Limits::default(); LINKS] })
    }

    /// With limits for each joint, of its motion and of its motor's torque.
    ///
    /// # Errors
    /// A limit that is no number, or one of a clamp's moment, which a chain does not tell.
    pub fn with_limits(self, limits: [Limits; LINKS]) -> Result<Self, Error> {
        for limits in limits {
            if let Some(value) = limits.validate()?.moment {
                let (parameter, unit) = ("limits.moment", "N m");
                return Err(Error::CannotCheck { parameter, value, unit });
            }
        }
        Ok(Self { limits, ..self })
    }

    /// First period at the pose `angles`, rad; s. Moves from 1.5 of them on arrive still.
    ///
    /// # Errors
    /// Those of [`Chain::modes`].
    pub fn period(&self, angles: &[f64; LINKS]) -> Result<f64, Error> {
        self.chain.modes(angles).map(|modes| modes.period())
    }

    /// Plans the move of all joints from rest at `from` to rest at `to`, rad, in `duration` s. Takes
    /// 20 to 90 flights of the move's length; to be run where nothing is urgent.
    ///
    /// # Errors
    /// [`Error::TooShort`] below 0.9 first periods, [`Error::NotStill`] if no bulge is found that
    /// leaves less than 0.1 % of the length, a limit of a joint, those of [`Chain::at_rest`].
    pub fn plan(
        &self,
        from: &[f64; LINKS],
        to: &[f64; LINKS],
        duration: f64,
    ) -> Result<ChainPlan<LINKS>, Error> {
        let modes = self.chain.modes(to)?;
        let ticks = Move::Dwell { duration }.ticks(self.tick)?;
        let duration = f64::from(ticks) * self.tick;
        let shortest = 0.9 * modes.period();
        if duration < shortest {
            return Err(Error::TooShort { duration, shortest });
        }
        let mut search = Search {
            planner: self,
            begin: self.chain.at_rest(from)?,
            end: self.chain.at_rest(to)?,
            modes,
            to: *to,
            duration,
            flights: 0,
        };
        search.run(from)
    }
}

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Search<'_, T, LINKS, W, C, Q>
{
    fn run(&mut self, from: &[f64; LINKS]) -> Result<ChainPlan<LINKS>, Error> {
        let done = DONE * self.planner.chain.length;
        let mut bulges = [[0.0; TERMS]; LINKS];
        let first = self.fly(&bulges, 0.0)?;
        let mut left = self.left(&first);
        let mut derivative = self.derivative(&bulges, &left)?;
        let mut fresh = true;
        while amplitude(&left) > done && self.flights < FLIGHTS {
            let target = self.solve(&derivative, &bulges, &left);
            let Some((next, after)) = self.nearer(&bulges, &target, amplitude(&left)) else {
                if fresh {
                    break;
                }
                derivative = self.derivative(&bulges, &left)?;
                fresh = true;
                continue;
            };
            broyden(&mut derivative, &bulges, &next, &left, &after);
            let stalled = amplitude(&after) > STALLED * amplitude(&left);
            (bulges, left) = (next, after);
            fresh = stalled;
            if stalled && self.flights < FLIGHTS {
                derivative = self.derivative(&bulges, &left)?;
            }
        }
        self.finish(from, &bulges)
    }

    /// The farthest of a few steps towards `target` that leaves less than `before`, m, and what it
    /// leaves.
    fn nearer(
        &mut self,
        from: &Bulges<LINKS>,
        target: &Bulges<LINKS>,
        before: f64,
    ) -> Option<(Bulges<LINKS>, Left<LINKS>)> {
        for share in [1.0, 0.5, 0.2, 0.05] {
            let next: Bulges<LINKS> = core::array::from_fn(|j| {
                core::array::from_fn(|term| {
                    from[j][term] + share * (target[j][term] - from[j][term])
                })
            });
            // A flight that a link does not follow is too far.
            let after = self.fly(&next, 0.0).map(|flight| self.left(&flight));
            if let Ok(after) = after
                && amplitude(&after) < before
            {
                return Some((next, after));
            }
        }
        None
    }

    /// The last flight: on for a period behind the end.
    fn finish(
        &mut self,
        from: &[f64; LINKS],
        bulges: &Bulges<LINKS>,
    ) -> Result<ChainPlan<LINKS>, Error> {
        let flight = self.fly(bulges, self.modes.period())?;
        let residual = flight.deviation / self.planner.chain.length;
        // NaN is not below it either.
        if !(..STILL).contains(&residual) {
            return Err(Error::NotStill { duration: self.duration, residual });
        }
        let moves = self.moves(bulges);
        for j in 0..LINKS {
            let limits = &self.planner.limits[j];
            let motion = Limits { torque: None, ..*limits };
            let start = crate::HubState::resting_at(from[j])?;
            // Only what it refuses matters here.
            let plan = crate::motion::Plan::new(&moves[j], start, &motion, self.planner.tick)?;
            drop(plan);
            limits.admit_torque(flight.torque[j])?;
        }
        Ok(ChainPlan { moves, residual, torque: flight.torque, flights: self.flights })
    }

    fn moves(&self, bulges: &Bulges<LINKS>) -> [Move; LINKS] {
        core::array::from_fn(|j| {
            let mut bulge = [0.0; BULGE];
            bulge[..TERMS].copy_from_slice(&bulges[j]);
            Move::Still { duration: self.duration, to: self.to[j], bulge }
        })
    }

    /// Flies the move, and `longer` s on.
    fn fly(&mut self, bulges: &Bulges<LINKS>, longer: f64) -> Result<Flight<T, LINKS, W>, Error> {
        self.flights += 1;
        let chain = self.planner.chain;
        let mut arm = ChainGenerator::<T, LINKS, W, C, Q, 1>::from_state(chain, self.begin);
        let mut ticks = 0;
        for (joint, motion) in self.moves(bulges).iter().enumerate() {
            ticks = arm.push(joint, motion)?.ticks;
        }
        let mut torque = [0.0_f64; LINKS];
        for _ in 0..=ticks {
            let setpoint = arm.tick();
            for j in 0..LINKS {
                torque[j] = torque[j].max(setpoint.joints[j].torque.to_f64().abs());
            }
        }
        let state = *arm.state();
        let still = self.planner.chain.setpoint(&self.end).ends;
        let (mut deviation, on) = (0.0, (longer / chain.tick()) as u32);
        for _ in 0..on {
            for (end, still) in arm.tick().ends.iter().zip(&still) {
                let [x, y] = [0, 1].map(|axis| (end[axis] - still[axis]).to_f64());
                deviation = f64::max(deviation, sqrt(x * x + y * y));
            }
        }
        Ok(Flight { state, torque, deviation })
    }

    fn left(&self, flight: &Flight<T, LINKS, W>) -> Left<LINKS> {
        let mut left = [[0.0; 2]; LINKS];
        for (mode, left) in left.iter_mut().enumerate() {
            if self.modes.frequency[mode].is_finite() {
                for i in 0..C {
                    let (j, k) = (i / W, i % W);
                    let onto = self.modes.onto[mode][i];
                    left[0] += onto * (flight.state.shape[j][k] - self.end.shape[j][k]).to_f64();
                    left[1] += onto * flight.state.rate[j][k].to_f64();
                }
                left[0] *= self.modes.tip[mode];
                left[1] *= self.modes.tip[mode] / self.modes.frequency[mode];
            }
        }
        left
    }

    /// What a change of each coefficient changes of what is left.
    fn derivative(
        &mut self,
        bulges: &Bulges<LINKS>,
        left: &Left<LINKS>,
    ) -> Result<[[Left<LINKS>; TERMS]; LINKS], Error> {
        let mut derivative = [[[[0.0; 2]; LINKS]; TERMS]; LINKS];
        for j in 0..LINKS {
            for term in 0..TERMS {
                let mut nudged = *bulges;
                nudged[j][term] += NUDGE;
                let flight = self.fly(&nudged, 0.0)?;
                let after = self.left(&flight);
                for mode in 0..LINKS {
                    for part in 0..2 {
                        derivative[j][term][mode][part] =
                            (after[mode][part] - left[mode][part]) / NUDGE;
                    }
                }
            }
        }
        Ok(derivative)
    }

    /// The bulges of least effort that leave nothing, as far as the derivative tells: with the
    /// derivative `D`, the effort `bᵀEb` and what is left `l`, `b = E⁻¹Dᵀ(DE⁻¹Dᵀ)⁻¹(Db₀ − l)`.
    fn solve(
        &self,
        derivative: &[[Left<LINKS>; TERMS]; LINKS],
        bulges: &Bulges<LINKS>,
        left: &Left<LINKS>,
    ) -> Bulges<LINKS> {
        let effort = self.cheapness();
        let mut matrix = [[0.0; C]; C];
        let mut right = [Complex::ZERO; C];
        // C is at least three times the number of links, of which two a mode are used.
        let used: [bool; C] =
            core::array::from_fn(|i| i < 2 * LINKS && self.modes.frequency[i / 2].is_finite());
        let d = |j: usize, term: usize, row: usize| derivative[j][term][row / 2][row % 2];
        for row in (0..C).filter(|&row| used[row]) {
            right[row].re = -left[row / 2][row % 2];
            for j in 0..LINKS {
                for term in 0..TERMS {
                    right[row].re += d(j, term, row) * bulges[j][term];
                    for other in 0..TERMS {
                        let cheap = effort[j][term][other];
                        for column in (0..=row).filter(|&column| used[column]) {
                            matrix[row][column] += d(j, term, row) * cheap * d(j, other, column);
                        }
                    }
                }
            }
        }
        let none = [Complex::ZERO; C];
        let multipliers = Factors::new(&matrix, &none, &used).solve(&right, &used);
        core::array::from_fn(|j| {
            core::array::from_fn(|term| {
                let mut sum = 0.0;
                for row in (0..C).filter(|&row| used[row]) {
                    for other in 0..TERMS {
                        sum += effort[j][term][other] * d(j, other, row) * multipliers[row].re;
                    }
                }
                sum
            })
        })
    }

    /// Inverse of the effort of each joint's bulge: of the integrals of the products of the terms'
    /// second derivatives. A joint counts with the square of the inertia that it turns.
    fn cheapness(&self) -> [[[f64; TERMS]; TERMS]; LINKS] {
        let curvature = |u: f64| {
            let w = 1.0 - u * u;
            // Second derivatives of w³, u w³ and u² w³.
            let (b, b1, b2) = (w * w * w, -6.0 * u * w * w, 24.0 * u * u * w - 6.0 * w * w);
            [b2, u * b2 + 2.0 * b1, u * u * b2 + 4.0 * u * b1 + 2.0 * b]
        };
        let mut gram = [[0.0; TERMS]; TERMS];
        for (xi, weight) in crate::math::gauss_points() {
            let c = curvature(2.0 * xi - 1.0);
            for i in 0..TERMS {
                for p in 0..TERMS {
                    gram[i][p] += weight * c[i] * c[p];
                }
            }
        }
        // The middle term is odd, the others even.
        let [[a, _, b], [_, m, _], [_, _, c]] = gram;
        let det = a * c - b * b;
        let inverse = [[c / det, 0.0, -b / det], [0.0, 1.0 / m, 0.0], [-b / det, 0.0, a / det]];
        let inertia = self.planner.chain.inertias(&self.end);
        core::array::from_fn(|j| {
            let square = inertia[0] / inertia[j];
            inverse.map(|row| row.map(|entry| entry * square * square))
        })
    }
}

/// Length of what is left.
fn amplitude<const LINKS: usize>(left: &Left<LINKS>) -> f64 {
    let sum: f64 = left.iter().flatten().map(|part| part * part).sum();
    // What is no number is no progress.
    if sum.is_finite() { sqrt(sum) } else { f64::INFINITY }
}

/// Broyden's change of the derivative by what a step has shown.
fn broyden<const LINKS: usize>(
    derivative: &mut [[Left<LINKS>; TERMS]; LINKS],
    from: &Bulges<LINKS>,
    to: &Bulges<LINKS>,
    before: &Left<LINKS>,
    after: &Left<LINKS>,
) {
    let step = |j: usize, term: usize| to[j][term] - from[j][term];
    let pairs = || (0..LINKS).flat_map(|j| (0..TERMS).map(move |term| (j, term)));
    let square: f64 = pairs().map(|(j, term)| step(j, term) * step(j, term)).sum();
    if square == 0.0 || !square.is_finite() {
        return;
    }
    for mode in 0..LINKS {
        for part in 0..2 {
            let expected: f64 =
                pairs().map(|(j, term)| derivative[j][term][mode][part] * step(j, term)).sum();
            let missed = after[mode][part] - before[mode][part] - expected;
            if missed.is_finite() {
                for (j, term) in pairs() {
                    derivative[j][term][mode][part] += missed * step(j, term) / square;
                }
            }
        }
    }
}
