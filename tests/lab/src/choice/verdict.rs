//! What came of one arm.

use stillbeam::Error as CoreError;
use stillbeam::select::{Choice, Rung, Tolerance};

/// The choice for one arm beside what it could have been.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// What was asked for.
    pub tolerance: Tolerance,
    /// Ticks of the moves and of a first period after them.
    pub ticks: u64,
    /// The arm's ladder.
    pub ladder: [Rung; Rung::LADDER.len()],
    /// What `auto` chose, or why it did not.
    pub choice: Result<Choice, CoreError>,
    /// Errors beside the reference rod by rung of the ladder: the larger one of the tip's and the
    /// torque's, each over its tolerance. Infinite where a rung does not accept the moves.
    pub errors: [f64; Rung::LADDER.len()],
    /// Of the chosen rung, each over its tolerance: tip and torque.
    pub parts: Option<[f64; 2]>,
    /// True if the judge was the one for close cases.
    pub closely: bool,
    /// What a stricter judge makes of a rung's error over the tolerance, largest change, where that
    /// was looked at.
    pub doubt: Option<f64>,
}

impl Verdict {
    /// The cheapest rung that met both tolerances, its place on the ladder.
    pub fn cheapest(&self) -> Option<usize> {
        self.errors.iter().position(|&error| error <= 1.0)
    }

    /// The chosen rung's place on the ladder.
    pub fn chosen(&self) -> Option<usize> {
        let rung = self.choice.as_ref().ok()?.rung;
        self.ladder.iter().position(|&other| other == rung)
    }

    /// True error of what was chosen over its tolerance, the larger of the two.
    pub fn error(&self) -> Option<f64> {
        Some(self.errors[self.chosen()?])
    }

    /// True if what was chosen errs by more than was asked for.
    pub fn exceeds(&self) -> bool {
        self.error().is_some_and(|error| error > 1.0)
    }

    /// Rungs of the choice above the cheapest that met the tolerances; none where no cheaper one did.
    pub fn rungs_too_dear(&self) -> Option<usize> {
        let chosen = self.chosen()?;
        Some(chosen.saturating_sub(self.cheapest().unwrap_or(chosen)))
    }
}
