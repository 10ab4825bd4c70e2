//! Description of a scene's arm: masses, frequencies, damping, sag, what the tick resolves, and the
//! method that `auto` takes.

mod method;
pub mod natural;
mod report;

pub use method::{Advice, MethodReport, advise, advise_with};
pub use report::{ArmReport, describe};
