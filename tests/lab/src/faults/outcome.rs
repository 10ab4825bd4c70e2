//! Counts of a run.

use std::collections::BTreeMap;

use stillbeam_board::{Board, Excess, Watch};
use stillbeam_protocol::Refusal;

/// Result of one run or of many.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Number of runs.
    pub runs: u64,
    /// Faults injected.
    pub injected: u64,
    /// Setpoints judged.
    pub setpoints: u64,
    /// Frames dropped as garbled.
    pub dropped: u64,
    /// Requests accepted.
    pub accepted: u64,
    /// Requests refused, by the kind of refusal.
    pub refused: BTreeMap<&'static str, u64>,
    /// Stops asked for, by a lost link, by missed ticks.
    pub stops: [u64; 3],
    /// Greatest shares of the allowed values.
    pub worst: Excess,
    /// Promises that did not hold.
    pub broken: Vec<String>,
}

impl Outcome {
    /// Returns the outcome of one run.
    pub(super) fn of(board: &Board, watch: &Watch) -> Self {
        let mut outcome = Self {
            runs: 1,
            setpoints: watch.setpoints,
            dropped: board.garbled,
            worst: watch.worst,
            broken: watch.broken.iter().cloned().collect(),
            ..Self::default()
        };
        for answer in &board.answers {
            match answer {
                Ok(_) => outcome.accepted += 1,
                Err(refusal) => *outcome.refused.entry(kind(refusal)).or_default() += 1,
            }
        }
        outcome
    }

    /// Adds another outcome.
    pub fn add(&mut self, other: Self) {
        self.runs += other.runs;
        self.injected += other.injected;
        self.setpoints += other.setpoints;
        self.dropped += other.dropped;
        self.accepted += other.accepted;
        for (kind, count) in other.refused {
            *self.refused.entry(kind).or_default() += count;
        }
        for (mine, theirs) in self.stops.iter_mut().zip(other.stops) {
            *mine += theirs;
        }
        self.worst = self.worst.max(other.worst);
        self.broken.extend(other.broken);
    }
}

fn kind(refusal: &Refusal<'_>) -> &'static str {
    match refusal {
        Refusal::Range { .. } => "out of range",
        Refusal::Queue { .. } => "queue full",
        Refusal::Mode(_) => "mode",
        Refusal::NotAtRest => "not at rest",
        Refusal::Stale => "stale",
        Refusal::NotMeasured => "not measured",
        Refusal::Busy => "busy",
        Refusal::NoPlanner => "no planner",
        Refusal::Axis(_) => "no such axis",
        Refusal::NoMove => "no move",
        Refusal::NoPaths => "no paths",
        Refusal::NoPath => "no path",
        Refusal::Starved => "starved",
        Refusal::NoSensor => "no sensor",
        Refusal::DriveFault(_) => "drive fault",
        Refusal::DriveSilent => "drive silent",
        Refusal::NotPrepared { .. } => "not prepared",
        Refusal::Other => "other",
    }
}
