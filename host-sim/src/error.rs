//! Errors of the command line, in one line each.

use std::fmt;
use std::path::Path;

use stillbeam::AxisKind;

use crate::axis_units;

/// A request that cannot be carried out.
///
/// Displays as one line that names the field or file, its value and what it must be. The command
/// line exits with [`Error::EXIT_CODE`] and has written nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Error(String);

impl Error {
    /// Exit code for bad input.
    pub const EXIT_CODE: u8 = 2;

    /// Creates an error with that text. Line breaks become spaces.
    pub fn new(text: impl fmt::Display) -> Self {
        Self(text.to_string().split_whitespace().collect::<Vec<_>>().join(" "))
    }

    /// Adds the `place` where the error was found: a file, or a move of the queue.
    pub fn within(self, place: impl fmt::Display) -> Self {
        Self::new(format_args!("{place}: {self}"))
    }

    /// Returns the error in the units of an axis: on a linear one in metres and newtons.
    pub fn on(self, axis: AxisKind) -> Self {
        Self(axis_units::worded(axis, &self.0).into_owned())
    }

    /// Creates the error of a file that cannot be read or written.
    pub fn file(path: &Path, cause: impl fmt::Display) -> Self {
        Self::new(format_args!("{}: {cause}", path.display()))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Error {}

impl From<stillbeam::Error> for Error {
    fn from(error: stillbeam::Error) -> Self {
        Self::new(error)
    }
}

impl From<crate::reference::ReferenceError> for Error {
    fn from(error: crate::reference::ReferenceError) -> Self {
        Self::new(error)
    }
}
