//! Late and missed ticks from a counter that wraps.

use proptest::prelude::*;
use stillbeam::axis::{Pace, Timing};

const PERIOD: u32 = 10_000;

#[test]
fn on_time_late_and_missed() {
    let mut pace = Pace::new(PERIOD);
    let mut now = u32::MAX - 15_000;
    let mut after = |counts: u32| {
        now = now.wrapping_add(counts);
        pace.arrive(now)
    };
    assert_eq!(after(0), Timing { late: 0, missed: 0 }, "the first is never late");
    assert_eq!(after(10_000), Timing { late: 0, missed: 0 });
    assert_eq!(after(10_300), Timing { late: 300, missed: 0 }, "across the wrap");
    assert_eq!(after(9_700), Timing { late: 0, missed: 0 }, "lateness does not add up");
    assert_eq!(after(30_050), Timing { late: 50, missed: 2 });
    assert_eq!(after(9_950), Timing { late: 0, missed: 0 }, "no catching up");
}

#[test]
fn an_early_tick_is_not_taken_for_one_that_is_half_a_range_late() {
    let mut pace = Pace::new(PERIOD);
    pace.arrive(0);
    assert_eq!(pace.arrive(9_999), Timing { late: 0, missed: 0 });
}

/// Ticks and missed ticks add up to the time that has gone.
#[test]
fn no_tick_is_lost_without_being_counted() {
    proptest!(|(delays in prop::collection::vec(0u32..80_000, 1..200))| {
        let mut pace = Pace::new(PERIOD);
        pace.arrive(0);
        let (mut due, mut ticks) = (PERIOD, 0u32);
        for delay in delays {
            let now = due.wrapping_add(delay);
            let timing = pace.arrive(now);
            ticks += 1 + timing.missed;
            prop_assert_eq!(timing.late, delay % PERIOD);
            prop_assert_eq!(ticks, now / PERIOD);
            due = (ticks + 1) * PERIOD;
        }
    });
}
