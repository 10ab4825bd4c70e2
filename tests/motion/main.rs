//! The commanded motion, and the generator that follows it.

mod generator;
mod plan;
mod shapers;
mod still;
