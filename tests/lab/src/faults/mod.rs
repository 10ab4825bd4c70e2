//! One axis as the firmware runs it, with thousands of faults injected around it.
//!
//! [`Fault`] is the kind of fault, [`mod@line`] applies it to the bytes on their way, [`host`]
//! makes a host's traffic. The board, its drive and the judge of every setpoint are those of
//! `stillbeam_board`. [`campaign`] runs it all and [`table`] prints the faults injected, their
//! number, and the results.

pub mod campaign;
pub mod host;
mod kind;
pub mod line;
mod outcome;
mod stops;
pub mod table;

pub use kind::Fault;
pub use outcome::Outcome;
