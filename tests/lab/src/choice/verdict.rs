//! The verdict on one arm.

use stillbeam::Error as CoreError;
use stillbeam::select::{Choice, Rung, Tolerance};

/// The choice for one arm and the true errors of the alternatives.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Tolerance that was asked for.
    pub tolerance: Tolerance,
    /// Ticks of the moves and of a first period after them.
    pub ticks: u64,
    /// The arm's ladder.
    pub ladder: [Rung; Rung::LADDER.len()],
    /// Choice of `auto`, or the reason why there is none.
    pub choice: Result<Choice, CoreError>,
    /// Errors against the reference rod by rung of the ladder: the larger one of the tip's and the
    /// torque's, each over its tolerance. Infinite if a rung does not accept the moves.
    pub errors: [f64; Rung::LADDER.len()],
    /// Errors of the chosen rung, each over its tolerance: tip and torque.
    pub parts: Option<[f64; 2]>,
    /// Judge that found the verdict.
    pub judged: Judged,
}

/// Judge by which a verdict was found.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    /// Polynomials of the judge that decided.
    pub order: usize,
    /// False if the errors still changed too much with the finest judge.
    pub settled: bool,
    /// Difference of a stricter judge, if one was asked.
    pub doubt: Option<Doubt>,
}

/// Difference of a stricter judge, over the rungs on which the verdict depends.
#[derive(Clone, Copy, Debug, Default)]
pub struct Doubt {
    /// Largest change of an error over its tolerance, of those that either judge finds below two.
    pub change: f64,
    /// Rungs that meet both tolerances for one judge and not for the other.
    pub turned: usize,
}

impl Doubt {
    /// Computes the difference from pairs of a rung's error over its tolerance by the two judges.
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
    /// Returns the place on the ladder of the cheapest rung that met both tolerances.
    pub fn cheapest(&self) -> Option<usize> {
        self.errors.iter().position(|&error| error <= 1.0)
    }

    /// Returns the chosen rung's place on the ladder.
    pub fn chosen(&self) -> Option<usize> {
        let rung = self.choice.as_ref().ok()?.rung;
        self.ladder.iter().position(|&other| other == rung)
    }

    /// Returns the true error of the chosen rung over its tolerance, the larger of the two.
    pub fn error(&self) -> Option<f64> {
        Some(self.errors[self.chosen()?])
    }

    /// True if the chosen rung errs by more than was asked for.
    pub fn exceeds(&self) -> bool {
        self.error().is_some_and(|error| error > 1.0)
    }

    /// Returns the rungs of the choice above the cheapest that met the tolerances, or `None` if no
    /// cheaper one met them.
    pub fn rungs_too_dear(&self) -> Option<usize> {
        let chosen = self.chosen()?;
        Some(chosen.saturating_sub(self.cheapest().unwrap_or(chosen)))
    }
}
