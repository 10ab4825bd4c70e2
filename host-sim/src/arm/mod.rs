//! Description of a scene's arm: masses, frequencies, damping, sag, what the tick resolves, and the
//! method that `auto` takes.

mod method;
pub mod natural;
mod report;

pub use method::{MethodReport, advise};
pub use report::{ArmReport, describe};
