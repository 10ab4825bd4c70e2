//! Every kind of fault in the loop with drive and machine, a few times.

use stillbeam_lab::plant::{self, Fault, table};

#[test]
fn arms_come_to_rest_whatever_happens_in_the_loop() {
    let rows = plant::all(8, 3, &|| ()).expect("a campaign");
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
