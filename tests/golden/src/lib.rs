#![no_std]
#![forbid(unsafe_code)]
//! The runs that host and target make alike: every scene with every method, each named in one
//! place.
//!
//! A new method is an entry of `stillbeam-methods`, a new scene one of [`scenes`]; the golden
//! comparison, the instruction table, the proof of no panic and the footprint all take it from
//! there.

pub mod mechanisms;
pub mod motions;
pub mod paths;
pub mod record;
pub mod run;
pub mod scenes;

pub use run::{Case, run, run_few, run_own};
pub use scenes::Run;
pub use stillbeam_methods::{self as methods, Method, Visitor};
