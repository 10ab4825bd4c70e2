//! Host and target give the same bits: every field of every setpoint of every scene with every
//! method.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::OnceLock;

use stillbeam_golden::motions::{MOTIONS, WAYPOINTS};
use stillbeam_golden::record::{BYTES, FIELDS};
use stillbeam_golden::run::STILL_SCENES;
use stillbeam_golden::scenes::SCENES;
use stillbeam_tests::emulator::{self, Board, Clock, LIMIT};
use stillbeam_tests::stream::{self, Mismatch};
use stillbeam_tests::{embedded, firmware, root};

fn target() -> &'static [u8] {
    static STREAM: OnceLock<Vec<u8>> = OnceLock::new();
    STREAM.get_or_init(|| {
        let image = firmware::build("golden").unwrap_or_else(|error| panic!("{error}"));
        emulator::run(&image, Clock::Host, LIMIT).unwrap_or_else(|error| panic!("{error}"))
    })
}

/// The constants that the target runs are the scene files, to the bit.
#[test]
fn the_embedded_scenes_are_those_of_the_scene_files() {
    let written = std::fs::read_to_string(root().join(embedded::PATH)).expect(embedded::PATH);
    let expected = embedded::constants().unwrap_or_else(|error| panic!("{error}"));
    let differing = expected.lines().zip(written.lines()).find(|(is, was)| is != was);
    assert!(
        written == expected,
        "{}: {differing:?}\nwrite it anew: cargo run -p stillbeam-tests --bin scenes",
        embedded::PATH
    );
}

#[test]
fn every_bit_of_every_setpoint_agrees() {
    let agreement = stream::compare(target(), stream::every_method)
        .unwrap_or_else(|mismatch| panic!("{mismatch}"));
    println!("{agreement:?}");
    assert!(agreement.setpoints > 50_000, "{agreement:?}");
}

/// Without floating-point unit the same bits are computed in software. Here and on the next two
/// one method of each way to step runs: software adds and multiplies alike in all of them.
#[test]
#[ignore = "half a minute of what Armv6-M shows in every run: `cargo test --test target -- --ignored`"]
fn a_cortex_m3_gives_the_same_bits() {
    every_bit_agrees(Board::An385, firmware::build_soft("golden"));
}

/// Cortex-M0 and M0+ too: the emulated Cortex-M3 executes their instructions, those of Armv6-M.
#[test]
fn the_smallest_processors_give_the_same_bits() {
    every_bit_agrees(Board::An385, firmware::build_smallest("golden"));
}

/// Another architecture, whose soft floats are other code.
#[test]
fn a_riscv_core_gives_the_same_bits() {
    every_bit_agrees(Board::RiscV, firmware::build_riscv("golden"));
}

fn every_bit_agrees(board: Board, image: Result<PathBuf, String>) {
    let image = image.unwrap_or_else(|error| panic!("{error}"));
    let stream = emulator::run_on(board, &image, Clock::Host, LIMIT);
    let stream = stream.unwrap_or_else(|error| panic!("{error}"));
    let agreement = stream::compare(&stream, stream::few_methods)
        .unwrap_or_else(|mismatch| panic!("{mismatch}"));
    assert!(agreement.setpoints > 20_000, "{agreement:?}");
}

/// A rotary inertia of the payload asks for another lumped type; whichever it is, each scene runs
/// once with each method of the tables, and the scenes with still moves once more with those. One
/// lumped element goes limp at the rate of `spin-up`, and is refused.
#[test]
fn every_scene_runs_with_every_method() {
    let mut methods = BTreeSet::new();
    let mut cases = BTreeSet::new();
    let mut planned = BTreeSet::new();
    let mut motions = [0; MOTIONS.len()];
    let count = stream::every_method(&mut |case, tick, _| {
        if let Some(motion) = MOTIONS.iter().position(|name| *name == case.method) {
            motions[motion] = tick + 1;
            return;
        }
        if case.method == "still" {
            planned.insert(case.scene);
            return;
        }
        let method = (case.method, case.size, case.quality, case.skip);
        methods.insert(method);
        cases.insert((case.scene, method));
    })
    .unwrap();
    assert_eq!(methods.len(), 23);
    let refused: Vec<_> = SCENES
        .iter()
        .flat_map(|run| methods.iter().map(|method| (run.name, *method)))
        .filter(|pair| !cases.contains(pair))
        .collect();
    assert_eq!(refused, [("spin-up", ("newmark", 1, "lumped", ""))]);
    let tried = (cases.len() + refused.len() + STILL_SCENES.len() + MOTIONS.len()) as u32;
    assert_eq!(tried, count);
    assert_eq!(planned, BTreeSet::from(STILL_SCENES));
    // Two and a half ticks a waypoint, and the one that begins.
    assert_eq!(motions, [WAYPOINTS / 2 * 5 + 1, 300, 300]);
}

/// The comparison can fail: one bit anywhere is found and named.
#[test]
fn one_flipped_bit_is_found() {
    let whole = target();
    let records = whole.len() / BYTES;
    for (record, field, bit) in
        [(0, 0, 0), (17, 1, 31), (4_000, 4, 0), (records / 2, 6, 12), (records - 1, 7, 22)]
    {
        let mut stream = whole.to_vec();
        let byte = record * BYTES + 4 + 4 * field + bit / 8;
        stream[byte] ^= 1 << (bit % 8);
        match stream::compare(&stream, stream::every_method) {
            Err(mismatch @ Mismatch::Field { field: found, host, target, .. }) => {
                assert_eq!(found, FIELDS[field]);
                assert_eq!(host ^ target, 1 << bit);
                println!("{mismatch}");
            }
            other => panic!("bit {bit} of {} flipped: {other:?}", FIELDS[field]),
        }
    }
}

#[test]
fn a_missing_setpoint_is_found() {
    let whole = target();
    let short = &whole[..whole.len() - BYTES];
    assert!(matches!(stream::compare(short, stream::every_method), Err(Mismatch::Length { .. })));
    let shifted = &whole[BYTES..];
    assert!(matches!(
        stream::compare(shifted, stream::every_method),
        Err(Mismatch::OutOfStep { tick: 0, .. })
    ));
}
