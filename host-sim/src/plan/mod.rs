//! Still moves on the desktop: planned, judged by the reference rod, drawn, and compared with other
//! motions.

pub mod asked;
mod check;
pub mod comparison;
pub mod judge;
pub mod kept;
pub mod moving;
pub mod options;
pub mod page;
pub mod picture;
mod piecewise;
pub mod request;
pub mod shortest;

pub use judge::Judgement;
pub use options::Options;
pub use request::{Planned, Request};
