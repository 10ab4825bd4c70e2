//! Newton's method for the bulges, with Broyden's changes of the derivative between renewals.

use super::linear::{amplitude, broyden};
use super::{Bulges, ChainPlan, ChainPlanner, Left, TERMS};
use crate::Error;
use crate::chain::ChainState;
use crate::chain::modes::ChainModes;
use crate::math::{Scalar, array};
use crate::mechanism::of_joint;
use crate::motion::{BULGE, Limits, Move};

/// Most flights of a search in one duration.
const FLIGHTS: u32 = 90;
/// Amplitude at the tip, of all lengths, at which the search has ended.
const DONE: f64 = 2e-6;
/// Deviation of any joint or the tip in the first period after the end, of all lengths, up to which
/// a plan is given out.
const STILL: f64 = 4e-4;
/// A search that leaves more than this of the amplitude before takes the derivative anew.
const STALLED: f64 = 0.25;

/// One search: the request and what does not change in it.
pub(super) struct Search<'a, T, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
{
    pub planner: &'a ChainPlanner<T, LINKS, W, C, Q>,
    pub begin: ChainState<T, LINKS, W>,
    pub end: ChainState<T, LINKS, W>,
    pub modes: ChainModes<LINKS, C>,
    pub to: [f64; LINKS],
    pub duration: f64,
    /// Flights that it has taken, and at how many it ends.
    pub flights: u32,
    pub most: u32,
}

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Search<'_, T, LINKS, W, C, Q>
{
    /// Searches from `first` on, in a move of `duration` s.
    ///
    /// # Errors
    /// A move that a link does not follow.
    pub fn run(&mut self, first: &Bulges<LINKS>, duration: f64) -> Result<Bulges<LINKS>, Error> {
        self.duration = duration;
        self.most = self.flights + FLIGHTS;
        let done = DONE * self.planner.chain.length;
        let mut bulges = *first;
        let first = self.fly(&bulges, 0.0)?;
        let mut left = self.left(&first);
        let mut derivative = self.derivative(&bulges, &left)?;
        let mut fresh = true;
        while amplitude(&left) > done && self.flights < self.most {
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
            if stalled && self.flights < self.most {
                derivative = self.derivative(&bulges, &left)?;
            }
        }
        Ok(bulges)
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
            let next: Bulges<LINKS> =
                array(|j| array(|term| from[j][term] + share * (target[j][term] - from[j][term])));
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
    ///
    /// # Errors
    /// A move that rings on, or one beyond a limit.
    pub fn finish(
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
            crate::motion::Plan::new(&moves[j], start, &motion, self.planner.tick)
                .map(drop)
                .and_then(|()| limits.admit_torque(flight.torque[j]))
                .map_err(|error| of_joint(error, j))?;
        }
        Ok(ChainPlan { moves, residual, torque: flight.torque, flights: self.flights })
    }

    pub fn moves(&self, bulges: &Bulges<LINKS>) -> [Move; LINKS] {
        core::array::from_fn(|j| {
            let mut bulge = [0.0; BULGE];
            bulge[..TERMS].copy_from_slice(&bulges[j]);
            Move::Still { duration: self.duration, to: self.to[j], bulge }
        })
    }
}
