#![no_std]
#![forbid(unsafe_code)]
//! Wiring of an axis, in one place for everyone who runs one: the firmware in its tasks, the host
//! beside the firmware, and the campaign of faults.
//!
//! [`axes`] says what hangs on this machine, and is the file to edit for another one.
//! [`Configuration`] is one axis of it. [`Joint`] is an axis at work: arm, policy, gear and
//! encoder. [`Work`] tells the requests that need a plan from those that are carried out at once,
//! [`drive`] says what a drive is told at a tick, and [`watch`] what becomes of an axis whose drive
//! fails. [`PreparedArms`] are the arms that the build has set up. [`Rows`] are a path that comes
//! row by row. [`Recorder`] samples a [`Sensor`] beside the hub's angle; [`StandIn`] takes the
//! sensor's place where there is none. Nothing here owns a task, a clock or a device.

mod admit;
#[cfg_attr(feature = "_other-axes", path = "../../target/firmware/axes.rs")]
pub mod axes;
#[cfg(test)]
mod bench;
mod change;
mod configuration;
pub mod drive;
mod joint;
mod order;
mod prepared;
mod recorder;
mod rows;
mod sensor;
mod stand_in;
pub mod watch;
mod work;

pub use configuration::Configuration;
pub use joint::{FAR, HOME_RANGE, Joint};
pub use order::Order;
pub use prepared::{PreparedArm, PreparedArms};
pub use recorder::{Recorder, Recording};
pub use rows::Rows;
pub use sensor::Sensor;
pub use stand_in::{StandIn, Truth};
pub use work::Work;
