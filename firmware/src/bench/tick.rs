//! The call that is counted.

use stillbeam::{Generator, Setpoint, Stepper};

/// The call as firmware makes it, with the setpoint written to memory.
#[inline(never)]
pub fn tick<S: Stepper<Scalar = f32>>(arm: &mut Generator<S, 16>) -> Setpoint<f32> {
    arm.tick()
}
