//! Waypoints of any number, made into segments one row at a time.

mod next;
mod slopes;
mod survey;
mod waypoint;

use heapless::Deque;
pub use next::PathPiece;
pub use waypoint::{RowError, Spline, Waypoint};

use super::joiner::Joiner;
use super::{Limits, Peaks};
use crate::Error;
use crate::error::MAX_TICKS;
use crate::hub::{HubState, MAX_ANGLE};

/// Rows that a path looks ahead for the rates of rows without one.
pub const WINDOW: usize = 12;

/// Least time between two rows, ticks.
const CLOSEST: f64 = 1e-3;

/// A path through waypoints, from the hub's state at its beginning.
///
/// Rows come one at a time and leave as one segment each, so that a path of any length takes the
/// memory of [`WINDOW`] rows. Rates that are not given are those of the cubic spline with a
/// continuous acceleration. Between the rows the limits are checked on the polynomial itself.
///
/// [`Generator::feed`](crate::Generator::feed) takes a path's segments as its queue has room.
#[derive(Clone, Debug)]
#[must_use]
pub struct Path {
    spline: Spline,
    limits: Limits,
    tick: f64,
    start: HubState<f64>,
    joiner: Joiner,
    rows: Deque<Waypoint, WINDOW>,
    /// Time of the row that was offered last, s.
    time: f64,
    /// Number of the first row that waits.
    row: u32,
    /// No row follows those that wait.
    closed: bool,
    /// Greatest magnitudes so far.
    peaks: Peaks,
    /// Link to the generator that has taken rows of it.
    pub(crate) stream: Stream,
}

/// A path's trace in a generator.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Stream {
    /// State of the generator's queue when it took the last row; none before the first one.
    pub revision: Option<u32>,
    /// True if a stop lies behind the row that was taken last.
    pub stops: bool,
}

impl Path {
    /// A path from `start`, with setpoints every `tick` s. Its time 0 is the tick of `start`.
    ///
    /// # Errors
    /// Limits of torque or moment, which a path of the hub cannot check.
    pub fn new(
        spline: Spline,
        start: HubState<f64>,
        limits: &Limits,
        tick: f64,
    ) -> Result<Self, Error> {
        Ok(Self {
            spline,
            limits: limits.validate()?.of_motion()?,
            tick,
            start,
            joiner: Joiner::new(start, tick),
            rows: Deque::new(),
            time: 0.0,
            row: 0,
            closed: false,
            peaks: Peaks { rate: start.rate.abs(), acceleration: 0.0, jerk: 0.0 },
            stream: Stream::default(),
        })
    }

    /// Returns the path with an acceleration of its own at its beginning, rad/s², in place of the
    /// hub's: a quintic path only. Where the two differ the acceleration jumps, and a limit of jerk
    /// refuses the first row. Rows that are taken already stay as they are.
    ///
    /// # Errors
    /// An acceleration that is out of range, or one for a cubic spline, which has its own.
    pub fn beginning_with(mut self, acceleration: f64) -> Result<Self, Error> {
        let acceleration = self.check_acceleration(acceleration)?;
        if self.joiner.ticks() == 0 {
            self.joiner = Joiner::new(HubState { acceleration, ..self.start }, self.tick);
        }
        Ok(self)
    }

    /// True if another row can be offered.
    pub fn has_room(&self) -> bool {
        !self.closed && !self.rows.is_full()
    }

    /// Puts a row behind the others.
    ///
    /// # Errors
    /// A time that is not after the row before, a number out of range, an acceleration for a cubic
    /// spline, [`Error::QueueFull`] if there is no room. Nothing has changed then. The limits are
    /// checked when the row is taken up.
    pub fn offer(&mut self, row: Waypoint) -> Result<(), RowError> {
        let number = self.row + self.rows.len() as u32;
        self.check(&row).map_err(|error| RowError { row: number, error })?;
        let full = RowError { row: number, error: Error::QueueFull { needed: 1, free: 0 } };
        if !self.has_room() {
            return Err(full);
        }
        self.rows.push_back(row).map_err(|_| full)?;
        self.time = row.time;
        Ok(())
    }

    fn check(&self, row: &Waypoint) -> Result<(), Error> {
        let (least, most) = (CLOSEST * self.tick, f64::from(MAX_TICKS) * self.tick);
        Error::check("waypoint.time", row.time, self.time + least, self.time + most, "s")?;
        Error::check("waypoint.angle", row.angle, -MAX_ANGLE, MAX_ANGLE, "rad")?;
        if let Some(rate) = row.rate {
            Error::check("waypoint.rate", rate, -MAX_ANGLE, MAX_ANGLE, "rad/s")?;
        }
        row.acceleration.map_or(Ok(()), |given| self.check_acceleration(given).map(drop))
    }

    fn check_acceleration(&self, acceleration: f64) -> Result<f64, Error> {
        let (least, most) = if self.spline == Spline::Cubic { (0.0, 0.0) } else { (-1e12, 1e12) };
        Error::check("waypoint.acceleration", acceleration, least, most, "rad/s^2")
    }

    /// Ends the path with the row that was offered last.
    pub fn close(&mut self) {
        self.closed = true;
    }

    /// True if rows wait to be taken.
    pub(crate) fn waits(&self) -> bool {
        !self.rows.is_empty()
    }

    /// True if the path has ended and every row of it is taken.
    pub fn is_done(&self) -> bool {
        self.closed && self.rows.is_empty()
    }

    /// The hub at the path's beginning.
    pub fn start(&self) -> &HubState<f64> {
        &self.start
    }

    /// Ticks of the rows taken so far.
    pub fn ticks(&self) -> u64 {
        self.joiner.ticks()
    }

    /// Greatest magnitudes over the rows taken so far, between the ticks too. The jerk is infinite
    /// if the acceleration has jumped.
    pub fn peaks(&self) -> &Peaks {
        &self.peaks
    }

    /// Offers rows while there is room, and closes the path behind the last one.
    pub(crate) fn fill(
        &mut self,
        rows: &mut impl Iterator<Item = Waypoint>,
    ) -> Result<(), RowError> {
        while self.has_room() {
            match rows.next() {
                Some(row) => self.offer(row)?,
                None => self.close(),
            }
        }
        Ok(())
    }

    /// True if a piece leads to the first row that waits.
    pub(crate) fn is_next(&self, piece: &PathPiece) -> bool {
        self.waits() && piece.row == self.row
    }

    /// Goes on behind a piece that was planned.
    pub(crate) fn take(&mut self, next: &PathPiece) {
        self.joiner = next.joiner;
        self.peaks = greater(&self.peaks, &next.peaks);
        let _ = self.rows.pop_front();
        self.row += 1;
    }

    /// The error of the first row that waits.
    pub(crate) fn row_error(&self, error: Error) -> RowError {
        RowError { row: self.row, error }
    }
}

fn greater(a: &Peaks, b: &Peaks) -> Peaks {
    Peaks {
        rate: a.rate.max(b.rate),
        acceleration: a.acceleration.max(b.acceleration),
        jerk: a.jerk.max(b.jerk),
    }
}
