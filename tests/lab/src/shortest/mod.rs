//! Time-optimal motions of the hub beside those of Ruckig.
//!
//! [`draw`] makes a case from a number: two states of the hub and limits. [`peer`] asks Ruckig for
//! its duration, [`trial`] plans the case and judges it, [`summary`] counts.

pub mod draw;
pub mod peer;
pub mod summary;
pub mod trial;

use std::ops::Range;

use self::summary::Summary;
use crate::campaign;

/// Judges the cases of those numbers.
pub fn run(seed: u64, numbers: Range<u64>, done: &(dyn Fn(u64) + Sync)) -> Summary {
    let mut summary = Summary::default();
    for chunk in campaign::chunks(numbers.start, numbers.end) {
        let trials = campaign::each("case", chunk.clone(), &|| done(1), |index| {
            trial::trial(&draw::draw(seed, index))
        });
        for (index, trial) in chunk.zip(trials) {
            summary.add(index, &trial);
        }
    }
    summary
}
