//! The first hours of what runs for days.

use stillbeam_lab::stress::long;

#[test]
fn stops_are_exact_and_nothing_drifts() {
    for run in long::shuttles(1_000_000, &|_| ()).expect("runs") {
        assert!(run.stops > 7000, "{run:?}");
        assert_eq!(run.missed, 0, "{run:?}");
        assert!(run.drift < 1e-4, "{run:?}");
    }
}

#[test]
fn a_mode_keeps_its_phase() {
    for run in long::ringing(&[1e-3, 1e-2, 0.1, 1.0, 3.0], 1_000_000, &|_| ()).expect("runs") {
        // Half an f32's rounding a radian; rounding takes energy, and hardly gives any.
        assert!(run.slip.abs() < 6e-8, "{run:?}");
        assert!(run.amplitude < 1.0001, "{run:?}");
    }
}

#[test]
fn a_turning_hub_keeps_its_resolution() {
    let run = long::rotation(7.3, 1_000_000, &|_| ()).expect("a run");
    assert!(run.turns > 10_000.0);
    // An f32 near ½ turn is rounded to 3e-8.
    assert!(run.off < 6e-8 && run.uneven < 1.2e-7, "{run:?}");
}
