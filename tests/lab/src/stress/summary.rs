//! Counts of a campaign. They add up in any order.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::draw::method_name;
use super::spread::Spread;
use super::trial::{Run, Verdict};
use stillbeam_sim::solver::Solver;

/// Number of cases of each kind that are named.
const NAMED: usize = 20;

/// A campaign so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Seed of the scenes.
    pub seed: u64,
    /// Number of scenes that are done; their numbers are below this.
    pub scenes: u64,
    /// Number of ticks in both precisions.
    pub ticks: u64,
    /// First few failures, by the scene's number.
    pub failures: Vec<Failure>,
    /// Counts by method.
    pub methods: BTreeMap<String, Counts>,
    /// Number of refusals by reason.
    pub reasons: BTreeMap<String, u64>,
}

/// An event that should not have happened.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Failure {
    /// The scene.
    pub index: u64,
    /// The method.
    pub method: String,
    /// Kind of the failure.
    pub what: String,
}

/// Counts of one method.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Runs that were refused.
    pub refused: u64,
    /// Runs to the end.
    pub ran: u64,
    /// Panics.
    pub panicked: u64,
    /// Runs with a number that is not finite.
    pub not_finite: u64,
    /// Runs that did not end at their target.
    pub off_target: u64,
    /// Runs in which the arm swings up, see [`Run::rings_up`]. They are not compared.
    pub rings_up: u64,
    /// Difference of f32 from f64, over the peak deflection, by decade of the run's condition: `3`
    /// is 10³ to 10⁴.
    pub deflection: BTreeMap<String, Spread>,
    /// Runs in which the difference exceeds the method's bound, see [`bound`].
    pub above: u64,
    /// Difference of the torque in f32 from f64, all decades.
    pub torque: Spread,
}

/// Largest distance from the target that is not counted, rad: an f32's part of a turn, and an f64's
/// angle of 10⁶ rad.
const ON_TARGET: f64 = 4e-7;

impl Summary {
    /// Creates an empty summary.
    pub fn new(seed: u64) -> Self {
        Self { seed, ..Self::default() }
    }

    /// Counts the verdicts on one scene.
    pub fn add(&mut self, index: u64, verdicts: &[(Solver, Verdict)]) {
        for (solver, verdict) in verdicts {
            let name = method_name(solver);
            let counts = self.methods.entry(name.clone()).or_default();
            let mut failures = Vec::new();
            match verdict {
                Verdict::Refused(reason) => {
                    counts.refused += 1;
                    *self.reasons.entry(reason.clone()).or_default() += 1;
                }
                Verdict::Panicked(text) => {
                    counts.panicked += 1;
                    failures.push(format!("panic: {text}"));
                }
                Verdict::Ran(run) => {
                    self.ticks += 2 * run.ticks;
                    failures.extend(counts.add(run, bound(&name)));
                }
            }
            for what in failures {
                if self.failures.len() < NAMED {
                    self.failures.push(Failure { index, method: name.clone(), what });
                }
            }
        }
        self.scenes += 1;
    }

    /// Sums a count over all methods.
    pub fn total(&self, of: impl Fn(&Counts) -> u64) -> u64 {
        self.methods.values().map(of).sum()
    }

    /// Returns the number of events that should not have happened.
    pub fn faults(&self) -> u64 {
        self.total(|counts| counts.panicked + counts.not_finite + counts.off_target + counts.above)
    }
}

impl Counts {
    fn add(&mut self, run: &Run, bound: f64) -> Vec<String> {
        self.ran += 1;
        let mut failures = Vec::new();
        for (scalar, broken) in ["f64", "f32"].into_iter().zip(run.broken) {
            if let Some(tick) = broken {
                failures.push(format!("{scalar}: not finite at tick {tick}"));
            }
        }
        if !failures.is_empty() {
            self.not_finite += 1;
            return failures;
        }
        if run.off_target > ON_TARGET {
            self.off_target += 1;
            failures.push(format!("ends {:e} rad from its target", run.off_target));
        }
        if run.rings_up {
            self.rings_up += 1;
            return failures;
        }
        let decade = format!("{}", run.condition.log10().floor().clamp(0.0, 9.0));
        self.deflection.entry(decade).or_default().add(run.deflection);
        self.torque.add(run.torque);
        // Where the condition leaves f32 no digit there is nothing to compare.
        if run.condition < BEYOND && run.deflection > bound * run.condition {
            self.above += 1;
            failures.push(format!(
                "f32 is {:.1e} of the peak off at a condition of {:.1e}",
                run.deflection, run.condition
            ));
        }
        failures
    }
}

/// Condition from which on f32 has no digit of a deflection left.
pub const BEYOND: f64 = 1e5;

/// Largest difference of the deflection between f32 and f64, of its peak, for a condition of 1.
///
/// The product `K q` of an assembled stiffness loses digits with the fourth power of the number of
/// elements.
pub fn bound(method: &str) -> f64 {
    match method {
        "newmark, 4 consistent" => 1e-1,
        "newmark, 8 consistent" => 1.0,
        _ => 3e-2,
    }
}
