//! The one return value of the functions.

use stillbeam::Error;

/// Result of a call. 0 is success. A call that returns anything else has changed nothing, but that
/// a path keeps the rows before a refused one, and that `SB_STATUS_SATURATED` has written its
/// bytes. Values are never reused; later versions may add some.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The call was carried out.
    Ok = 0,
    /// A pointer that must not be is NULL.
    Null = 1,
    /// The storage is smaller than the object.
    Size = 2,
    /// A pointer is not a multiple of the alignment of what it must point to.
    Alignment = 3,
    /// The caller was compiled against another version of the header.
    Abi = 4,
    /// The object is not initialised, or its initialisation has failed.
    NotInitialised = 5,
    /// The method is not in this archive.
    NotBuilt = 6,
    /// A number is infinite, NaN or outside its range.
    OutOfRange = 7,
    /// Exported constants are of another type, version or tick, or have changed.
    NotPrepared = 8,
    /// The move exceeds a limit of the policy.
    Limit = 9,
    /// The move turns or bends the arm by more than the method was set up for.
    TooFast = 10,
    /// No still move of that duration was found.
    NotStill = 11,
    /// The axis takes no such request in its mode.
    Mode = 12,
    /// The hub turns, and the request is for one at rest.
    Moving = 13,
    /// The queue has no room for the move.
    QueueFull = 14,
    /// The hub's motion has changed since the move was planned.
    Stale = 15,
    /// A row of a path came after the hub had begun to stop.
    Starved = 16,
    /// A value did not fit the drive's format. The bytes are written, with the nearest that fits.
    Saturated = 17,
    /// A setpoint is not finite, and was not encoded.
    NotFinite = 18,
    /// A refusal of a kind that this version has no number for.
    Refused = 19,
}

impl Status {
    /// Returns the status of an error of the core.
    pub(crate) fn of(error: &Error) -> Self {
        match error {
            Error::OutOfRange { .. } | Error::CannotCheck { .. } | Error::Buckles { .. } => {
                Self::OutOfRange
            }
            Error::NotPrepared { .. } => Self::NotPrepared,
            Error::LimitExceeded { .. } => Self::Limit,
            Error::TooFast { .. } | Error::BendsTooFar { .. } | Error::DeflectsTooFar { .. } => {
                Self::TooFast
            }
            Error::TooShort { .. } | Error::NotStill { .. } => Self::NotStill,
            Error::WrongMode { .. } => Self::Mode,
            Error::Moving | Error::NotAtRest { .. } => Self::Moving,
            Error::QueueFull { .. } => Self::QueueFull,
            Error::Stale | Error::Elsewhere { .. } => Self::Stale,
            Error::Starved => Self::Starved,
            _ => Self::Refused,
        }
    }

    /// Says in a line what was wrong, where no object tells more.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Null => "pointer = NULL: must point to what the header says",
            Self::Size => "bytes = too few: must be the sizeof of the object",
            Self::Alignment => "pointer = misaligned: must be a multiple of 8 for an object",
            Self::Abi => "abi = another: must be SB_ABI of the header that this archive came with",
            Self::NotInitialised => "object = not initialised: call its init function first",
            Self::NotBuilt => "method = not in this archive: build the archive with its feature",
            Self::OutOfRange => "value = out of range",
            Self::NotPrepared => "words = not of this arm: export it anew",
            Self::Limit => "limits = exceeded: use a longer move or raise the limit",
            Self::TooFast => "move = too fast: use a longer move",
            Self::NotStill => "move.duration = not possible: use another duration",
            Self::Mode => "mode = another: must be one that takes this request",
            Self::Moving => "hub = turning: must be at rest",
            Self::QueueFull => "queue = full: wait for a move to end",
            Self::Stale => "move = planned before the hub's motion changed: plan it again",
            Self::Starved => "waypoint.time = past: offer rows earlier",
            Self::Saturated => "setpoint = beyond the drive's format: sent as the nearest value",
            Self::NotFinite => "setpoint = not finite: must be, and is not encoded",
            Self::Refused => "request = refused",
        }
    }
}
