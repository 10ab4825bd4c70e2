#![forbid(unsafe_code)]
//! The desktop side of stillbeam.

pub mod trajectory;
