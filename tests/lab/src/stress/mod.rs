//! Stress tests of the core: random scenes far outside of what an arm is, by the million, and runs
//! as long as a machine's life.
//!
//! [`draw`] makes a scene from a number, [`trial`] runs a method on it in both precisions,
//! [`campaign`] does so by the million and [`summary`] counts. [`energy`] lets undamped arms ring
//! on for a million ticks, [`long`] moves an arm to and fro for days.

pub mod campaign;
pub mod document;
pub mod draw;
pub mod energy;
pub mod growth;
pub mod long;
pub mod measured;
pub mod mounted;
pub mod rows;
pub mod spread;
pub mod summary;
pub mod trial;
