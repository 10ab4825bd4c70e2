//! A run with a fault of the drive and one without, behind a drive and a machine of its own.

use stillbeam_lab::plant::{self, Fault};

/// `cargo lab plant` runs the same for every fault, many times of each. A run takes some ten seconds
/// of a core.
#[test]
fn setpoints_hold_and_the_arm_comes_to_rest_behind_its_drive() {
    for fault in [Fault::None, Fault::DriveFault] {
        let outcome = plant::of(fault, 3, 1, &|| ()).expect("machines that can be simulated");
        println!("{}: {outcome:?}", fault.name());
        assert!(outcome.broken.is_empty(), "{}: {:?}", fault.name(), outcome.broken);
        // Runs that inject nothing, or judge nothing, would hold as well.
        assert_eq!(outcome.injected == 0, fault == Fault::None, "{}", fault.name());
        assert_eq!(outcome.stops, if fault.cause().is_some() { outcome.runs } else { 0 });
        assert!(outcome.setpoints > 50 * outcome.runs, "{}: {outcome:?}", fault.name());
        assert!(outcome.behind > 1e-3 && outcome.energy > 0.0, "{}: {outcome:?}", fault.name());
    }
}
