#![forbid(unsafe_code)]
//! Helpers of the tests that cross crates: building the firmware, running it in QEMU, comparing
//! its stream, the instruction table.

pub mod emulator;
pub mod firmware;
pub mod image;
pub mod page;
pub mod stream;
pub mod table;

use std::path::PathBuf;

/// The workspace's root folder.
pub fn root() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}
