#![no_std]
#![forbid(unsafe_code)]
//! The arithmetic of a tick, as one function of the machine's own stepper.
//!
//! A generic function is compiled in the crate that names its types, at that crate's optimisation.
//! Here the types are named, and [`advance`] is generic in nothing: a profile that compiles a
//! firmware for size compiles this crate alone for speed, and a tick costs what it costs at
//! `opt-level = 3`. What is large and runs rarely, as a stop, is not called from here.

use stillbeam::{Generator, Setpoint};
use stillbeam_wiring::axes::{QUEUE, Stepper};

/// Advances an arm by one tick, as [`Generator::tick`] does.
#[inline(never)]
pub fn advance(arm: &mut Generator<Stepper, QUEUE>) -> Setpoint<f32> {
    arm.tick()
}
