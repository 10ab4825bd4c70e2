//! Requests that need a plan or a set-up, and are answered when it is there.

use stillbeam::motion::{Spline, Waypoint};
use stillbeam::{Payload, PlainMove};
use stillbeam_protocol::Command;

/// Work for the planner, below the tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Work {
    /// A move to plan.
    Move(PlainMove),
    /// A move to `to` rad after which the arm is at rest, in the shortest time if none is given.
    Still {
        /// Hub angle at the end, rad.
        to: f64,
        /// Duration, s.
        duration: Option<f64>,
    },
    /// A payload, for which the arm has to be set up anew.
    Payload(Payload),
    /// A path to begin.
    Path(Spline),
    /// A row of a path, and true of the last one.
    Row(Waypoint, bool),
}

impl Work {
    /// The work that a command asks for, none if it is carried out at once.
    pub fn of(command: &Command) -> Option<Self> {
        match *command {
            Command::Move(motion) => Some(Self::Move(motion)),
            Command::Still { to, duration } => Some(Self::Still { to, duration }),
            Command::Payload(payload) => Some(Self::Payload(payload)),
            Command::Path(spline) => Some(Self::Path(spline)),
            Command::Waypoint { row, last } => Some(Self::Row(row, last)),
            // Named one by one, so that a new command is looked at here.
            Command::Enable
            | Command::Disable
            | Command::Stop
            | Command::Home(_)
            | Command::Heartbeat
            | Command::Describe
            | Command::Status
            | Command::Clear
            | Command::Record(_)
            | Command::Change(_) => None,
        }
    }
}
