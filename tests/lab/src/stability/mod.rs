//! Maps of where the methods are stable and where they are accurate.
//!
//! [`probe`] runs a method on an arm of a given first frequency and judges it, [`map`] does so over
//! ticks, frequencies and rates of turning. [`rule`] has Newmark's rule with any δ and β, of which
//! the core's is one. [`condition`] shows the rounding errors of its effective matrix. [`document`]
//! and [`page`] show all of it.

pub mod condition;
pub mod document;
pub mod map;
pub mod page;
pub mod probe;
pub mod rule;
