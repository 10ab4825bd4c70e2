//! Counts over many verdicts.

use stillbeam::Error as CoreError;
use stillbeam::select::Rung;

use super::judge::ORDERS;
use super::verdict::Verdict;

/// Counts over the choices of a campaign.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Number of arms.
    pub arms: usize,
    /// Chosen, by rung.
    pub chosen: [usize; Rung::LADDER.len()],
    /// Cheapest rung that met the tolerance, of all arms, by rung.
    pub cheapest: [usize; Rung::LADDER.len()],
    /// Chosen, by rungs above the cheapest that met the tolerance.
    pub too_dear: [usize; Rung::LADDER.len()],
    /// Chosen, true error above the tolerance.
    pub exceeded: usize,
    /// Of these, those whose error still changed with the finest judge.
    pub exceeded_unsettled: usize,
    /// Of those exceeded, those whose torque errs by more than its tolerance.
    pub torque_exceeded: usize,
    /// Chosen, the torque's error the larger one, each over its tolerance.
    pub torque_decides: usize,
    /// Chosen, true error above the expected one.
    pub underestimated: usize,
    /// Refused: no rung within the tolerance.
    pub tolerance: usize,
    /// Refused: bends too far for the exact kinematics.
    pub bends: usize,
    /// Refused for another reason.
    pub other: usize,
    /// Refused although a rung met the tolerance.
    pub needless: usize,
    /// Number of arms by the judge that decided, the coarsest first.
    pub judged: [usize; ORDERS.len()],
    /// Arms whose errors still changed with the finest judge.
    pub unsettled: usize,
    /// Arms whose judge was judged, of those whose errors are known.
    pub doubted: usize,
    /// Largest error of the judge over the tolerance, of these arms.
    pub doubt: f64,
    /// Rungs that a stricter judge has found on the other side of the tolerance.
    pub turned: usize,
}

impl Summary {
    /// Counts the verdicts.
    pub fn of(verdicts: &[Verdict]) -> Self {
        let count =
            |wanted: &dyn Fn(&Verdict) -> bool| verdicts.iter().filter(|v| wanted(v)).count();
        let by_place = |place: &dyn Fn(&Verdict) -> Option<usize>| {
            std::array::from_fn(|k| count(&|verdict| place(verdict) == Some(k)))
        };
        let by_rung = |place: &dyn Fn(&Verdict) -> Option<usize>| {
            Rung::LADDER.map(|rung| count(&|v| place(v).is_some_and(|k| v.ladder[k] == rung)))
        };
        let refused = |kind: fn(&CoreError) -> bool| {
            count(&|verdict| verdict.choice.as_ref().is_err_and(kind))
        };
        let (tolerance, bends) = (
            refused(|error| matches!(error, CoreError::Tolerance { .. })),
            refused(|error| matches!(error, CoreError::BendsTooFar { .. })),
        );
        let expected = |verdict: &Verdict| {
            verdict.choice.as_ref().ok().map(|choice| choice.expected.excess(&verdict.tolerance))
        };
        let known = || verdicts.iter().filter(|v| v.judged.settled);
        let doubts = || known().filter_map(|v| v.judged.doubt);
        Self {
            arms: verdicts.len(),
            chosen: by_rung(&Verdict::chosen),
            cheapest: by_rung(&Verdict::cheapest),
            too_dear: by_place(&Verdict::rungs_too_dear),
            exceeded: count(&Verdict::exceeds),
            exceeded_unsettled: count(&|v| v.exceeds() && !v.judged.settled),
            torque_exceeded: count(&|v| v.parts.is_some_and(|[_, torque]| torque > 1.0)),
            torque_decides: count(&|v| v.parts.is_some_and(|[tip, torque]| torque > tip)),
            underestimated: count(&|verdict| {
                verdict
                    .error()
                    .zip(expected(verdict))
                    .is_some_and(|(error, expected)| error > expected)
            }),
            tolerance,
            bends,
            other: refused(|_| true) - tolerance - bends,
            needless: count(&|verdict| verdict.choice.is_err() && verdict.cheapest().is_some()),
            judged: std::array::from_fn(|k| count(&|v| v.judged.order == ORDERS[k])),
            unsettled: count(&|verdict| !verdict.judged.settled),
            doubted: doubts().count(),
            doubt: doubts().map(|doubt| doubt.change).fold(0.0, f64::max),
            turned: doubts().map(|doubt| doubt.turned).sum(),
        }
    }

    /// Returns the number of choices made.
    pub fn choices(&self) -> usize {
        self.chosen.iter().sum()
    }

    /// Returns the number of choices at most one rung above the cheapest that met the tolerance.
    pub fn at_most_one_too_dear(&self) -> usize {
        self.too_dear[0] + self.too_dear[1]
    }

    /// True if fewer than 1 in 1,000 choices exceed the tolerance and 99 in 100 are at most one
    /// rung too dear.
    pub fn holds(&self) -> bool {
        1000 * self.exceeded < self.choices()
            && 100 * self.at_most_one_too_dear() >= 99 * self.choices()
    }
}
