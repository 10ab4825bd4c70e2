//! Still moves on the desk: planned, judged by the reference rod, drawn, and held against other
//! motions.

pub mod comparison;
pub mod judge;
pub mod kept;
pub mod page;
pub mod picture;
pub mod request;

pub use judge::Judgement;
pub use request::{Planned, Request};
