#![no_std]
//! What the programs on the target share: counter, stack paint, the way out. No arithmetic of its
//! own.

pub mod counter;
#[cfg(not(feature = "_no-host"))]
pub mod exit;
#[cfg(not(feature = "_no-host"))]
pub mod output;
pub mod stack;
mod vectors;
