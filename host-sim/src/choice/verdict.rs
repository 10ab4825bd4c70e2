//! What came of one arm.

use stillbeam::Error as CoreError;
use stillbeam::stepper::{Choice, Rung};

/// The choice for one arm beside what it could have been.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// What was asked for, fraction of L.
    pub tolerance: f64,
    /// Ticks of the moves and of a first period after them.
    pub ticks: u64,
    /// The arm's ladder.
    pub ladder: [Rung; Rung::LADDER.len()],
    /// What `auto` chose, or why it did not.
    pub choice: Result<Choice, CoreError>,
    /// Largest distance of the tip from the reference rod by rung of the ladder, fraction of L;
    /// infinite where a rung does not accept the moves.
    pub errors: [f64; Rung::LADDER.len()],
    /// Whether the judge was the one for close cases.
    pub closely: bool,
    /// What a stricter judge makes of a rung's error, largest change over the tolerance, where that
    /// was looked at.
    pub doubt: Option<f64>,
}

impl Verdict {
    /// The cheapest rung that met the tolerance, its place on the ladder.
    pub fn cheapest(&self) -> Option<usize> {
        self.errors.iter().position(|&error| error <= self.tolerance)
    }

    /// The chosen rung's place on the ladder.
    pub fn chosen(&self) -> Option<usize> {
        let rung = self.choice.as_ref().ok()?.rung;
        self.ladder.iter().position(|&other| other == rung)
    }

    /// True error of what was chosen, fraction of L.
    pub fn error(&self) -> Option<f64> {
        Some(self.errors[self.chosen()?])
    }

    /// Whether what was chosen errs by more than was asked for.
    pub fn exceeds(&self) -> bool {
        self.error().is_some_and(|error| error > self.tolerance)
    }

    /// Rungs of the choice above the cheapest that met the tolerance; none where no cheaper one did.
    pub fn rungs_too_dear(&self) -> Option<usize> {
        let chosen = self.chosen()?;
        Some(chosen.saturating_sub(self.cheapest().unwrap_or(chosen)))
    }
}
