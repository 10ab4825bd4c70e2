//! The axes of the campaign, which are those of the firmware's application, and their times.

pub use stillbeam_wiring::Configuration;
use stillbeam_wiring::axes::PATIENCE;
pub use stillbeam_wiring::axes::{CONFIGURATIONS, TICK};

/// Time in which a stop from the greatest rate is over, s. It is several times the slowest stop,
/// 2.12 · 5/15 = 0.7.
const STOP: f64 = 2.5;

/// Ticks after which a silent axis must be at rest: its patience and a stop.
pub const SILENCE: u32 = ticks(PATIENCE + STOP);

/// Converts a time to ticks, to the nearest.
pub const fn ticks(seconds: f64) -> u32 {
    (seconds / TICK + 0.5) as u32
}
