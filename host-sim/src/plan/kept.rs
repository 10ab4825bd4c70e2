//! Still moves that keep their limits on the reference rod.
//!
//! The planner knows the arm in two modes and from rest. Its plan is held against the limits as
//! every motion is, torque and clamp moment by the reference rod, which still rings from the move
//! before. If that shows more than the planner saw, it plans again within tighter limits.

use stillbeam::planner::{Planner, Prediction, Request, StillMove};
use stillbeam::{Error as CoreError, Limits, Remedy};

use super::asked::Asked;
use super::check::{Check, tighten};
use crate::error::Error;
use crate::limits::{Excess, Way, load};

/// Fraction of the torque limit for which a shortest move is planned. A method's own setpoints,
/// good to a hundredth of the peak, then keep the limit too.
pub const GOAL: f64 = 0.985;

/// Number of times that limits are tightened.
pub(super) const ROUNDS: u32 = 8;

/// Number of durations that are tried if tightened limits do not converge, and their growth.
const LONGER: u32 = 40;
const GROWTH: f64 = 1.03;

/// Fraction of a duration below which no shorter one is tried, and number of times that the rest is
/// halved.
const SHORTER: f64 = 0.8;
const HALVINGS: u32 = 5;

/// A plan and its planner's prediction.
#[derive(Clone, Copy, Debug)]
pub struct Kept {
    /// The plan.
    pub plan: StillMove,
    /// Prediction of the planner.
    pub prediction: Prediction,
    /// `2π/ω₁`, s.
    pub first_period: f64,
}

impl Asked<'_> {
    /// Plans the move, in f32 as the target does.
    pub fn plan(&self) -> Result<Kept, Error> {
        let tick = self.before.tick;
        let planner = match self.robust {
            Some(spread) => Planner::<f32, 2>::robust(self.before.arm, tick, spread)?,
            None => Planner::<f32, 2>::new(self.before.arm, tick)?,
        };
        let search = Search { asked: self, planner, check: Check::new(self)? };
        let plan = match self.duration {
            Some(duration) => search.lasting(duration)?,
            None => search.shortest()?,
        };
        let prediction = search.planner.predict(&plan, None);
        Ok(Kept { plan, prediction, first_period: search.planner.first_period() })
    }
}

/// Reason why there is no plan.
enum Failure {
    Exceeds(Excess),
    Core(CoreError),
}

struct Search<'a> {
    asked: &'a Asked<'a>,
    planner: Planner<f32, 2>,
    check: Check<'a>,
}

