//! Counts of many trials.

use std::collections::BTreeMap;

use super::draw::Kind;
use super::trial::Trial;

/// Part of Ruckig's duration by which another duration counts as another.
pub const DURATION: f64 = 0.01;

/// Part of a limit, or of the way, by which more counts as a fault.
pub const PRECISION: f64 = 1e-6;

/// Numbers of faults that are kept.
const KEPT: usize = 20;

/// Outcome of the cases of one kind.
#[derive(Clone, Debug, Default)]
pub struct Counts {
    /// Cases.
    pub cases: u64,
    /// Cases that both refuse.
    pub refused: u64,
    /// Cases that Ruckig alone refuses.
    pub peer_refused: u64,
    /// Greatest duration less Ruckig's, in parts of it.
    pub longer: f64,
    /// The same the other way round.
    pub shorter: f64,
    /// Greatest excess of a limit, in parts of it.
    pub excess: f64,
    /// Greatest miss of the end, in parts of the way and of the limits.
    pub miss: f64,
}

/// Counts of a campaign.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// By kind.
    pub counts: BTreeMap<Kind, Counts>,
    /// Number of faults.
    pub faults: u64,
    /// The first faults: number of the case, and what is wrong.
    pub first: Vec<(u64, String)>,
}

impl Summary {
    /// Adds the case of that number.
    pub fn add(&mut self, index: u64, trial: &Trial) {
        let counts = self.counts.entry(trial.kind).or_default();
        counts.cases += 1;
        counts.excess = counts.excess.max(trial.excess);
        counts.miss = counts.miss.max(trial.miss);
        match (&trial.duration, &trial.peer) {
            (Err(_), Err(_)) => counts.refused += 1,
            (Ok(_), Err(_)) => counts.peer_refused += 1,
            _ => {}
        }
        if let Some(longer) = trial.longer() {
            counts.longer = counts.longer.max(longer);
            counts.shorter = counts.shorter.max(-longer);
        }
        if let Some(fault) = fault(trial) {
            self.faults += 1;
            if self.first.len() < KEPT {
                self.first.push((index, fault));
            }
        }
    }
}

/// Returns what is wrong with a trial, if anything is. A value that is no number is.
fn fault(trial: &Trial) -> Option<String> {
    let beyond = |value: f64, most: f64| value.is_nan() || value > most;
    match (&trial.duration, &trial.peer) {
        (Err(error), Ok(peer)) => return Some(format!("refused, Ruckig takes {peer} s: {error}")),
        (Ok(own), Ok(peer)) if trial.longer().is_some_and(|longer| beyond(longer, DURATION)) => {
            return Some(format!("takes {own} s, Ruckig {peer} s"));
        }
        _ => {}
    }
    if beyond(trial.excess, PRECISION) {
        return Some(format!("exceeds a limit by {:e} of it", trial.excess));
    }
    beyond(trial.miss, PRECISION).then(|| format!("misses its end by {:e}", trial.miss))
}
