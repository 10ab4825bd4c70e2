//! Promises to every input, whatever it is: no panic, nothing that is not finite, no
//! reading that its own writing contradicts. A body takes bytes and panics where a promise is
//! broken.
//!
//! The fuzz targets (`targets`) call them with what libFuzzer makes up, and the test of this
//! crate with the inputs that are kept (`corpus`), on the stable toolchain.

mod axis;
mod drives;
mod frames;
mod scene;
mod values;

pub use axis::axis;
pub use drives::{cia402, moteus, odrive};
pub use frames::frames;
pub use scene::scene;

/// A body.
pub type Body = fn(&[u8]);

/// Every body by the name of its target.
pub const BODIES: [(&str, Body); 6] = [
    ("scene", scene),
    ("frames", frames),
    ("axis", axis),
    ("odrive", odrive),
    ("cia402", cia402),
    ("moteus", moteus),
];
