//! One axis as the firmware runs it, with thousands of faults injected around it.
//!
//! [`Board`] is the firmware's command task and tick around the core's axis and the protocol's
//! frames, without a target. [`Fault`] is the kind of fault, [`mod@line`] applies it to the bytes
//! on their way, [`host`] makes a host's traffic. [`Watch`] judges every setpoint that a drive
//! would follow; its docs list the promises. [`campaign`] runs it all and [`table`] prints the
//! faults injected, their number, and the results.

mod board;
pub mod campaign;
mod drive;
pub mod host;
mod kind;
pub mod line;
pub mod machine;
mod outcome;
mod stops;
pub mod table;
mod watch;

pub use board::{Answer, Board, PERIOD};
pub use drive::Drive;
pub use kind::Fault;
pub use outcome::Outcome;
pub use watch::{Excess, Watch};
