//! From a search in real durations to a move of whole ticks that keeps its limits between them.

use super::Search;
use super::case::{Case, Trial};
use super::fastest_move::FastestMove;
use super::flight::{Loads, fly_finely};
use super::half::Half;
use super::search::{Outcome, TURN};
use crate::math::{Each, Scalar, cast};
use crate::motion::{Limits, Peaks};
use crate::planner::Prediction;

/// Most searches with whole ticks.
const MAX_SEARCHES: u32 = 10;

/// Most searches in real durations, each with the limits that the one before has exceeded
/// tightened.
const MAX_REAL_SEARCHES: u32 = 3;

/// Part by which a limit is tightened beyond what exceeds it. The knots shift by as much from one
/// search to the next.
const SPARE: f64 = 1e-4;

/// Excess of the torque, of its limit, up to which no other search in real durations is made.
const NEAR: f64 = 5e-3;

/// Bound of the residual above which a plan is none, of L.
const RINGS: f64 = 5e-3;

/// The last part of planning a fastest move.
pub(super) struct Finish {
    /// The limits as they are asked for.
    pub limits: Limits,
    /// h, s.
    pub tick: f64,
}

impl Finish {
    /// Searches in real durations, then with whole ticks, with limits that are tightened by what
    /// the knots exceed between the rows. `None` if that does not converge.
    #[inline(never)]
    pub fn run<T: Scalar, const K: usize, const N: usize>(
        &self,
        case: Case<'_, T, K>,
        [from, to]: [f64; 2],
    ) -> Option<FastestMove<N>> {
        let mut search = Search::<T, K, N>::new(case);
        search.case.limits.torque =
            self.limits.torque.map(|torque| torque / (1.0 + Prediction::MARGIN));
        let power = case.power();
        let mut duration = match case.least {
            None => self.real_duration(&mut search, to - from),
            Some(_) => case.rigid,
        };
        for _ in 0..MAX_SEARCHES {
            if case.least.is_none() {
                let ticks = libm::ceil(duration / self.tick - 1e-6) as u32;
                search.fix(f64::from(ticks) * self.tick);
            }
            let found = search.run();
            if !found.reach.is_finite() {
                return None;
            }
            let Trial { duration: here, scale, .. } = found.trial;
            let ramp = scaled(&search, &found, to - from);
            let peaks = peaks(&ramp);
            let [mut rate, mut torque, others] = self.excess(&peaks, 0.0);
            if rate.max(others) <= 1.0 {
                let fastest = self.fastest_move(&search, &ramp, [from, to]);
                [rate, torque, _] = self.excess(&peaks, fastest.prediction.torque);
                let rests = rests(&mut search, &found, &fastest);
                if torque <= 1.0 && rests {
                    return Some(fastest);
                }
            }
            if case.least.is_some() {
                if rate.max(torque) <= 1.0 || others > 1.0 {
                    return None;
                }
                tighten(&mut search.case.limits, rate, torque);
            } else if scale > 1.0 + 1e-5 || others > 1.0 {
                // All limits bind: only more time helps.
                let longer = libm::pow(scale.max(others), 1.0 / power);
                duration = (here * longer).max(here + self.tick);
            } else {
                tighten(&mut search.case.limits, rate, torque);
                duration = here;
            }
        }
        None
    }

    /// Searches for the duration, s, before it is rounded to ticks.
    fn real_duration<T: Scalar, const K: usize, const N: usize>(
        &self,
        search: &mut Search<'_, T, K, N>,
        turn: f64,
    ) -> f64 {
        let mut found = search.run();
        for _ in 1..MAX_REAL_SEARCHES {
            if self.limits.torque.is_none() || !found.reach.is_finite() {
                break;
            }
            let peaks = peaks(&scaled(search, &found, turn));
            let [rate, torque, _] = self.excess(&peaks, found.torque);
            if torque <= 1.0 + TURN {
                break;
            }
            tighten(&mut search.case.limits, rate, torque);
            if torque <= 1.0 + NEAR {
                // The search with whole ticks does the rest.
                return found.trial.duration * libm::sqrt(torque);
            }
            found = search.run();
        }
        found.trial.duration
    }