impl Search<'_> {
    /// Returns the request of the move from rest to rest.
    fn request(&self) -> Request<f32, 2> {
        Request::from_rest(self.asked.from, self.asked.to)
    }

    /// Plans the move of a given duration, or returns the refusal that names a sufficient one.
    fn lasting(&self, duration: f64) -> Result<StillMove, Error> {
        let excess = match self.attempt(duration, self.asked.limits)? {
            Ok(found) => return Ok(found),
            Err(Failure::Core(error)) => return Err(error.into()),
            Err(Failure::Exceeds(excess)) => excess,
        };
        let fits = self.shortest().ok().and_then(|plan| {
            let longest = plan.ticks + plan.ticks / 10 + 10;
            (plan.ticks..longest)
                .map(|ticks| f64::from(ticks) * plan.tick)
                .find(|&duration| matches!(self.attempt(duration, self.asked.limits), Ok(Ok(_))))
        });
        let way = fits.map_or(Way::Remedy(Remedy::Longer), |fits| {
            Way::Remedy(Remedy::Duration((fits * 1e9).round() / 1e9))
        });
        Err(self.check.refusal(excess, way))
    }

    /// Plans a move of that duration, s, within the limits on the reference rod.
    fn attempt(&self, duration: f64, limits: &Limits) -> Result<Result<StillMove, Failure>, Error> {
        let within =
            |limits: &Limits| self.planner.plan(&self.request().limits(*limits).duration(duration));
        // The planner's own idea of the peaks is not asked first: the truth counts, behind the
        // shaper and by the rod.
        let free = match within(&Limits::default()) {
            Ok(found) => found,
            Err(error) => return Ok(Err(Failure::Core(error))),
        };
        let over = self.over(&free, limits)?;
        let Some(&excess) = over.first() else { return Ok(Ok(free)) };
        let unloaded = Limits { torque: None, moment: None, ..*limits };
        if let Ok(found) = within(&unloaded)
            && self.over(&found, limits)?.is_empty()
        {
            return Ok(Ok(found));
        }
        // Without its second mode looked after the move may take less.
        match self.tightened(limits, within)? {
            Ok(found) => Ok(Ok(found)),
            Err(_) => Ok(Err(Failure::Exceeds(excess))),
        }
    }

    /// Plans the shortest move within the limits on the reference rod.
    fn shortest(&self) -> Result<StillMove, Error> {
        let limits = self.asked.limits;
        let goal = Limits { torque: limits.torque.map(|torque| GOAL * torque), ..*limits };
        let found =
            self.tightened(&goal, |limits| self.planner.plan(&self.request().limits(*limits)))?;
        let (excess, from_ticks) = match found {
            Ok(found) => return self.shortened(found, &goal),
            Err((Failure::Core(error), _)) => return Err(error.into()),
            Err((Failure::Exceeds(excess), ticks)) => (excess, ticks),
        };
        let mut ticks = f64::from(from_ticks);
        for _ in 0..LONGER {
            ticks = (ticks * GROWTH).ceil();
            if let Ok(found) = self.attempt(ticks * self.asked.before.tick, &goal)? {
                return Ok(found);
            }
        }
        Err(self.check.refusal(excess, Way::None(ticks * self.asked.before.tick)))
    }

    /// Halves a duration back that tightened load limits made too long. They take the weight's
    /// share of a load for the motion's.
    fn shortened(&self, found: StillMove, goal: &Limits) -> Result<StillMove, Error> {
        let mut found = found;
        if !load::limited(goal) {
            return Ok(found);
        }
        let mut failing = (SHORTER * f64::from(found.ticks)) as u32;
        for _ in 0..HALVINGS {
            let middle = failing + (found.ticks - failing) / 2;
            if middle <= failing {
                break;
            }
            match self.attempt(f64::from(middle) * self.asked.before.tick, goal)? {
                Ok(shorter) => found = shorter,
                Err(_) => failing = middle,
            }
        }
        Ok(found)
    }

    /// Plans, checks the plan on the reference rod, and plans again within limits that are
    /// tightened by the excess. The failure comes with the ticks of the last plan.
    fn tightened(
        &self,
        goal: &Limits,
        plan: impl Fn(&Limits) -> Result<StillMove, CoreError>,
    ) -> Result<Result<StillMove, (Failure, u32)>, Error> {
        let mut limits = *goal;
        let mut last = None;
        for _ in 0..ROUNDS {
            let found = match plan(&limits) {
                Ok(found) => found,
                Err(error) => {
                    let failure = last.map_or((Failure::Core(error), 0), |(excess, ticks)| {
                        (Failure::Exceeds(excess), ticks)
                    });
                    return Ok(Err(failure));
                }
            };
            let over = self.over(&found, goal)?;
            let Some(&excess) = over.first() else { return Ok(Ok(found)) };
            last = Some((excess, found.ticks));
            tighten(&mut limits, &over);
        }
        let failure = last.map(|(excess, ticks)| (Failure::Exceeds(excess), ticks));
        Ok(Err(failure.unwrap_or((Failure::Core(CoreError::NotAtRest { rate: 0.0 }), 0))))
    }

    /// Returns every limit that a plan exceeds on the reference rod.
    fn over(&self, plan: &StillMove, limits: &Limits) -> Result<Vec<Excess>, Error> {
        self.check.over(plan.motion().into(), limits)
    }
}
