//! The quality of the choices of `auto`: random arms and moves, every rung of the ladder judged by
//! the reference rod.

mod document;
mod judge;
mod random;
mod summary;
mod verdict;

pub use document::{blocks, page, picture};
pub use random::{Case, DISTRIBUTION};
pub use summary::Summary;
pub use verdict::{Doubt, Judged, Verdict};

use crate::campaign;
use stillbeam_sim::error::Error;

/// Seed of the arms of the documented campaign.
pub const SEED: u64 = 20_261_122;

/// Judges the first `count` arms of a seed on all cores. The verdicts and their order do not depend
/// on the number of cores.
pub fn campaign(seed: u64, count: u64, done: &(dyn Fn() + Sync)) -> Result<Vec<Verdict>, Error> {
    let verdicts = campaign::each("arm", 0..count, done, |index| {
        let verdict = Case::random(seed, index).and_then(|case| case.judge(index));
        verdict.map_err(|error| error.within(format_args!("arm {index}")))
    });
    verdicts.into_iter().collect()
}
