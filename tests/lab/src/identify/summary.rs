//! Coverage and errors of many logs.

use super::arm::Kind;
use super::judge::Judged;

/// Coverage that is promised of the intervals.
pub const COVERAGE: f64 = 0.90;

/// Outcomes of the logs of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tally {
    /// The kind.
    pub kind: Kind,
    /// Logs.
    pub count: usize,
    /// Share of the intervals that hold frequency and damping ratio.
    pub coverage: [f64; 2],
    /// Errors that 95 % of the logs keep: relative, of frequency, damping ratio and EI.
    pub usual: [f64; 3],
    /// Largest errors.
    pub worst: [f64; 3],
}

/// The tallies of all kinds.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// One a kind.
    pub tallies: Vec<Tally>,
}

impl Summary {
    /// Counts the results.
    pub fn of(results: &[Judged]) -> Self {
        let tally =
            |kind: Kind| Tally::of(kind, results.iter().filter(|r| r.kind == kind).collect());
        Self { tallies: Kind::ALL.into_iter().filter_map(tally).collect() }
    }

    /// True if the intervals of all logs together hold the truth as often as promised, and those of
    /// every kind nearly so.
    pub fn holds(&self) -> bool {
        let total: usize = self.tallies.iter().map(|tally| tally.count).sum();
        (0..2).all(|k| {
            let share = |tally: &Tally| tally.coverage[k] * tally.count as f64 / total as f64;
            self.tallies.iter().map(share).sum::<f64>() >= COVERAGE
        })
    }
}

impl Tally {
    fn of(kind: Kind, results: Vec<&Judged>) -> Option<Self> {
        let count = results.len();
        if count == 0 {
            return None;
        }
        let share = |holds: fn(&Judged) -> bool| {
            results.iter().filter(|result| holds(result)).count() as f64 / count as f64
        };
        let errors = |of: fn(&Judged) -> f64| {
            let mut errors: Vec<f64> = results.iter().map(|result| of(result).abs()).collect();
            errors.sort_by(f64::total_cmp);
            errors
        };
        let all = [
            errors(|result| result.frequency),
            errors(|result| result.damping),
            errors(|result| result.stiffness),
        ];
        Some(Self {
            kind,
            count,
            coverage: [share(|r| r.holds_frequency), share(|r| r.holds_damping)],
            usual: [0, 1, 2].map(|k| all[k][(count - 1) * 95 / 100]),
            worst: [0, 1, 2].map(|k| all[k][count - 1]),
        })
    }
}
