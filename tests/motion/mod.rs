//! Moves of the core, judged by the reference solvers.

mod loads;
mod still;
