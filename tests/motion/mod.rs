//! Moves of the core, judged by the reference solvers.

mod loads;
mod shortest;
mod still;
