#![forbid(unsafe_code)]
//! Code that the tests share: truth files and their scenes, building the firmware, running it in
//! QEMU, comparing its stream, the table of instructions.

pub mod browser;
pub mod cycles;
pub mod embedded;
pub mod emulator;
pub mod features;
pub mod firmware;
pub mod firmware_page;
pub mod image;
pub mod instructions;
pub mod page;
pub mod parts;
pub mod playground;
pub mod stream;
pub mod timing;
pub mod trace;

use std::path::PathBuf;

use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::scenes;
use stillbeam_sim::solver::{Mass, Scalar, Solver};
use stillbeam_sim::table::{self, Row};

pub use stillbeam_lab::reference::truth::NAMES as TRUTH_SCENES;

/// Returns the workspace's root folder.
pub fn root() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// Returns the path of a file of `tests/truth/`.
pub fn truth_path(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("truth").join(file)
}

/// Reads a scene and its truth.
///
/// # Panics
/// Panics if a committed file cannot be read.
pub fn truth(name: &str) -> (SceneFile, Vec<Row>) {
    let scene = scenes::open(name).expect("an embedded scene");
    let rows = table::read(&truth_path(&format!("{name}.csv"))).expect("committed truth");
    (scene, rows)
}

/// Returns Newmark with consistent mass.
pub fn newmark(elements: usize, tick: f64, scalar: Scalar) -> Solver {
    Solver { elements, mass: Mass::Consistent, tick, scalar, ..Solver::PAPER }
}

/// Asserts `|value − expected| ≤ tolerance`. The message gives all three.
///
/// # Panics
/// Panics if it does not hold.
#[track_caller]
pub fn assert_near(what: &str, value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{what}: {value} is not {expected} within {tolerance}"
    );
}
