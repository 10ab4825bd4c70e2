//! The limits along a move, held by the reference rod behind the moves before it.

use std::cell::OnceCell;

use stillbeam::{Limits, Remedy};

use super::asked::Asked;
use crate::error::Error;
use crate::limits::{Excess, Peak, Quantity, Refusal, Way, kinematic, load, remedy};
use crate::reference::rod::Resume;
use crate::step::{Motion, Step};

/// A move whose plans are checked.
pub(super) struct Check<'a> {
    asked: &'a Asked<'a>,
    /// State of the rod at the beginning of the move; `None` at rest.
    state: OnceCell<Option<Resume>>,
}

impl<'a> Check<'a> {
    /// Creates the check of a move.
    ///
    /// # Errors
    /// Holding the arm at rest somewhere on its way exceeds a limit.
    pub fn new(asked: &'a Asked<'a>) -> Result<Self, Error> {
        let check = Self { asked, state: OnceCell::new() };
        check.weight()?;
        Ok(check)
    }

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

    /// The refusal of a move that exceeds a limit.
    pub fn refusal(&self, excess: Excess, way: Way) -> Error {
        Refusal { excess, count: self.asked.count, way }.into()
    }

    /// Returns every limit that a motion exceeds on the reference rod.
    pub fn over(&self, motion: Motion, limits: &Limits) -> Result<Vec<Excess>, Error> {
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

/// Tightens every limit that a plan has exceeded, for the next plan.
pub(super) fn tighten(limits: &mut Limits, over: &[Excess]) {
    for excess in over {
        if let Some(limit) = excess.quantity.of_mut(limits) {
            // A little more, so that rounding does not take another round.
            *limit *= (1.0 - 1e-5) / excess.ratio();
        }
    }
}
