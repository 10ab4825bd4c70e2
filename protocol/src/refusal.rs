//! Refusals of requests: the field, its value and what it must be, without text formatting on the
//! target.

use core::fmt;

use serde::{Deserialize, Serialize};
use stillbeam::Error;
use stillbeam::axis::Mode;

/// A refusal. Displays as one line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Refusal<'a> {
    /// A value outside of what is accepted.
    Range {
        /// The field, e.g. `move.duration`, or the limit, e.g. `limits.rate`.
        parameter: &'a str,
        /// Value that was given or is needed.
        value: f64,
        /// Least accepted.
        min: f64,
        /// Greatest accepted.
        max: f64,
        /// Unit of all three.
        unit: &'a str,
    },
    /// The move queue has not enough room.
    Queue {
        /// Segments that the move takes.
        needed: u32,
        /// Segments that are free.
        free: u32,
    },
    /// Not in this mode.
    Mode(Mode),
    /// The hub turns, or moves wait.
    NotAtRest,
    /// The axis has stopped while the move was planned.
    Stale,
    /// The drive has not said where the shaft is.
    NotMeasured,
    /// Too many moves and payloads are being planned.
    Busy,
    /// The firmware has no planner of still moves of this arm.
    NoPlanner,
    /// There are only so many axes.
    Axis(u8),
    /// No move is under way.
    NoMove,
    /// The firmware plans no paths.
    NoPaths,
    /// No path has been begun, or it is over.
    NoPath,
    /// The row came after the hub had begun to stop at the one before.
    Starved,
    /// The board reads no sensor of this axis.
    NoSensor,
    /// For a reason that this version of the protocol has no word for.
    Other,
    /// The drive reports a fault, with its own number for it.
    DriveFault(u32),
    /// The drive has said nothing of itself for too long.
    DriveSilent,
    /// The firmware sets no arm up, and none was prepared with this payload.
    NotPrepared {
        /// The payload's number that no prepared arm has: `payload.mass`, …
        parameter: &'a str,
        /// Value that was given.
        value: f64,
        /// Unit of the value.
        unit: &'a str,
        /// Payloads that were prepared, in words.
        prepared: &'a str,
    },
}

impl From<Error> for Refusal<'static> {
    fn from(error: Error) -> Self {
        let range =
            |parameter, value, min, max, unit| Self::Range { parameter, value, min, max, unit };
        match error {
            Error::OutOfRange { parameter, value, min, max, unit } => {
                range(parameter, value, min, max, unit)
            }
            Error::LimitExceeded { parameter, limit, needed, unit, .. } => {
                range(parameter, needed, 0.0, limit, unit)
            }
            // Said when an axis is set up, never to a request.
            Error::CannotCheck { parameter, value, unit } => {
                range(parameter, value, 0.0, 0.0, unit)
            }
            Error::TooFast { rate, max, .. } => range("move: peak rate", rate, 0.0, max, "rad/s"),
            Error::NotAtRest { rate } => range("move: rate at its start", rate, 0.0, 0.0, "rad/s"),
            Error::BendsTooFar { bend, max } => range("move: expected bend", bend, 0.0, max, "rad"),
            Error::Tolerance { parameter, tolerance, best } => {
                range(parameter, tolerance, best, f64::INFINITY, "")
            }
            Error::QueueFull { needed, free } => {
                Self::Queue { needed: needed as u32, free: free as u32 }
            }
            Error::TooShort { duration, shortest } => {
                range("move.duration", duration, shortest, f64::INFINITY, "s")
            }
            Error::NotStill { residual, .. } => {
                range("move: vibration left", residual, 0.0, 0.01, "of the length")
            }
            Error::DeflectsTooFar { deflection, most } => {
                range("move: deflection", deflection, 0.0, most, "m")
            }
            Error::Elsewhere { hub, begins } => range("hub angle", hub, begins, begins, "rad"),
            Error::Buckles { gravity } => {
                range("gravity.acceleration on this payload", gravity, 0.0, 0.0, "m/s^2")
            }
            Error::DegreesOfFreedom { given, needed } => {
                let needed = needed as f64;
                range("elements: degrees of freedom", given as f64, needed, needed, "")
            }
            Error::WrongMode { mode } => Self::Mode(mode),
            Error::Moving => Self::NotAtRest,
            Error::Stale => Self::Stale,
            Error::NoMove => Self::NoMove,
            Error::Starved => Self::Starved,
            // The core may learn of faults that this version of the protocol has no word for.
            _ => Self::Other,
        }
    }
}

impl fmt::Display for Refusal<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Range { parameter, value, min, max, unit } => {
                let space = if unit.is_empty() { "" } else { " " };
                let (value, min, max) = (Short(value), Short(min), Short(max));
                write!(f, "{parameter} = {value}{space}{unit}: must be ")?;
                if max.0 == f64::INFINITY {
                    write!(f, "at least {min}{space}{unit}")
                } else {
                    write!(f, "{min} to {max}{space}{unit}")
                }
            }
            Self::Queue { needed, free } => {
                let (needed, free) = (needed as usize, free as usize);
                write!(f, "{}", Error::QueueFull { needed, free })
            }
            Self::Mode(mode) => write!(f, "{}", Error::WrongMode { mode }),
            Self::NotAtRest => write!(f, "{}", Error::Moving),
            Self::Stale => write!(f, "move = planned before a stop: send it again"),
            Self::NoMove => write!(f, "{}", Error::NoMove),
            Self::NoPaths => {
                write!(f, "path = not planned: use a firmware with the feature `path`")
            }
            Self::NoPath => write!(f, "waypoint = without a path: begin a path first"),
            Self::Starved => write!(f, "{}", Error::Starved),
            Self::NotMeasured => {
                write!(f, "drive = silent: wait until it has reported an encoder angle")
            }
            Self::Busy => write!(f, "planner = busy: wait until it has answered"),
            Self::NoPlanner => {
                write!(f, "still = no planner: the firmware has none that takes this arm")
            }
            Self::Axis(axes) => write!(f, "axis: must be 0 to {}", axes.saturating_sub(1)),
            Self::NoSensor => {
                write!(f, "record = no sensor: use a board whose file reads one for this axis")
            }
            Self::Other => {
                write!(f, "request: refused for a reason that needs a newer program to name")
            }
            Self::DriveFault(code) => {
                write!(f, "drive.errors = {code:#x}: must be 0; disable the axis, then clear them")
            }
            Self::NotPrepared { parameter, value, unit, prepared } => write!(
                f,
                "{parameter} = {} {unit}: must be one that is prepared: {prepared}; or use a \
                 firmware with the feature `set-up`",
                Short(value)
            ),
            Self::DriveSilent => {
                write!(f, "drive = silent: its heartbeat must come; check power and bus")
            }
        }
    }
}

/// A number in the digits of an f32: enough for a reader, and what was typed stays as it was typed.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let short = self.0 as f32;
        if short.is_finite() && (short != 0.0 || self.0 == 0.0) {
            fmt::Display::fmt(&short, f)
        } else {
            fmt::Display::fmt(&self.0, f)
        }
    }
}
