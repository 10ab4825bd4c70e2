//! Still moves that keep their limits on the reference rod.
//!
//! The planner knows the arm in two modes and from rest. Its plan is held against the limits as
//! every motion is, torque and clamp moment by the reference rod, which still rings from the move
//! before. If that shows more than the planner saw, it plans again within tighter limits.

use std::cell::OnceCell;

use stillbeam::planner::{FastestMove, Planner, Prediction, Request, StillMove};
use stillbeam::{Error as CoreError, Limits, Remedy};

use super::Options;
use super::judge::Motion as Judged;
use super::shortest::{self, INTERVALS};
use crate::error::Error;
use crate::limits::{Case, Excess, Peak, Quantity, Refusal, Way, kinematic, load, remedy};
use crate::reference::rod::Resume;
use crate::step::{Motion, Step};

/// Fraction of the torque limit for which a shortest move is planned. A method's own setpoints,
/// good to a hundredth of the peak, then keep the limit too.
pub const GOAL: f64 = 0.985;

/// Number of times that limits are tightened.
const ROUNDS: u32 = 8;

/// Number of durations that are tried if tightened limits do not converge, and their growth.
const LONGER: u32 = 40;
const GROWTH: f64 = 1.03;

/// Fraction of a duration below which no shorter one is tried, and number of times that the rest is
/// halved.
const SHORTER: f64 = 0.8;
const HALVINGS: u32 = 5;

/// A still move as it is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// The moves before it, the arm, the shaper and the tick.
    pub before: Case<'a>,
    /// Limits of the drive.
    pub limits: &'a Limits,
    /// Hub angle at the beginning, rad.
    pub from: f64,
    /// Hub angle at the end, rad.
    pub to: f64,
    /// Duration, s. `None` asks for the shortest within the limits.
    pub duration: Option<f64>,
    /// Fraction to which the arm's frequencies are known, for a robust move.
    pub robust: Option<f64>,
    /// What it may leave and what it keeps least.
    pub options: Options,
    /// Time after it, s.
    pub settle: f64,
    /// Number of moves in the scene.
    pub count: usize,
}

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
        let search = Search { asked: self, planner, state: OnceCell::new() };
        search.weight()?;
        let plan = match self.duration {
            Some(duration) => search.lasting(duration)?,
            None => search.shortest()?,
        };
        let prediction = search.planner.predict(&plan, None);
        Ok(Kept { plan, prediction, first_period: search.planner.first_period() })
    }

    /// Plans the fastest move with a piecewise-linear acceleration, in f64, within the limits on
    /// the reference rod, and returns `2π/ω₁`, s, beside it. `None` for what is not its kind, or if
    /// it does not converge.
    pub fn plan_fastest(&self) -> Result<Option<(FastestMove<INTERVALS>, f64)>, Error> {
        let Case { arm, tick, .. } = self.before;
        let period = Planner::<f32, 2>::new(arm, tick)?.first_period();
        if self.options.is_some() {
            return self.plan_piecewise().map(|found| Some((found, period)));
        }
        let own = self.duration.is_none() && self.robust.is_none();
        if !own || !self.before.steps.is_empty() {
            return Ok(None);
        }
        let found = self.piecewise(&self.options)?;
        Ok(found.map(|found| (found, period)))
    }

    /// Plans a move with a piecewise-linear acceleration, as the options ask: the fastest, or the
    /// gentlest of a duration. What is not its kind is refused.
    pub fn plan_piecewise(&self) -> Result<FastestMove<INTERVALS>, Error> {
        let options = self.options.validate(self.duration)?;
        self.piecewise(&options)?.ok_or_else(|| options.unmet())
    }

    fn piecewise(&self, options: &Options) -> Result<Option<FastestMove<INTERVALS>>, Error> {
        let Case { arm, tick, .. } = self.before;
        let planner = Planner::<f32, 2>::new(arm, tick)?;
        let search = Search { asked: self, planner, state: OnceCell::new() };
        search.weight()?;
        let precise = match self.robust {
            Some(spread) => Planner::<f64, 2>::robust(arm, tick, spread)?,
            None => Planner::<f64, 2>::new(arm, tick)?,
        };
        let mut limits = *self.limits;
        let mut residual = options.residual.unwrap_or(0.0);
        for _ in 0..ROUNDS {
            let request = Request::from_rest(self.from, self.to).limits(limits).residual(residual);
            let found = match (self.duration, options.least) {
                (Some(duration), Some(least)) => {
                    precise.gentlest(&request.duration(duration).objective(least))?
                }
                _ => precise.fastest(&request)?,
            };
            let Some(found) = found else { return Ok(None) };
            let over = search.over_along(shortest::path(&found), self.limits)?;
            let left = self.left(&found, options)?;
            let most = options.residual.unwrap_or(f64::INFINITY);
            if over.is_empty() && left <= most {
                return Ok(Some(found));
            }
            if left > most {
                // The planner does not see the third mode.
                residual = (residual * 0.99 * most / left).max(0.5 * residual);
            }
            for excess in over {
                if let Some(limit) = excess.quantity.of_mut(&mut limits) {
                    *limit *= (1.0 - 1e-5) / excess.ratio();
                }
            }
        }
        Ok(None)
    }
}

