//! What `auto` chooses: the bounded part of the campaign behind `docs/auto.md`, and the order of the
//! ladder.

use stillbeam::stepper::{Quality, Rung};
use stillbeam::{Damping, Link, Scene};
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

/// The same; three modes, fast, have no row of their own as long as the bench does not count them: the
/// part of a fine tick that two modes' is.
fn cost(rows: &str, rung: Rung, skip: &str) -> u32 {
    let counted = |rung| instructions(rows, rung, skip);
    counted(rung).unwrap_or_else(|| {
        assert_eq!(rung, Rung::Elastica(3, Quality::Fast), "{rung}, {skip}: no row");
        let row = |modes, quality| counted(Rung::Elastica(modes, quality)).expect("row");
        row(3, Quality::Fine) * row(2, Quality::Fast) / row(2, Quality::Fine)
    })
}

#[test]
fn the_ladder_is_in_the_order_of_measured_instructions() {
    let rows = std::fs::read_to_string(root().join("docs/instructions.csv")).expect("table");
    let plain = Scene::new(Link { length: 0.4, mass: 0.02, bending_stiffness: 0.5 });
    let gravity = Scene { gravity: 9.81, ..plain };
    let damped = |scene: Scene| Scene { damping: Damping { alpha: 0.1, beta: 0.0 }, ..scene };
    for (scene, skip) in [
        (damped(gravity), ""),
        (damped(plain), "no-gravity"),
        (gravity, "no-damping"),
        (plain, "no-damping no-gravity"),
    ] {
        for pair in Rung::ladder(&scene).windows(2) {
            let [cheap, dear] = [pair[0], pair[1]].map(|rung| cost(&rows, rung, skip));
            assert!(
                cheap <= dear,
                "{skip:?}: {} takes {cheap}, {} takes {dear} instructions",
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
    assert!(cost(rows, Rung::Rigid, "") > cost(rows, Rung::Modal(1), ""));
    assert_eq!(instructions(rows, Rung::Modal(1), "no-gravity"), None);
}
