//! The reason why a call was refused, as its object keeps it.

use core::fmt;

use stillbeam::Error;
use stillbeam::drive::Saturated;
use stillbeam::motion::RowError;

use crate::Status;

/// Reason of a refusal.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fault {
    /// None so far.
    None,
    /// An error of the core.
    Core(Error),
    /// A row of a path.
    Row(RowError),
    /// An argument that is no pointer to what it must be: its name, and `Null`, `Alignment`,
    /// `NotInitialised`.
    Argument(&'static str, Status),
    /// Storage that is too small: the object's name, bytes that there are and that are needed.
    Size(&'static str, usize, usize),
    /// A structure of another version of the header: its name and that version.
    Abi(&'static str, u32),
    /// A method that is not in this archive, by what the constants or the set-up call it.
    NotBuilt(u32),
    /// The arm with another payload has another method.
    OtherMethod,
    /// A setpoint that is not finite.
    NotFinite,
    /// Values that the drive's format does not hold.
    Saturated(Saturated),
}

impl Fault {
    /// Returns the fault of a number outside its range.
    pub(crate) fn range(
        parameter: &'static str,
        value: f64,
        (min, max): (f64, f64),
        unit: &'static str,
    ) -> Self {
        Self::Core(Error::OutOfRange { parameter, value, min, max, unit })
    }

    /// Returns the value if it is within its range.
    pub(crate) fn check(
        parameter: &'static str,
        value: f64,
        (min, max): (f64, f64),
        unit: &'static str,
    ) -> Result<f64, Self> {
        if (min..=max).contains(&value) {
            Ok(value)
        } else {
            Err(Self::range(parameter, value, (min, max), unit))
        }
    }

    /// Returns the status that the call returns.
    pub(crate) fn status(&self) -> Status {
        match self {
            Self::None => Status::Ok,
            Self::Core(error) | Self::Row(RowError { error, .. }) => Status::of(error),
            Self::Argument(_, status) => *status,
            Self::Size(..) => Status::Size,
            Self::Abi(..) => Status::Abi,
            Self::NotBuilt(_) => Status::NotBuilt,
            Self::OtherMethod => Status::NotPrepared,
            Self::NotFinite => Status::NotFinite,
            Self::Saturated(_) => Status::Saturated,
        }
    }
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        Self::Core(error)
    }
}

impl From<RowError> for Fault {
    fn from(error: RowError) -> Self {
        Self::Row(error)
    }
}

/// One line: the field, its value, what it must be.
impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Core(error) => error.fmt(f),
            Self::Row(error) => error.fmt(f),
            Self::Argument(name, Status::Null) => write!(f, "{name} = NULL: must not be NULL"),
            Self::Argument(name, Status::Alignment) => {
                write!(f, "{name} = misaligned: must be aligned as its type")
            }
            Self::Argument(name, _) => {
                write!(f, "{name} = not initialised: call its init function first")
            }
            Self::Size(name, given, needed) => {
                write!(f, "{name}.bytes = {given}: must be at least {needed}")
            }
            Self::Abi(name, given) => write!(
                f,
                "{name}.abi = {given}: must be {}; compile with the header of this archive",
                crate::SB_ABI
            ),
            Self::NotBuilt(method) => write!(
                f,
                "method = {method:#010x}: must be one in this archive; build it with the method's \
                 feature"
            ),
            Self::OtherMethod => f.write_str(
                "payload.method = another: must be that of the arm; export both with one method",
            ),
            Self::Saturated(cut) => {
                let value = match cut {
                    Saturated { position: true, .. } => "position",
                    Saturated { velocity: true, .. } => "velocity",
                    _ => "torque",
                };
                write!(
                    f,
                    "drive.{value} = beyond its format: must fit; sent as the nearest value, use a \
                     slower move"
                )
            }
            Self::None | Self::NotFinite => f.write_str(self.status().words()),
        }
    }
}
