#![no_std]
#![forbid(unsafe_code)]
//! What host and target run alike: every scene with every method, each named in one place.
//!
//! A new method is an entry of [`methods`], a new scene one of [`scenes`]; the golden comparison,
//! the instruction table, the proof of no panic and the footprint all take it from there.

pub mod methods;
pub mod record;
pub mod run;
pub mod scenes;

pub use methods::{Method, Visitor};
pub use run::{Case, run};
pub use scenes::Run;
