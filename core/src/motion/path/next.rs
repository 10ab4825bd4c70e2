//! The next piece of a path: its polynomial, its peaks, and the stop behind it.

use super::slopes::first_slope;
use super::{Path, RowError, Spline, Waypoint};
use crate::Error;
use crate::hub::{Angle, HubState};
use crate::motion::joiner::{Curve, Joiner};
use crate::motion::piece::{Ends, Piece};
use crate::motion::{Braking, Limits, Peaks, Segment, admit};

/// Jump of the acceleration at a row, of the greatest so far, that counts as none: what is left of
/// rows beyond the window.
const JUMP: f64 = 1e-5;

/// The next piece of a path, planned by [`Path::next_piece`] and not yet taken.
#[derive(Clone, Debug)]
pub struct PathPiece {
    /// Number of the row that it leads to.
    pub(super) row: u32,
    /// True if that is the path's last.
    ends: bool,
    /// Its segment, which may hold no tick.
    pub(crate) segment: Option<Segment<f64>>,
    /// Greatest magnitudes on it.
    pub(crate) peaks: Peaks,
    /// The hub's way from its end, if no other row comes.
    pub(crate) rest: Rest,
    pub(super) joiner: Joiner,
}

/// The hub's motion behind a row as long as no other is known.
#[derive(Clone, Debug)]
pub(crate) struct Rest {
    /// Stop from the row on. None if the hub rests at the row, or if it is the last.
    pub stop: Option<Segment<f64>>,
    /// State of the hub behind it, at a tick, with the acceleration just before. It keeps its rate
    /// unless another motion begins there.
    pub end: HubState<f64>,
    /// Moment of the last border within the tick before, see [`Segment::kink_moment`].
    pub kink_moment: f64,
}

impl PathPiece {
    /// The segments with a tick: its own, and the stop behind it.
    pub(crate) fn queued(&self) -> impl Iterator<Item = &Segment<f64>> {
        let all = self.segment.iter().chain(&self.rest.stop);
        all.filter(|segment| segment.count() > 0)
    }

    /// The path's last segment, if it ends at a tick and holds none.
    pub(crate) fn closing(&self) -> Option<&Segment<f64>> {
        let ends = self.ends && self.joiner.is_at_tick();
        self.segment.as_ref().filter(|segment| ends && segment.count() == 0)
    }
}

impl Path {
    /// Plans the piece up to the first row that waits, if that and its rate are known: with the
    /// window full, the path closed, or a rate given.
    /// [`Axis::take_piece`](crate::axis::Axis::take_piece) takes it.
    ///
    /// It plans in f64, some ten thousand instructions without a unit for that, and needs nothing
    /// but the path: fit for a low priority, with the ticks going on.
    ///
    /// # Errors
    /// A limit that the piece or the stop behind it exceeds.
    pub fn next_piece(&self) -> Result<Option<PathPiece>, RowError> {
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
        Ok(Some(PathPiece { row: self.row, ends: self.ends(), segment, peaks, rest, joiner }))
    }

    /// True if the path ends with the first row that waits.
    fn ends(&self) -> bool {
        self.closed && self.rows.len() == 1
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
        let before = if self.row == 0 { &self.start } else { self.joiner.here() };
        let begin = curve.begin_acceleration - before.acceleration;
        if jumps(begin) || (self.ends() && jumps(curve.end.acceleration)) {
            return Peaks { jerk: f64::INFINITY, ..peaks };
        }
        peaks
    }

    /// The hub's way from the row at the end of `joiner`: on at its rate if the path ends there,
    /// else a stop.
    fn rest_behind(&self, mut joiner: Joiner, peaks: &Peaks) -> Result<Rest, Error> {
        let (ends, here) = (self.ends(), *joiner.here());
        let stop = if ends || here.rate == 0.0 {
            None
        } else {
            let curve = self.braking(&here, peaks)?.curve(&joiner);
            joiner.append(&curve)
        };
        let (mut end, kink_moment) = joiner.finish();
        // A quintic goes on from the acceleration that the last row gives, if it ends at a tick.
        if ends && self.spline == Spline::Quintic && joiner.is_at_tick() {
            end.acceleration = here.acceleration;
        }
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
