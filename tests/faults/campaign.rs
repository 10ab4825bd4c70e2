//! Every kind of fault, a hundred times.

use stillbeam_lab::faults::{Fault, campaign, table};

/// Runs of each kind.
const RUNS: u64 = 100;

#[test]
fn setpoints_stay_continuous_and_within_limits_whatever_happens() {
    let rows = campaign::all(8, RUNS, &|| ()).expect("a campaign");
    println!("{}", table::markdown(&rows));
    assert_eq!(rows.len(), Fault::ALL.len() + 1);
    for (name, outcome) in &rows {
        assert!(outcome.broken.is_empty(), "{name}: {:?}", outcome.broken);
        // Runs that inject nothing, or judge nothing, would hold as well.
        assert!(outcome.setpoints > 800 * outcome.runs.min(RUNS), "{name}: {outcome:?}");
        assert_eq!(outcome.injected == 0, *name == Fault::None.name(), "{name}");
        assert!(outcome.worst.change > 0.9, "{name}: {:?}", outcome.worst);
    }
    let of = |fault: Fault| &rows.iter().find(|(name, _)| *name == fault.name()).expect("a row").1;
    assert!(of(Fault::Garbled).dropped > 4 * RUNS);
    assert!(of(Fault::Cut).stops[1] > of(Fault::None).stops[1]);
    assert!(of(Fault::MissedTicks).stops[2] > RUNS * 2 / 5);
    assert!(of(Fault::Bursts).stops[2] > RUNS * 2 / 5);
    assert!(of(Fault::Overfull).refused["queue full"] > of(Fault::None).refused["queue full"]);
}
