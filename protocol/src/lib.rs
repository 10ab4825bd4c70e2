#![no_std]
#![forbid(unsafe_code)]
//! Messages between a host and the firmware over a serial line.
//!
//! A [`Request`] or a [`Report`] in [postcard](https://postcard.jamesmunns.com/wire-format), its
//! CRC-32 behind it, both COBS-encoded, a zero byte at the end: [`frame`]. A frame has at most
//! [`frame::MAX`] bytes; what is garbled is dropped whole and decoding never panics.
//!
//! The firmware answers every request with one report that carries the request's sequence number.
//! Moves, rows of paths and payloads are answered once they are planned, in the order in which they
//! came; every other request is at once, even while a move is being planned. In between the
//! firmware sends, for every tick and axis, the setpoint ([`Report::Tick`]), and of an axis that is
//! recorded a [`Report::Sample`].
//!
//! [`slcan`] is the text form of CAN frames, for a bus that is captured.

mod change;
pub mod frame;
mod message;
mod refusal;
pub mod slcan;

pub use change::Change;
pub use message::{Command, Description, Report, Request, Sample, Status};
pub use refusal::Refusal;
