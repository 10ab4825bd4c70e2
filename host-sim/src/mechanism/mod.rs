//! Mechanisms: planar chains of rigid and flexible links on revolute joints, open or closed.
//!
//! The chain itself is the core's [`Mechanism`]. [`MechanismScene`] reads it from a file,
//! [`Drives`] holds the motions of its joints.

pub mod compare;
mod drives;
pub mod limits;
mod moves;
pub mod moving;
pub mod page;
pub mod picture;
pub mod plan;
pub mod run;
mod scene;
pub mod scenes;
mod solver;
pub mod table;

pub use drives::{Drives, JointDrive, Moving};
pub use scene::{MechanismScene, is_mechanism};
pub use solver::{MechanismKeys, MechanismSolver};
use stillbeam::mechanism::{Closing, Mechanism};

/// Returns the time at which the tip is pinned, s, or `None` if it stays free.
pub fn closes_at(mechanism: &Mechanism) -> Option<f64> {
    mechanism.closure.as_ref().map(|closure| match closure.begins {
        Closing::OnPin(_) => 0.0,
        Closing::At(time) => time,
    })
}

/// Returns the place of the pin, m, of a chain that is closed from the beginning.
pub fn first_pin(mechanism: &Mechanism) -> Option<[f64; 2]> {
    match mechanism.closure.as_ref()?.begins {
        Closing::OnPin(pin) => Some(pin),
        Closing::At(_) => None,
    }
}

/// True if no drive holds the joint: while the tip is free, or with `closed` while it is pinned.
pub fn is_passive(mechanism: &Mechanism, joint: usize, closed: bool) -> bool {
    if closed { mechanism.is_free_when_closed(joint) } else { !mechanism.is_driven(joint) }
}
