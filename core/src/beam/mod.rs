//! The beam: cubic Bernoulli-Euler elements behind a rigid hub, assembled in the hub frame.
//!
//! Shapes live in types: [`Model`]`<N, W>` has `N` degrees of freedom and matrices `W − 1`
//! sub-diagonals wide. Everything here runs once, at set-up, in f64 or, where the model allows it, in
//! the precision of the scene.

mod assembly;
mod chain;
mod element;
mod expansion;
mod lumped;
mod model;
mod modes;
pub(crate) mod monomials;
mod rod;

pub(crate) use chain::{Chain, Load};
pub(crate) use expansion::Expansion;
pub use model::{EightElements, FourElements, Model, OneElement, TwoElements};
pub use modes::Modes;
pub(crate) use rod::POINTS;
pub use rod::{Kinetics, Rod};
