#![forbid(unsafe_code)]
//! The desktop side of stillbeam.

pub mod reference;
pub mod trajectory;
