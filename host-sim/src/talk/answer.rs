//! Answers of the firmware.

use std::fmt;

use stillbeam_protocol::Status;

/// The firmware's answer to a request.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// The request was carried out before the tick of that number.
    Accepted(u32),
    /// The request was refused, for that reason.
    Refused(String),
    /// The request was refused for want of room in the move queue, in those words.
    Full(String),
    /// The status of the axis.
    Status(Status),
    /// A recording has begun, of a sensor's column of that name.
    Recording(String),
    /// A recording has ended.
    Recorded {
        /// Samples that were sent.
        samples: u32,
        /// Samples that the line was too slow for, or that found no hub angle.
        lost: u32,
    },
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Accepted(tick) => write!(f, "accepted before tick {tick}"),
            Self::Refused(why) | Self::Full(why) => write!(f, "refused: {why}"),
            Self::Status(status) => write!(
                f,
                "{:?}; a tick costs {} instructions, {} at worst; {} us late at most, {} missed, \
                 {} early, {} overruns, {} dropped, {} garbled; stack {} bytes",
                status.mode,
                status.cost,
                status.worst,
                status.late,
                status.missed,
                status.early,
                status.overruns,
                status.dropped,
                status.garbled,
                status.stack
            ),
            Self::Recording(column) => write!(f, "recording {column}"),
            Self::Recorded { samples, lost } => write!(f, "{samples} samples, {lost} lost"),
        }
    }
}
