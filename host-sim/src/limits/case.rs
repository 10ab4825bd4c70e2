//! A commanded motion, and the time windows of its moves.

use stillbeam::motion::Shaper;
use stillbeam::{HubState, Move, Scene};

use super::{Excess, Refusal};
use crate::error::Error;
use crate::residual;
use crate::step::{Motion, Step};
use crate::trajectory::Trajectory;

/// Moves of an arm with their shaper, to be held against limits.
#[derive(Clone, Copy, Debug)]
pub struct Case<'a> {
    /// The arm.
    pub arm: &'a Scene,
    /// Hub angle at the beginning, rad.
    pub from: f64,
    /// The moves, each with the time to settle after it.
    pub steps: &'a [Step],
    /// Shaper that the moves pass, if any.
    pub shaper: Option<&'a Shaper>,
    /// h, s.
    pub tick: f64,
}

/// Time during which a move counts as the one under way. It lasts from the move's beginning to that
/// of the next, its own rest and dwells included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Index of the move in its scene.
    pub index: usize,
    /// Beginning, s.
    pub begin: f64,
    /// End, s.
    pub end: f64,
}

impl<'a> Case<'a> {
    /// Returns the same motion with other moves.
    pub fn with<'b>(&self, steps: &'b [Step]) -> Case<'b>
    where
        'a: 'b,
    {
        Case { steps, ..*self }
    }

    /// Returns the commanded motion, held against no limit. If it ends at rest, it goes on for at
    /// least a first period after the last arrival, so that a run shows its residual vibration.
    pub fn trajectory(&self) -> Result<Trajectory, Error> {
        let mut trajectory = self.plan()?;
        let end = trajectory.plans().last().map_or(0.0, |plan| plan.summary.end.rate);
        let rest = self.missing_rest(&trajectory)?;
        if rest > 0 {
            let dwell = Move::Dwell { duration: rest as f64 * self.tick };
            trajectory.append(&dwell.into()).map_err(|error| self.named(error, None))?;
        }
        let Some(shaper) = self.shaper else { return Ok(trajectory) };
        if end != 0.0 {
            return Err(Error::new(format_args!(
                "shaper: the hub turns on with {end} rad/s after the moves; must be moves that end at rest"
            )));
        }
        Ok(trajectory.shaped(shaper.clone()))
    }

    /// Returns the hub at the end of the moves, without the rest that shows its vibration.
    pub fn end(&self) -> Result<HubState<f64>, Error> {
        let mut trajectory = Trajectory::resting(self.from, self.tick)?;
        for motion in self.steps.iter().flat_map(Step::motions) {
            trajectory.append(&motion)?;
        }
        match trajectory.plans().last() {
            Some(plan) => Ok(plan.summary.end),
            None => Ok(HubState::resting_at(self.from)?),
        }
    }

    /// Returns the ticks of rest that the scene's own moves lack after the last arrival.
    fn missing_rest(&self, trajectory: &Trajectory) -> Result<u64, Error> {
        let turning = trajectory.plans().last().is_none_or(|plan| plan.summary.end.rate != 0.0);
        let Some(arrival) = trajectory.arrivals().last().filter(|_| !turning) else {
            return Ok(0);
        };
        let has = trajectory.ticks() - (arrival / self.tick).round() as u64;
        let needs = residual::ticks(self.arm, self.tick)?.unwrap_or(0);
        Ok(needs.saturating_sub(has))
    }

    /// Plans the motions end to end. An error names the move that is refused.
    fn plan(&self) -> Result<Trajectory, Error> {
        let mut trajectory = Trajectory::resting(self.from, self.tick)?;
        for (index, step) in self.steps.iter().enumerate() {
            for motion in step.motions() {
                trajectory.append(&motion).map_err(|error| self.named(error, Some(index)))?;
            }
        }
        Ok(trajectory)
    }

    /// Adds the move to an error, if there are several. What is added behind the moves belongs to
    /// the last.
    fn named(&self, error: Error, index: Option<usize>) -> Error {
        let count = self.steps.len();
        let index = index.unwrap_or(count.saturating_sub(1));
        if count == 1 { error } else { error.within(place(index, count)) }
    }

    /// Adds to a refusal the place of the row to which the hub was on its way, if the move is a
    /// path. Behind a shaper several rows are under way.
    pub fn placed(&self, trajectory: &Trajectory, refusal: Refusal) -> Error {
        let Excess { peak, index, .. } = refusal.excess;
        let error = Error::from(refusal);
        let path = self.steps.get(index).and_then(|step| match &step.motion {
            Motion::Path(path) if self.shaper.is_none() => Some(path),
            _ => None,
        });
        let windows = self.windows(trajectory);
        let window = windows.iter().find(|window| window.index == index);
        let (Some(path), Some(window)) = (path, window) else { return error };
        let row = path.place_at(peak.at - window.begin);
        let own = row.strip_prefix("move.").filter(|_| self.steps.len() > 1);
        match own {
            Some(row) => error.within(format_args!("{}.{row}", place(index, self.steps.len()))),
            None => error.within(row),
        }
    }

    /// Returns the moves' windows, in order. They cover the whole run.
    pub fn windows(&self, trajectory: &Trajectory) -> Vec<Window> {
        let mut windows: Vec<Window> = Vec::new();
        let mut ticks = 0;
        let mut plans = trajectory.plans().iter();
        for (index, step) in self.steps.iter().enumerate() {
            // A dwell commands nothing: what still happens during it is the work of the move
            // before.
            if windows.is_empty() || !step.motion.is_dwell() {
                let begin = ticks as f64 * self.tick;
                if let Some(last) = windows.last_mut() {
                    last.end = begin;
                }
                windows.push(Window { index, begin, end: trajectory.duration() });
            }
            for plan in plans.by_ref().take(step.motions().count()) {
                ticks += u64::from(plan.summary.ticks);
            }
        }
        windows
    }
}

/// Returns the name of a move in its scene file.
pub(super) fn place(index: usize, count: usize) -> String {
    if count == 1 { "move".to_owned() } else { format!("moves[{index}]") }
}
