//! Waypoints of any number, made into segments one row at a time.

mod slopes;
mod waypoint;

use heapless::Deque;
use slopes::first_slope;
pub use waypoint::{RowError, Spline, Waypoint};

use super::joiner::{Curve, Joiner};
use super::piece::{Ends, Piece};
use super::{Braking, Limits, Peaks, Segment, admit};
use crate::Error;
use crate::error::MAX_TICKS;
use crate::hub::{Angle, HubState, MAX_ANGLE};

/// Rows that a path looks ahead for the rates of rows without one.
pub const WINDOW: usize = 12;

/// Least time between two rows, ticks.
const CLOSEST: f64 = 1e-3;

/// Jump of the acceleration at a row, of the greatest so far, that counts as none: what is left of
/// rows beyond the window.
const JUMP: f64 = 1e-5;

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

/// The next piece of a path, planned and not yet taken.
pub(crate) struct NextPiece {
    /// Its segment, if a tick lies within.
    pub segment: Option<Segment<f64>>,
    /// Greatest magnitudes on it.
    pub peaks: Peaks,
    /// The hub's way from its end, if no other row comes.
    pub rest: Rest,
    joiner: Joiner,
}

/// What the hub does behind a row as long as no other is known.
pub(crate) struct Rest {
    /// Stop from the row on. None if the hub rests at the row, or if it is the last.
    pub stop: Option<Segment<f64>>,
    /// State of the hub behind it, at a tick; it keeps its rate.
    pub end: HubState<f64>,
    /// Moment of the last border within the tick before, see [`Segment::kink_moment`].
    pub kink_moment: f64,
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
        if let Some(acceleration) = row.acceleration {
            let (least, most) =
                if self.spline == Spline::Cubic { (0.0, 0.0) } else { (-1e12, 1e12) };
            Error::check("waypoint.acceleration", acceleration, least, most, "rad/s^2")?;
        }
        Ok(())
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

    /// Checks rows without a generator: a path from here through all of them. Returns the path as
    /// it is at the end: its ticks and its peaks. It takes no more memory than the path itself.
    ///
    /// # Errors
    /// The first row that [`Self::offer`] or a limit refuses.
    pub fn survey(&self, rows: impl IntoIterator<Item = Waypoint>) -> Result<Self, RowError> {
        let mut path = self.clone();
        let mut rows = rows.into_iter();
        while !path.is_done() {
            path.fill(&mut rows)?;
            while let Some(next) = path.next_piece()? {
                path.take(next);
            }
        }
        Ok(path)
    }