impl Asked<'_> {
    /// Returns the largest residual in the reference rod, of L, over the frequencies to which the
    /// arm is known; 0 if nobody asks.
    fn left(&self, found: &FastestMove<INTERVALS>, options: &Options) -> Result<f64, Error> {
        if options.residual.is_none() {
            return Ok(0.0);
        }
        let motion = Judged::of(self.from, shortest::path(found), self.before.tick);
        let spread = self.robust.unwrap_or(0.0);
        let looks: &[f64] = if spread > 0.0 { &[-1.0, -0.5, 0.0, 0.5, 1.0] } else { &[0.0] };
        looks.iter().try_fold(0.0, |most, look| {
            Ok(f64::max(most, motion.judge(self.before.arm, look * spread)?.residual))
        })
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
    /// State of the rod at the beginning of the move; `None` at rest.
    state: OnceCell<Option<Resume>>,
}

impl Search<'_> {
    /// Refuses a move if holding the arm at rest somewhere on its way exceeds a limit.
    fn weight(&self) -> Result<(), Error> {
        let Asked { before, limits, from, to, .. } = self.asked;
        for quantity in [Quantity::Torque, Quantity::Moment] {
            let Some(limit) = quantity.limit(limits, before.tick) else { continue };
            let peak = Peak { value: 0.0, at: 0.0 };
            let excess = Excess { quantity, peak, limit, index: before.steps.len() };
            if let Some(held) = remedy::too_heavy(before, limits, &excess, *from, *to)? {
                let begin =
                    before.steps.iter().flat_map(Step::motions).map(|m| m.duration()).sum::<f64>()
                        + 0.0;
                let excess = Excess { peak: Peak { value: held, at: begin }, ..excess };
                return Err(self.refusal(excess, Way::Remedy(Remedy::Weight(held))));
            }
        }
        Ok(())
    }

    /// Returns the request of the move from rest to rest.
    fn request(&self) -> Request<f32, 2> {
        Request::from_rest(self.asked.from, self.asked.to)
    }

    fn refusal(&self, excess: Excess, way: Way) -> Error {
        Refusal { excess, count: self.asked.count, way }.into()
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
        Err(self.refusal(excess, way))
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
        Err(self.refusal(excess, Way::None(ticks * self.asked.before.tick)))
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
            for excess in over {
                if let Some(limit) = excess.quantity.of_mut(&mut limits) {
                    // A little more, so that rounding does not take another round.
                    *limit *= (1.0 - 1e-5) / excess.ratio();
                }
            }
        }
        let failure = last.map(|(excess, ticks)| (Failure::Exceeds(excess), ticks));
        Ok(Err(failure.unwrap_or((Failure::Core(CoreError::NotAtRest { rate: 0.0 }), 0))))
    }

    /// Returns every limit that a plan exceeds on the reference rod.
    fn over(&self, plan: &StillMove, limits: &Limits) -> Result<Vec<Excess>, Error> {
        self.over_along(plan.motion().into(), limits)
    }

    /// Returns every limit that a motion exceeds on the reference rod.
    fn over_along(&self, motion: Motion, limits: &Limits) -> Result<Vec<Excess>, Error> {
        let Asked { before, settle, .. } = self.asked;
        let mut steps = before.steps.to_vec();
        steps.push(Step { motion, settle: *settle });
        let case = before.with(&steps);
        let trajectory = case.trajectory()?;
        let windows = case.windows(&trajectory);
        let Some((window, earlier)) = windows.split_last() else { return Ok(Vec::new()) };
        let kinematic = kinematic::peaks(&trajectory, window.begin, window.end);
        let mut peaks = Vec::new();
        for quantity in Quantity::KINEMATIC {
            peaks.extend(kinematic.of(quantity, limits).map(|peak| (quantity, peak)));
        }
        if load::limited(limits) {
            let state = match self.state.get() {
                Some(state) => state,
                None => {
                    let mut state = None;
                    for window in earlier {
                        let at = state.as_ref();
                        state = load::fly(&case, &trajectory, window, &load::FINE, at, &|_| ())?.1;
                    }
                    self.state.get_or_init(|| state)
                }
            };
            let state = state.as_ref();
            let (loads, _) = load::fly(&case, &trajectory, window, &load::FINE, state, &|_| ())?;
            peaks.push((Quantity::Torque, loads.torque));
            peaks.push((Quantity::Moment, loads.moment));
        }
        let over = peaks.into_iter().filter_map(|(quantity, peak)| {
            Excess::of(quantity, peak, quantity.limit(limits, before.tick)?, window.index)
        });
        Ok(over.collect())
    }
}
