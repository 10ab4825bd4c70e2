//! Time-optimal motions are as short as Ruckig's, keep their limits and arrive.

use stillbeam_lab::shortest::draw::Kind;
use stillbeam_lab::shortest::run;

/// `cargo lab shortest` judges 10⁵ others.
#[test]
fn random_motions_are_as_short_as_ruckigs() {
    let summary = run(2, 0..6_000, &|_| ());
    assert_eq!(summary.faults, 0, "{:#?}", summary.first);
    for kind in Kind::ALL {
        let counts = &summary.counts[&kind];
        assert_eq!(counts.cases, 1_000, "{}", kind.name());
        // Neither is right where the two differ, so both directions count.
        assert!(counts.longer < 1e-8 && counts.shorter < 1e-8, "{}: {counts:?}", kind.name());
        // An end that neither takes is drawn only where the two limits differ.
        let most = if kind == Kind::Uneven { 100 } else { 0 };
        assert!(counts.refused + counts.peer_refused <= most, "{}: {counts:?}", kind.name());
    }
}
