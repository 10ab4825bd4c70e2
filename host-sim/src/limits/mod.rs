//! Limits on the commanded motion: behind the shaper, between the ticks as well as on them.
//!
//! [`Case`] is a commanded motion, and [`Window`]s say which of its moves is under way. Rate,
//! acceleration and jerk are those of the whole trajectory ([`kinematic`]). Torque and clamp moment
//! are those of the reference rod along the motion ([`load`]). The motor feels them whatever method
//! makes the setpoints. A [`Refusal`] names the move, the limit, what the move needs, and a remedy
//! ([`remedy`]). [`shortest`] gives a move the shortest duration that keeps them all.

mod case;
pub mod kinematic;
pub mod load;
mod quantity;
mod refusal;
pub mod remedy;
mod shortest;
mod weight;

pub use case::{Case, Window};
pub use quantity::Quantity;
pub use refusal::{Excess, Refusal, Way};
pub use shortest::{refusal, shortest};
pub use weight::holding;

/// A greatest magnitude and the time at which it occurs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    /// Magnitude, in the unit of the quantity.
    pub value: f64,
    /// Time from the beginning of the run, s.
    pub at: f64,
}

impl Peak {
    /// Takes a magnitude over if it is greater by more than rounding. Of equal ones the earliest
    /// stays. A value that is not a number counts as infinite.
    pub fn raise(&mut self, value: f64, at: f64) {
        let value = if value.is_nan() { f64::INFINITY } else { value.abs() };
        if value > self.value * (1.0 + 1e-12) {
            *self = Self { value, at };
        }
    }
}
