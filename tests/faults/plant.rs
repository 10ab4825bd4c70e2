//! Every kind of fault in the loop with drive and machine, a few times.

use stillbeam_lab::plant::{self, Fault, table};

#[test]
fn arms_come_to_rest_whatever_happens_in_the_loop() {
    let rows = plant::all(3, 3, &|| ()).expect("a campaign");
    println!("{}", table::markdown(&rows));
    assert_eq!(rows.len(), Fault::ALL.len());
    for ((name, outcome), fault) in rows.iter().zip(Fault::ALL) {
        assert!(outcome.broken.is_empty(), "{name}: {:?}", outcome.broken);
        // Runs that inject nothing, or judge nothing, would hold as well.
        assert!(outcome.setpoints > 20 * outcome.runs, "{name}: {outcome:?}");
        assert_eq!(outcome.injected, if fault == Fault::None { 0 } else { outcome.runs }, "{name}");
        assert_eq!(outcome.stops > 0, fault.cause().is_some(), "{name}: {outcome:?}");
        assert!(outcome.behind > 1e-3 && outcome.swing > 0.0, "{name}: {outcome:?}");
    }
}

/// A motor that saturates under a loop that the arm makes soft: the hub overshoots, and with an
/// integrator it sticks and breaks away by a twelfth of a radian long after.
#[test]
fn a_drive_does_not_hunt_on_friction() {
    let outcome = plant::one(Fault::Saturation, 1, 88).expect("a run");
    assert!(outcome.broken.is_empty() && outcome.turn < 1e-3, "{outcome:?}");
}
