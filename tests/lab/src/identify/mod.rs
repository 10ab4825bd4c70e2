//! Logs whose truth is known: random arms by the reference rod, measured as people measure.
//!
//! The rod makes the tip's motion. Noise, steps of a converter, jitter, gaps, a delay and a filter
//! make a log of it, which `identify` reads as any other.

mod arm;
pub mod document;
mod judge;
mod log;
mod summary;

pub use arm::{Case, Kind};
pub use judge::{Judged, identified, judge};
pub use summary::{Summary, Tally};

use stillbeam_sim::error::Error;

use crate::campaign;

/// Seed of the documented campaign.
pub const SEED: u64 = 20_261_127;

/// Identifies the logs of those numbers on all cores. The order of the results does not depend on
/// the number of cores.
pub fn campaign(
    seed: u64,
    numbers: std::ops::Range<u64>,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<Judged>, Error> {
    let results = campaign::each("log", numbers, done, |index| {
        judge(&Case::random(seed, index)?)
            .map_err(|error| error.within(format_args!("log {index}")))
    });
    results.into_iter().collect()
}
