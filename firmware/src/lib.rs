#![no_std]
//! What the programs on the target share: counter, stack paint, the way out. No arithmetic of its
//! own.

pub mod counter;
#[cfg(not(feature = "nucleo-g474re"))]
pub mod exit;
#[cfg(not(feature = "nucleo-g474re"))]
pub mod output;
pub mod stack;
mod vectors;
