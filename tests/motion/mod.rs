//! Moves of the core, judged by the reference solvers.

mod fastest;
mod loads;
mod shortest;
mod still;
