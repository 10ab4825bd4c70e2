//! Moves with a piecewise-linear acceleration that keep their limits on the reference rod.
//!
//! The planner knows the arm in two modes and from rest. If the rod shows that a plan exceeds a
//! limit, or leaves more than may be left, it is planned again with less.

use stillbeam::planner::{FastestMove, Planner, Request};

use super::asked::Asked;
use super::check::{Check, tighten};
use super::judge::Motion;
use super::kept::ROUNDS;
use super::shortest::{self, INTERVALS};
use crate::error::Error;
use crate::limits::Case;

impl Asked<'_> {
    /// Plans the fastest move with a piecewise-linear acceleration, in f64, within the limits on
    /// the reference rod, and returns `2π/ω₁`, s, beside it. `None` for what is not its kind, or if
    /// it does not converge.
    pub fn plan_fastest(&self) -> Result<Option<(FastestMove<INTERVALS>, f64)>, Error> {
        let own = self.duration.is_none() && self.robust.is_none();
        let found = if self.options.is_some() {
            Some(self.plan_piecewise()?)
        } else if own && self.before.steps.is_empty() {
            self.piecewise()?
        } else {
            None
        };
        let Some(found) = found else { return Ok(None) };
        let Case { arm, tick, .. } = self.before;
        Ok(Some((found, Planner::<f32, 2>::new(arm, tick)?.first_period())))
    }

    /// Plans a move with a piecewise-linear acceleration, as the options ask: the fastest, or the
    /// gentlest of a duration. What is not its kind is refused.
    pub fn plan_piecewise(&self) -> Result<FastestMove<INTERVALS>, Error> {
        let options = self.options.validate(self.duration)?;
        self.piecewise()?.ok_or_else(|| options.unmet())
    }

    fn piecewise(&self) -> Result<Option<FastestMove<INTERVALS>>, Error> {
        let Case { arm, tick, .. } = self.before;
        let check = Check::new(self)?;
        let planner = match self.robust {
            Some(spread) => Planner::<f64, 2>::robust(arm, tick, spread)?,
            None => Planner::<f64, 2>::new(arm, tick)?,
        };
        let mut limits = *self.limits;
        let mut residual = self.options.residual.unwrap_or(0.0);
        for _ in 0..ROUNDS {
            let request = Request::from_rest(self.from, self.to).limits(limits).residual(residual);
            let request = if self.options.eased { request.eased() } else { request };
            let found = match (self.duration, self.options.least) {
                (Some(duration), Some(least)) => {
                    planner.gentlest(&request.duration(duration).objective(least))?
                }
                _ => planner.fastest(&request)?,
            };
            let Some(found) = found else { return Ok(None) };
            let over = check.over(shortest::path(&found), self.limits)?;
            let left = self.left(&found)?;
            let most = self.options.residual.unwrap_or(f64::INFINITY);
            if over.is_empty() && left <= most {
                return Ok(Some(found));
            }
            if left > most {
                // The planner does not see the third mode.
                residual = (residual * 0.99 * most / left).max(0.5 * residual);
            }
            tighten(&mut limits, &over);
        }
        Ok(None)
    }

    /// Returns the largest residual in the reference rod, of L, over the frequencies to which the
    /// arm is known; 0 if nobody asks.
    fn left(&self, found: &FastestMove<INTERVALS>) -> Result<f64, Error> {
        if self.options.residual.is_none() {
            return Ok(0.0);
        }
        let motion = Motion::of(self.from, shortest::path(found), self.before.tick);
        let spread = self.robust.unwrap_or(0.0);
        let looks: &[f64] = if spread > 0.0 { &[-1.0, -0.5, 0.0, 0.5, 1.0] } else { &[0.0] };
        looks.iter().try_fold(0.0, |most, look| {
            Ok(f64::max(most, motion.judge(self.before.arm, look * spread)?.residual))
        })
    }
}
