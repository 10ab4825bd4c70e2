//! The commanded motion, and the generator that follows it.

mod exact;
mod generator;
mod loads;
mod peaks;
mod plan;
mod remedy;
mod shapers;
mod still;
