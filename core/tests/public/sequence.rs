//! Stale setpoints, and torques that a format does not resolve.

use stillbeam::axis::{Freshness, Sequence};
use stillbeam::drive::{TorquePeak, odrive};

#[test]
fn what_is_next_what_is_missing_and_what_is_stale() {
    let last = Sequence(65_534);
    assert_eq!(last.next().after(last), Freshness::Next);
    assert_eq!(last.next().next().after(last), Freshness::Skipped(1), "across the wrap");
    assert_eq!(last.after(last), Freshness::Repeated);
    assert_eq!(Sequence(65_533).after(last), Freshness::Stale);
    assert_eq!(Sequence(65_534u16.wrapping_add(0x7fff)).after(last), Freshness::Skipped(0x7ffe));
    assert_eq!(Sequence(65_534u16.wrapping_add(0x8000)).after(last), Freshness::Stale);
}

#[test]
fn a_torque_peak_below_a_hundred_counts_is_reported_once() {
    let mut peak = TorquePeak::default();
    [0.01, -0.0999, 0.05].into_iter().for_each(|torque| peak.note(torque));
    let coarse = peak.finish(odrive::TORQUE_STEP).expect("99.9 counts are too few");
    assert!((coarse.peak, (coarse.counts - 99.9).abs() < 1e-3) == (0.0999, true), "{coarse:?}");
    assert_eq!(peak.finish(odrive::TORQUE_STEP), None, "the next move has not begun");
    peak.note(-0.1001);
    assert_eq!(peak.finish(odrive::TORQUE_STEP), None, "100.1 counts are enough");
}
