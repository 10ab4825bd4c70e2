//! The machine that the setpoints are for: motor, gear, friction, hub, and the arm that pushes
//! back.
//!
//! The arm is the reference rod ([`crate::reference::rod`]) on a hub that a torque drives. In the
//! hub's units, with the motor's angle `θ_M` over the gear ratio and `J_M = n² J_m`:
//!
//! ```text
//! hub:    τ_g = τ_F + τ(θ̈)                  torque of the mesh, friction, and the arm with its hub
//! motor:  J_M θ̈_M = n (τ_m + τ_c) − (1 + μ) τ_g      motor, cogging, and the gear's loss
//! mesh:   τ_g = k (θ_M − θ) + d (θ̇_M − θ̇) outside of the backlash, or θ_M = θ of a rigid gear
//! ```
//!
//! Friction is a bristle model, which has no jump and so no chatter ([`Friction`]). Energy is kept
//! account of: [`Plant::energy_error`] is what the balance of work, losses and stored energy is off
//! by.

mod bristle;
mod derivative;
mod encoder;
mod parts;
mod simulate;

pub use encoder::Encoder;
pub use parts::{Cogging, Friction, Gear, Motor, Parts};
pub use simulate::{Effort, Options, Plant, Shown};
