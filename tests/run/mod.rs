//! Whole runs: against truth, against finer steps, against the law of energy, and on random arms.

mod auto;
mod auto_bits;
mod carriage;
mod carrier;
mod convergence;
mod energy;
mod exact;
mod limits;
mod links;
mod listed;
mod measured;
mod mechanisms;
mod methods;
mod motions;
mod residual;
mod scene_files;
mod shaped;
mod short;
mod shortest;
mod still;
mod truth;
