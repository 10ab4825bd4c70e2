//! The two reference solvers, converging to each other: largest tip distance (fraction of L) and
//! torque difference (fraction of the peak, away from jumps) between the corotational elements and
//! the rod, over elements, steps and polynomials.

pub mod convergence;
pub mod truth;
