#![no_std]
//! Shared parts of the programs on the target: counters, stack paint, the way out. No arithmetic of
//! its own.

pub mod counter;
#[cfg(not(feature = "_no-host"))]
pub mod exit;
#[cfg(not(feature = "_no-host"))]
pub mod output;
pub mod stack;
pub mod stopwatch;
mod vectors;
