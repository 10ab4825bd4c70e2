//! The elements' matrices, assembled, and the modes that follow from them.

mod assembly;
mod element;
mod lumped;
mod model;
mod modes;
mod varied;

pub use model::{EightElements, FourElements, Model, OneElement, TwoElements};
pub(crate) use modes::LowestModes;
pub use modes::Modes;
