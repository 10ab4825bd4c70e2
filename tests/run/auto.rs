//! What `auto` chooses: the bounded part of the campaign behind `docs/auto.md`, and the order of the
//! ladder.

use stillbeam::stepper::{Quality, Rung};
use stillbeam_sim::choice::{Summary, campaign};
use stillbeam_tests::root;

/// Another seed than the document's.
const SEED: u64 = 1;

const ARMS: u64 = 60;

#[test]
fn choices_keep_the_tolerance_and_are_cheap() {
    let verdicts = campaign(SEED, ARMS, &|| ()).expect("campaign");
    let summary = Summary::of(&verdicts);
    assert!(summary.choices() >= 30, "most arms get a stepper: {summary:?}");
    assert_eq!(summary.exceeded, 0, "{verdicts:#?}");
    assert!(summary.holds(), "{summary:?}");
    // A few dozen arms leave room for no more than one, and never for two rungs.
    assert_eq!(summary.needless, 0, "{summary:?}");
}

/// Instructions of the worst tick inside a cubic.
fn instructions(rows: &str, rung: Rung, skip: &str) -> Option<u32> {
    let (method, size, quality) = match rung {
        Rung::Rigid => ("rigid", 0, ""),
        Rung::Modal(modes) => ("modal", modes, ""),
        Rung::Elastica(modes, Quality::Fast) => ("elastica", modes, "fast"),
        Rung::Elastica(modes, Quality::Fine) => ("elastica", modes, "fine"),
    };
    let key = format!("{method},{size},{quality},{skip},");
    let row = rows.lines().find_map(|row| row.strip_prefix(&key))?;
    Some(row.split(',').nth(1)?.parse().expect("tick_max"))
}

/// Instructions, at least and at most. Three modes, fast, have no row of their own as long as the bench
/// does not count them: a fine tick is two of their steps at most, and more than one.
fn cost(rows: &str, rung: Rung, skip: &str) -> [u32; 2] {
    if let Some(counted) = instructions(rows, rung, skip) {
        return [counted; 2];
    }
    assert_eq!(rung, Rung::Elastica(3, Quality::Fast), "{rung}, {skip}: no row");
    let fine = instructions(rows, Rung::FINEST, skip).expect("row of the finest rung");
    [fine / 2, fine]
}

#[test]
fn the_ladder_is_in_the_order_of_measured_instructions() {
    let rows = std::fs::read_to_string(root().join("docs/instructions.csv")).expect("table");
    for skip in ["", "no-gravity", "no-damping", "no-damping no-gravity"] {
        for pair in Rung::LADDER.windows(2) {
            let [cheap, dear] = [pair[0], pair[1]].map(|rung| cost(&rows, rung, skip));
            assert!(
                cheap[1] <= dear[0],
                "{skip:?}: {} takes {cheap:?}, {} takes {dear:?} instructions",
                pair[0],
                pair[1]
            );
        }
    }
}

/// The test above can fail.
#[test]
fn a_rung_out_of_order_would_be_found() {
    let rows = "rigid,0,,,200,200,1\nmodal,1,,,150,160,1\n";
    assert_eq!(instructions(rows, Rung::Rigid, ""), Some(200));
    assert!(cost(rows, Rung::Rigid, "")[1] > cost(rows, Rung::Modal(1), "")[0]);
    assert_eq!(instructions(rows, Rung::Modal(1), "no-gravity"), None);
}
