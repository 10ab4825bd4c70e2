//! The numbers that the page hands over.

use stillbeam::Error;
use stillbeam::material::{MATERIALS, Material};
use stillbeam::motion::ShaperKind;

/// Number of numbers.
pub const LENGTH: usize = 10;

/// An arm and a move as the page describes them, in SI units.
#[derive(Clone, Copy, Debug)]
pub struct Input {
    /// Length of the link, m.
    pub length: f64,
    /// Width of the strip, m.
    pub width: f64,
    /// Thickness of the strip in the plane of motion, m.
    pub thickness: f64,
    /// Index in [`MATERIALS`].
    material: f64,
    /// Payload at the tip, kg.
    pub payload: f64,
    /// Damping ratio of the first mode, from the link itself.
    pub damping: f64,
    /// Hub angle where the move ends, rad; it begins at 0.
    pub to: f64,
    /// Duration of the move, s.
    pub duration: f64,
    /// Index in [`ShaperKind::ALL`].
    shaper: f64,
    /// Fraction to which the arm's frequencies are known, for the still move; 0 takes the arm as it
    /// is.
    pub robust: f64,
}

impl Input {
    /// Reads the numbers, in the order of the fields.
    pub fn of(numbers: &[f64; LENGTH]) -> Self {
        let [length, width, thickness, material, payload, damping, to, duration, shaper, robust] =
            *numbers;
        Self { length, width, thickness, material, payload, damping, to, duration, shaper, robust }
    }

    /// Returns the link's material.
    pub fn material(&self) -> Result<&'static Material, Error> {
        pick(&MATERIALS, self.material, "link.material")
    }

    /// Returns the kind of the shaper.
    pub fn shaper(&self) -> Result<ShaperKind, Error> {
        pick(&ShaperKind::ALL, self.shaper, "shaper.kind").copied()
    }
}

fn pick<'a, T>(list: &'a [T], index: f64, parameter: &'static str) -> Result<&'a T, Error> {
    let most = (list.len() - 1) as f64;
    let error = Error::OutOfRange { parameter, value: index, min: 0.0, max: most, unit: "" };
    if !(0.0..=most).contains(&index) {
        return Err(error);
    }
    list.get(index as usize).ok_or(error)
}
