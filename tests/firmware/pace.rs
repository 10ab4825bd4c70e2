//! Late, missed and early ticks from a counter that wraps.

use proptest::prelude::*;
use stillbeam::axis::{Pace, Timing};

const PERIOD: u32 = 10_000;

/// A tick that is due, so many counts late, after so many missed ones.
fn due(late: u32, missed: u32) -> Timing {
    Timing { due: true, early: 0, late, missed }
}

/// A tick that comes so many counts before its time.
fn early(early: u32, due: bool) -> Timing {
    Timing { due, early, late: 0, missed: 0 }
}

/// A pace, and a clock that starts shortly before its readings wrap.
fn clock() -> impl FnMut(u32) -> Timing {
    let mut pace = Pace::new(PERIOD);
    let mut now = u32::MAX - 15_000;
    move |counts| {
        now = now.wrapping_add(counts);
        pace.arrive(now)
    }
}

#[test]
fn on_time_late_and_missed() {
    let mut after = clock();
    assert_eq!(after(0), due(0, 0), "the first is never late");
    assert_eq!(after(10_000), due(0, 0));
    assert_eq!(after(10_300), due(300, 0), "across the wrap");
    assert_eq!(after(9_700), due(0, 0), "lateness does not add up");
    assert_eq!(after(30_050), due(50, 2));
    assert_eq!(after(9_950), due(0, 0), "no catching up");
}

/// Half a period is the bound of early ticks alone: late ones are not rounded to the nearest
/// period.
#[test]
fn a_tick_late_by_more_than_half_a_period_is_late_not_missed() {
    let mut after = clock();
    after(0);
    assert_eq!(after(16_000), due(6_000, 0), "0.6 of a period late");
    assert_eq!(after(4_000), due(0, 0), "the phase is kept");
    assert_eq!(after(25_000), due(5_000, 1), "1.5 periods after its due time");
    assert_eq!(after(5_000), due(0, 0));
    assert_eq!(after(29_999), due(9_999, 1), "a count less than two periods");
    assert_eq!(after(1), due(0, 0));
}

/// Six ticks are missed, then six come 20 µs apart: the path must not run ahead by them.
#[test]
fn a_burst_after_a_freeze_is_not_due() {
    let mut after = clock();
    after(0);
    assert_eq!(after(70_000), due(0, 6), "the tick that ends the freeze");
    for k in 1..=6 {
        assert_eq!(after(20), early(10_000 - 20 * k, false), "burst, tick {k}");
    }
    assert_eq!(after(10_000 - 6 * 20), due(0, 0), "the next is on time again");
}

/// A burst of a hundred ticks, at any time within a period, makes one tick at most.
#[test]
fn a_burst_makes_one_tick_at_most() {
    for phase in (0..PERIOD).step_by(250) {
        let mut after = clock();
        after(0);
        assert!(after(7 * PERIOD + phase).due);
        let made = (0..100).filter(|_| after(1).due).count();
        assert!(made <= 1, "{made} of 100 at {phase}");
    }
}

#[test]
fn jitter_of_up_to_half_a_period_is_allowed_and_does_not_add_up() {
    let mut after = clock();
    after(0);
    for jitter in [1, 20, 3_000, PERIOD / 2] {
        assert_eq!(after(PERIOD - jitter), early(jitter, true));
        assert_eq!(after(PERIOD + jitter), due(0, 0), "the phase is kept");
    }
    assert_eq!(after(PERIOD / 2 - 1), early(PERIOD / 2 + 1, false));
    assert_eq!(after(PERIOD / 2 + 1), due(0, 0));
}

/// A source of ticks that is off by 0.1 % has one tick in a thousand too many, or too few.
#[test]
fn drift_makes_or_misses_one_tick_a_thousand() {
    for (interval, early, missed) in [(9_990, 100, 0), (10_010, 0, 100)] {
        let mut after = clock();
        after(0);
        let ticks: Vec<Timing> = (0..100_000).map(|_| after(interval)).collect();
        let refused = ticks.iter().filter(|timing| !timing.due).count();
        let lost: u32 = ticks.iter().map(|timing| timing.missed).sum();
        assert_eq!((refused, lost), (early, missed), "every {interval}");
    }
}

