//! A line a second for whoever watches, over defmt.

use core::sync::atomic::Ordering;

use embassy_time::{Duration, Ticker};

use crate::tick::{self, MADE};
use crate::{board, shared};

// The log is kept in ticks, as everything else.
defmt::timestamp!("{=u32}", MADE.load(Ordering::Relaxed));

/// Reports the cost of a tick, the ticks that did not come in time, and the state of the axes.
#[embassy_executor::task]
pub async fn run() {
    let mut ticker = Ticker::every(Duration::from_secs(1));
    loop {
        ticker.next().await;
        let counters = shared::with(|s| s.counters);
        defmt::info!(
            "tick: {} {=str} last, {} worst; {} us late at most, {} missed, {} early, {} overruns, {} dropped",
            counters.cost,
            board::UNIT,
            counters.worst,
            tick::microseconds(counters.late),
            counters.missed,
            counters.early,
            counters.overruns,
            counters.dropped
        );
        for axis in 0.. {
            let state =
                shared::with(|s| s.joints.get(axis).map(|j| (j.axis.mode(), j.axis.cause())));
            match state {
                Some((mode, Some(cause))) => defmt::info!("axis {}: {}, {}", axis, mode, cause),
                Some((mode, None)) => defmt::info!("axis {}: {}", axis, mode),
                None => break,
            }
        }
    }
}
