//! One axis as the firmware runs it, and everything that can go wrong around it, by the thousand.
//!
//! [`Board`] is the firmware's command task and tick around the core's axis and the protocol's
//! frames, without a target. [`Fault`] says what is injected, [`mod@line`] does it to the bytes on
//! their way, [`host`] says what a host sends. [`Watch`] judges every setpoint that a drive would
//! follow: what is promised, whatever happens, stands in its docs. [`campaign`] runs it all and
//! [`table`] prints what was injected, how often, and what came out.

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
