//! A commanded motion, and the time windows of its moves.

use stillbeam::motion::Shaper;
use stillbeam::{Limits, Move, Scene};

use crate::error::Error;
use crate::residual;
use crate::step::Step;
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
        let mut motions: Vec<Move> = self.steps.iter().flat_map(Step::motions).collect();
        let mut trajectory = self.plan(&motions)?;
        let end = trajectory.plans().last().map_or(0.0, |plan| plan.summary.end.rate);
        let rest = self.missing_rest(&trajectory)?;
        if rest > 0 {
            motions.push(Move::Dwell { duration: rest as f64 * self.tick });
            trajectory = self.plan(&motions)?;
        }
        let Some(shaper) = self.shaper else { return Ok(trajectory) };
        if end != 0.0 {
            return Err(Error::new(format_args!(
                "shaper: the hub turns on with {end} rad/s after the moves; must be moves that end at rest"
            )));
        }
        Ok(trajectory.shaped(shaper.clone()))
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

    /// Plans the moves end to end. An error names the move that is refused.
    fn plan(&self, motions: &[Move]) -> Result<Trajectory, Error> {
        Trajectory::plan(self.from, motions, &Limits::default(), self.tick).map_err(|error| {
            let refused = (1..motions.len()).find(|&count| {
                Trajectory::plan(self.from, &motions[..count], &Limits::default(), self.tick)
                    .is_err()
            });
            let motion = refused.unwrap_or(motions.len()) - 1;
            let mut owners = self
                .steps
                .iter()
                .enumerate()
                .flat_map(|(index, step)| step.motions().map(move |_| index));
            // What is added behind the moves belongs to the last.
            let index = owners.nth(motion).unwrap_or(self.steps.len().saturating_sub(1));
            let error = Error::from(error);
            let count = self.steps.len();
            if count == 1 { error } else { error.within(place(index, count)) }
        })
    }

    /// Returns the moves' windows, in order. They cover the whole run.
    pub fn windows(&self, trajectory: &Trajectory) -> Vec<Window> {
        let mut windows: Vec<Window> = Vec::new();
        let mut ticks = 0;
        let mut plans = trajectory.plans().iter();
        for (index, step) in self.steps.iter().enumerate() {
            // A dwell commands nothing: what still happens during it is the work of the move
            // before.
            let dwells = matches!(step.motion, Move::Dwell { .. });
            if windows.is_empty() || !dwells {
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
