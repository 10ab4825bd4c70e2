//! Paths of any length on an axis.

use super::Axis;
use crate::Error;
use crate::motion::{Path, PathPiece, RowError, Spline};
use crate::stepper::Stepper;

impl<S: Stepper, const QUEUE: usize> Axis<S, QUEUE> {
    /// A path from the end of the moves on, within the policy's limits. Rows are
    /// [offered](Path::offer) to it and taken by [`Axis::advance`].
    ///
    /// # Errors
    /// [`Error::WrongMode`] if the axis is not enabled.
    pub fn path(&self, spline: Spline) -> Result<Path, Error> {
        self.supervisor.check_enabled()?;
        self.generator.path(spline)
    }

    /// Takes the rows of a path that were offered, as many as there is room for; true if that was
    /// the last. See [`Generator::feed`](crate::Generator::feed): behind the last row taken there
    /// is always a stop along the path, so that nothing happens to an axis whose rows stay away but
    /// that it stops there and holds.
    ///
    /// # Errors
    /// As there; and of the axis' mode, as a row's error, if it is not enabled.
    pub fn advance(&mut self, path: &mut Path) -> Result<bool, RowError> {
        self.supervisor.check_enabled().map_err(|error| path.row_error(error))?;
        self.generator.advance(path)
    }

    /// Takes a piece of a path that [`Path::next_piece`] has planned; false if there is no room for
    /// it yet. See [`Generator::take_piece`](crate::Generator::take_piece): [`Self::advance`] in
    /// two, so that nothing is planned while the tick waits.
    ///
    /// # Errors
    /// As there; and of the axis' mode, as a row's error, if it is not enabled.
    pub fn take_piece(&mut self, path: &mut Path, piece: &PathPiece) -> Result<bool, RowError> {
        self.supervisor.check_enabled().map_err(|error| path.row_error(error))?;
        self.generator.take_piece(path, piece)
    }
}