    /// Greatest rate and torque over their limits, and the greater of acceleration and jerk; `most`
    /// is the torque, N m.
    fn excess(&self, peaks: &Peaks, most: f64) -> [f64; 3] {
        let Limits { rate, torque, acceleration, jerk, .. } = self.limits;
        let over = |limit: Option<f64>, peak: f64| limit.map_or(0.0, |limit| peak / limit);
        let margin = 1.0 + Prediction::MARGIN;
        [
            over(rate, peaks.rate),
            over(torque, margin * most),
            over(acceleration, peaks.acceleration).max(over(jerk, peaks.jerk)),
        ]
    }

    /// The move of a half, simulated in fine steps.
    fn fastest_move<T: Scalar, const K: usize, const N: usize>(
        &self,
        search: &Search<'_, T, K, N>,
        half: &Half<f64, N>,
        [from, to]: [f64; 2],
    ) -> FastestMove<N> {
        let (arm, points) = (search.case.arm, search.case.points);
        let duration = search.trial.duration;
        let flown = Half::<T, N>::new(cast(&half.knots), T::from_f64(half.interval));
        let (end, Loads { torque, moment, deflection }) = fly_finely(arm, points, &flown);
        FastestMove {
            from,
            to,
            ticks: libm::round(duration / self.tick) as u32,
            tick: self.tick,
            ramp: half.interval * N as f64,
            knots: half.knots,
            peaks: peaks(half),
            prediction: Prediction {
                torque: torque.to_f64(),
                moment: moment.to_f64(),
                deflection: deflection.to_f64(),
                residual: search.case.residual(arm, &end),
            },
            simulations: search.simulations,
        }
    }
}

/// The half of an outcome, scaled to the turn (rad) in the precision of set-up.
fn scaled<T: Scalar, const K: usize, const N: usize>(
    search: &Search<'_, T, K, N>,
    found: &Outcome<T, N>,
    turn: f64,
) -> Half<f64, N> {
    let interval = search.case.interval(&found.trial);
    let unscaled = Half::<f64, N>::new(cast(&found.half.knots), interval);
    let scale = turn / unscaled.turn(found.trial.duration);
    Half::new(unscaled.knots.each(|u| scale * u), interval)
}

/// True if the arm rests behind the move. Windows that the second mode takes too much of are made
/// narrower for the next search.
fn rests<T: Scalar, const K: usize, const N: usize>(
    search: &mut Search<'_, T, K, N>,
    found: &Outcome<T, N>,
    fastest: &FastestMove<N>,
) -> bool {
    let stated = fastest.prediction.residual / search.case.length;
    let Some(windows) = &mut search.case.windows else { return stated < RINGS };
    let left = stated.max(found.residual);
    if left > windows.residual {
        windows.width *= 0.99 * windows.residual / left;
    }
    left <= windows.residual
}

/// Tightens the limits of rate and torque that are exceeded.
fn tighten(limits: &mut Limits, rate: f64, torque: f64) {
    let tighter = |limit: f64, excess: f64| {
        if excess > 1.0 { limit / (excess * (1.0 + SPARE)) } else { limit }
    };
    limits.rate = limits.rate.map(|limit| tighter(limit, rate));
    limits.torque = limits.torque.map(|limit| tighter(limit, torque));
}

/// Greatest magnitudes of the hub's motion along a half.
fn peaks<const N: usize>(half: &Half<f64, N>) -> Peaks {
    let mut peaks = Peaks { rate: half.end_rate.abs(), acceleration: 0.0, jerk: 0.0 };
    for i in 0..N {
        let jerk = (half.next(i) - half.knots[i]) / half.interval;
        peaks.acceleration = peaks.acceleration.max(half.knots[i].abs());
        peaks.rate = peaks.rate.max(half.rates[i].abs());
        peaks.jerk = peaks.jerk.max(jerk.abs());
    }
    for (_, _, rate) in half.turns() {
        peaks.rate = peaks.rate.max(rate.abs());
    }
    if half.knots[0] != 0.0 {
        peaks.jerk = f64::INFINITY;
    }
    peaks
}