    /// Returns the segments of a whole path, first to last, in f64.
    ///
    /// `rows` is an iterator over all rows. An item is the error of a row that is refused; nothing
    /// follows it.
    pub fn segments(
        self,
        rows: impl IntoIterator<Item = Waypoint>,
    ) -> impl Iterator<Item = Result<Segment<f64>, RowError>> {
        Segments { path: self, rows: rows.into_iter(), failed: false }
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

    /// Plans the piece up to the first row that waits, if that and its rate are known.
    pub(crate) fn next_piece(&self) -> Result<Option<NextPiece>, RowError> {
        let Some(row) = self.rows.front().filter(|row| self.is_determined(row)) else {
            return Ok(None);
        };
        let refused = |error| RowError { row: self.row, error };
        let (curve, piece) = self.curve(row);
        let duration = (curve.until - self.joiner.border()) * self.tick;
        let peaks = self.joined_peaks(&curve, piece.peaks(duration));
        admit(&self.limits, &peaks, self.tick).map_err(refused)?;
        let mut joiner = self.joiner;
        let segment = joiner.append(&curve);
        let rest = self.rest_behind(joiner, &peaks).map_err(refused)?;
        Ok(Some(NextPiece { segment, peaks, rest, joiner }))
    }

    /// Goes on behind a piece that was planned.
    pub(crate) fn take(&mut self, next: NextPiece) {
        let NextPiece { peaks, joiner, .. } = next;
        self.joiner = joiner;
        self.peaks = greater(&self.peaks, &peaks);
        let _ = self.rows.pop_front();
        self.row += 1;
    }

    /// The error of the first row that waits.
    pub(crate) fn row_error(&self, error: Error) -> RowError {
        RowError { row: self.row, error }
    }

    /// True if all is known on which the way to the first row depends.
    fn is_determined(&self, row: &Waypoint) -> bool {
        if self.closed || self.rows.is_full() {
            return true;
        }
        let known = |row: &Waypoint| row.rate.is_some();
        match self.spline {
            Spline::Cubic => known(row),
            Spline::Quintic if row.acceleration.is_some() => known(row),
            // Its acceleration depends on the rate of the row behind.
            Spline::Quintic => known(row) && self.rows.iter().nth(1).is_some_and(known),
        }
    }

    /// The polynomial from the border to a row.
    fn curve(&self, row: &Waypoint) -> (Curve, Piece<f64>) {
        let here = self.joiner.here();
        let (border, until) = (self.joiner.border(), row.time / self.tick);
        let slope = first_slope(here, border * self.tick, &self.rows, self.closed);
        let angle = Angle::from_radians(row.angle);
        let duration = (until - border) * self.tick;
        let bend = row.acceleration.or(slope.acceleration).unwrap_or(0.0);
        let turn = angle.since(here.angle);
        let ends = Ends::new(turn, [here.rate, slope.rate], [here.acceleration, bend], duration);
        let piece = match self.spline {
            Spline::Cubic => ends.cubic(),
            Spline::Quintic => ends.quintic(),
        };
        let [begin_acceleration, end] = match self.spline {
            Spline::Cubic => piece.accelerations(duration),
            Spline::Quintic => [here.acceleration, bend],
        };
        let end = HubState { acceleration: end, ..HubState::turning(angle, slope.rate) };
        (Curve { shape: piece.shape(), until, end, begin_acceleration }, piece)
    }

    /// The peaks of a piece, with an infinite jerk if the acceleration jumps where it begins, or
    /// where the path ends.
    fn joined_peaks(&self, curve: &Curve, peaks: Peaks) -> Peaks {
        let most = JUMP * peaks.acceleration.max(self.peaks.acceleration);
        let jumps = |jump: f64| jump.abs() > most;
        let ends = self.closed && self.rows.len() == 1;
        let begin = curve.begin_acceleration - self.joiner.here().acceleration;
        if jumps(begin) || (ends && jumps(curve.end.acceleration)) {
            return Peaks { jerk: f64::INFINITY, ..peaks };
        }
        peaks
    }

    /// The hub's way from the row at the end of `joiner`: on at its rate if the path ends there,
    /// else a stop.
    fn rest_behind(&self, mut joiner: Joiner, peaks: &Peaks) -> Result<Rest, Error> {
        let ends = self.closed && self.rows.len() == 1;
        let here = *joiner.here();
        let stop = if ends || here.rate == 0.0 {
            None
        } else {
            let curve = self.braking(&here, peaks)?.curve(&joiner);
            joiner.append(&curve)
        };
        let (end, kink_moment) = joiner.finish();
        Ok(Rest { stop, end, kink_moment })
    }

    /// Limits of the stop behind a row. Where the acceleration is not limited it brakes as hard as
    /// the path has accelerated, and within a turn.
    fn braking(&self, here: &HubState<f64>, peaks: &Peaks) -> Result<Braking<f64>, Error> {
        let most = peaks.acceleration.max(self.peaks.acceleration);
        let within_a_turn = here.rate * here.rate / core::f64::consts::TAU;
        let acceleration = self.limits.acceleration.unwrap_or(most.max(within_a_turn).max(1e-9));
        let limits = Limits { acceleration: Some(acceleration), ..self.limits };
        Braking::new(&limits, self.tick)
    }
}

fn greater(a: &Peaks, b: &Peaks) -> Peaks {
    Peaks {
        rate: a.rate.max(b.rate),
        acceleration: a.acceleration.max(b.acceleration),
        jerk: a.jerk.max(b.jerk),
    }
}

/// See [`Path::segments`].
struct Segments<I> {
    path: Path,
    rows: I,
    failed: bool,
}

impl<I: Iterator<Item = Waypoint>> Iterator for Segments<I> {
    type Item = Result<Segment<f64>, RowError>;

    fn next(&mut self) -> Option<Self::Item> {
        while !self.failed {
            let next = self.path.fill(&mut self.rows).and_then(|()| self.path.next_piece());
            match next {
                Ok(Some(next)) => {
                    let segment = next.segment;
                    self.path.take(next);
                    if let Some(segment) = segment {
                        return Some(Ok(segment));
                    }
                }
                Ok(None) => return None,
                Err(error) => {
                    self.failed = true;
                    return Some(Err(error));
                }
            }
        }
        None
    }
}