/// A freeze of most of the counter's range is no early tick.
#[test]
fn a_long_freeze_is_told_from_an_early_tick() {
    let mut after = clock();
    after(0);
    let freeze = u32::MAX - PERIOD;
    assert_eq!(after(freeze), due(freeze % PERIOD, freeze / PERIOD - 1));
}

/// Periods outside of the range are brought to its ends, and every reading of the counter is
/// judged.
#[test]
fn any_period_and_any_reading_is_judged() {
    let periods = prop_oneof![Just(0), Just(1), Just(2), Just(u32::MAX), any::<u32>()];
    proptest!(|(period in periods, readings in prop::collection::vec(any::<u32>(), 1..100))| {
        let mut pace = Pace::new(period);
        let period = period.clamp(1, 1 << 30);
        for now in readings {
            let timing = pace.arrive(now);
            prop_assert!(timing.late < period);
            prop_assert_eq!(timing.due, timing.early <= period / 2);
            prop_assert!(timing.early == 0 || (timing.late, timing.missed) == (0, 0));
        }
    });
}

/// Ticks and missed ticks add up to the time that has gone.
#[test]
fn no_tick_is_lost_without_being_counted() {
    proptest!(|(delays in prop::collection::vec(0u32..80_000, 1..200))| {
        let mut pace = Pace::new(PERIOD);
        pace.arrive(0);
        let (mut next, mut ticks) = (PERIOD, 0u32);
        for delay in delays {
            let now = next.wrapping_add(delay);
            let timing = pace.arrive(now);
            ticks += 1 + timing.missed;
            prop_assert_eq!(timing, due(delay % PERIOD, delay / PERIOD));
            prop_assert_eq!(ticks, now / PERIOD);
            next = (ticks + 1) * PERIOD;
        }
    });
}

/// Counts between two ticks: on time, jitter, bursts, freezes, the same tick twice.
fn intervals() -> impl Strategy<Value = u32> {
    prop_oneof![
        4 => Just(PERIOD),
        2 => PERIOD / 2..2 * PERIOD,
        4 => 0u32..100,
        1 => 0u32..20 * PERIOD,
    ]
}

/// However ticks come, no more are made than one at the beginning and one a period, to the nearest;
/// with those that were missed, no fewer.
#[test]
fn the_path_runs_neither_ahead_of_time_nor_behind_it() {
    proptest!(ProptestConfig::with_cases(300), |(
        start in any::<u32>(),
        intervals in prop::collection::vec(intervals(), 1..300),
    )| {
        let mut pace = Pace::new(PERIOD);
        pace.arrive(start);
        let (mut elapsed, mut made, mut missed) = (0u32, 1u32, 0u32);
        for interval in intervals {
            elapsed += interval;
            let timing = pace.arrive(start.wrapping_add(elapsed));
            made += u32::from(timing.due);
            missed += timing.missed;
            let periods = (elapsed + PERIOD / 2) / PERIOD;
            prop_assert!(made + missed <= periods + 1, "{made} and {missed} in {elapsed}");
            prop_assert!(made + missed > elapsed / PERIOD, "{made} and {missed} in {elapsed}");
        }
    });
}

/// The tick in seconds is the one constant; counts of any clock follow from it, or there are none.
#[test]
fn a_period_is_a_whole_number_of_counts() {
    let counted = [
        (0.010, 170_000_000, 1_700_000),
        (0.010, 25_000_000, 250_000),
        (0.001, 25_000_000, 25_000),
        (0.0023, 1_000_000, 2_300),
        (0.000_125, 1_000_000, 125),
        (1e-6, 1_000_000, 1),
    ];
    for (tick, rate, counts) in counted {
        assert_eq!(Pace::period(tick, rate), Some(counts), "{tick} s at {rate}/s");
    }
    for tick in [1.0 / 3000.0, 1e-7, 0.0, -0.01, 2_000.0, f64::NAN, f64::INFINITY] {
        assert_eq!(Pace::period(tick, 1_000_000), None, "{tick} s");
    }
}
