#![forbid(unsafe_code)]
//! One axis as the firmware runs it, on the desktop, for what injects faults around it.
//!
//! [`Board`] is the firmware's command task and tick around the core's axis and the protocol's
//! frames, without a target. [`Drive`] is the drive at the other end of its bus. [`Watch`] judges
//! every setpoint that a drive would follow; its docs list the promises. The lab's campaign injects
//! faults at random, the fuzz target `axis` whatever libFuzzer makes up.

mod board;
mod drive;
mod edges;
pub mod machine;
mod watch;

pub use board::{Answer, Board, PERIOD, Step};
pub use drive::Drive;
pub use edges::EDGES;
pub use watch::{Excess, Watch};
