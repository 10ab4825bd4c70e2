//! Robustness in the loop: an axis, its drive and its machine, at random, with faults put in.
//!
//! The board is the firmware around one axis ([`stillbeam_board`]), its drive an ODrive model on
//! the reference rod behind motor, gear and friction ([`stillbeam_sim::plant`]). Frames go both
//! ways.

mod draw;
mod fault;
mod outcome;
pub mod page;
mod rest;
mod run;
pub mod table;

pub use fault::Fault;
pub use outcome::Outcome;
pub use run::{all, of, one};
