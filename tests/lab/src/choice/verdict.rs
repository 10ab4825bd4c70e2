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
    /// How it was found.
    pub judged: Judged,
}

/// How a verdict was found.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    /// Polynomials of the judge that had the last word.
    pub order: usize,
    /// False if the errors still changed too much as the finest judge had been asked.
    pub settled: bool,
    /// What a stricter judge makes of it, where that was looked at.
    pub doubt: Option<Doubt>,
}

/// How a stricter judge differs, over the rungs that the verdict hangs on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Doubt {
    /// Largest change of an error over its tolerance, of those that either judge finds below two.
    pub change: f64,
    /// Rungs that meet both tolerances for one judge and not for the other.
    pub turned: usize,
}

impl Doubt {
    /// Of a rung's error over its tolerance by the one judge and by the other.
    pub(super) fn of(pairs: &[(f64, f64)]) -> Self {
        let mut doubt = Self::default();
        for (a, b) in pairs.iter().filter(|(a, b)| a.min(*b) <= 2.0) {
            doubt.change = doubt.change.max((a - b).abs());
            doubt.turned += usize::from((*a <= 1.0) != (*b <= 1.0));
        }
        doubt
    }
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

    /// Rungs of the choice above the cheapest that met the tolerances; none where no cheaper one
    /// did.
    pub fn rungs_too_dear(&self) -> Option<usize> {
        let chosen = self.chosen()?;
        Some(chosen.saturating_sub(self.cheapest().unwrap_or(chosen)))
    }
}
