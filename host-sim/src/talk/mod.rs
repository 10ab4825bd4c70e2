//! A conversation with the firmware: in QEMU, in lock-step, or on a board behind a serial port.
//!
//! A [`Machine`] carries bytes, a [`Session`] requests and setpoints. The host runs every axis
//! beside it ([`Replica`]) and compares each setpoint and drive frame, bit for bit, as it comes.
//! [`Step`]s are the user's requests, [`page()`] draws the result, and [`record()`] brings a log
//! home that `identify` takes.

mod answer;
mod arm;
mod body;
mod comparison;
mod drive;
mod emulator;
mod excitation;
mod image;
mod log;
mod machine;
mod page;
mod recording;
mod replica;
mod script;
mod scripts;
mod session;
mod step;

pub use answer::Answer;
pub use emulator::Emulator;
pub use excitation::Excitation;
pub use image::default_image;
pub use machine::Machine;
pub use page::page;
pub use recording::{Recording, record};
pub use replica::Replica;
pub use script::{converse, endure};
pub use scripts::{DEMONSTRATION, FAULTS, FIRST, MACHINE, STILL};
pub use session::{Posted, Session};
pub use step::Step;
