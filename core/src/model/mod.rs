//! The beam: cubic Bernoulli-Euler elements behind a rigid hub, assembled in the hub frame.
//!
//! Shapes live in types: [`Model`]`<N, W>` has `N` degrees of freedom and matrices `W − 1`
//! sub-diagonals wide. Everything here runs once, at set-up, in f64 or, where the model allows it,
//! in the precision of the scene.

mod fem;
pub(crate) mod rod;

pub(crate) use fem::LowestModes;
pub use fem::{EightElements, FourElements, Model, Modes, OneElement, TwoElements};
pub(crate) use rod::{Expansion, LINK_STATIONS, Load, POINTS, RodPoints};
pub use rod::{Kinetics, Rod};
