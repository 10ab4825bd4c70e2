//! Steps of a conversation with the firmware, one for each group of words.

mod words;

use stillbeam_protocol::Command;

use super::Session;
use crate::error::Error;

/// One step of a conversation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A request to an axis.
    Ask(u8, Command),
    /// Goes on for a time, s.
    Wait(f64),
    /// Goes on for a time, s, without a word to the firmware.
    Silence(f64),
    /// Keeps the firmware from its tick for a time, s.
    Stall(f64),
    /// Goes on until every axis rests.
    Rest,
    /// Lets the encoder of an axis jump, turns of the motor.
    Jump(u8, f64),
    /// Lets the drive of an axis switch itself off with an error.
    Fail(u8),
    /// Cuts the line between the bus and the drive of an axis; with false, mends it.
    Cut(u8, bool),
}

impl Step {
    /// Takes the step and returns its result in words.
    ///
    /// # Errors
    /// An error is returned if the firmware is gone or does otherwise than the host. A refusal is
    /// no error.
    pub fn take(&self, session: &mut Session) -> Result<String, Error> {
        match *self {
            Self::Ask(axis, Command::Waypoint { row, last }) => {
                session.offer(axis, row, last).map(|answer| answer.to_string())
            }
            Self::Ask(axis, command) => session.ask(axis, command).map(|answer| answer.to_string()),
            Self::Wait(seconds) => {
                session.wait(ticks(seconds, session)?)?;
                Ok(String::new())
            }
            Self::Silence(seconds) => {
                session.keep_silent(ticks(seconds, session)?)?;
                Ok(modes(session))
            }
            Self::Stall(seconds) => {
                session.stall(seconds)?;
                Ok(modes(session))
            }
            Self::Rest => {
                session.rest()?;
                Ok(modes(session))
            }
            Self::Jump(axis, turns) => {
                session.jump(axis, turns)?;
                Ok(String::new())
            }
            Self::Fail(axis) => {
                session.fail(axis)?;
                Ok(String::new())
            }
            Self::Cut(axis, cut) => {
                session.cut(axis, cut)?;
                Ok(String::new())
            }
        }
    }
}

fn ticks(seconds: f64, session: &Session) -> Result<u32, Error> {
    if (0.0..=3600.0).contains(&seconds) {
        Ok((seconds / session.tick()).round() as u32)
    } else {
        Err(Error::new(format_args!("wait = {seconds} s: must be 0 to 3600 s")))
    }
}

fn modes(session: &Session) -> String {
    let modes = (0..session.axes()).filter_map(|axis| {
        let replica = session.replica(axis)?;
        let angle = session.history(axis).last()?.setpoint.angle.radians();
        let mode = format!("{:?}", replica.mode()).to_lowercase();
        Some(format!("axis {axis} {mode} at {angle:.4} rad"))
    });
    modes.collect::<Vec<_>>().join(", ")
}
