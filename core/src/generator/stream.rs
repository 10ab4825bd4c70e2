//! Paths of any length through a queue of fixed size.

use super::{Generator, MotionEnd, hold};
use crate::Error;
use crate::math::Scalar;
use crate::motion::{Path, PathPiece, RowError, Segment, Spline, Stream, Waypoint};
use crate::stepper::Stepper;

impl<S: Stepper, const QUEUE: usize> Generator<S, QUEUE> {
    /// A path from the end of the queue on, within the generator's limits, to be fed by
    /// [`Self::feed`]. Its time 0 is the tick at which the queue ends, or the next one.
    ///
    /// # Errors
    /// None but those of [`Path::new`].
    pub fn path(&self, spline: Spline) -> Result<Path, Error> {
        Path::new(spline, self.next_start(), &self.limits, self.stepper.tick())
    }

    /// Takes rows of a path into the queue, as many as there is room for. True if it has taken the
    /// last.
    ///
    /// Call it before every tick, or whenever the queue has room; not in the tick's interrupt, as
    /// it plans in f64. A row takes one segment, or none where no tick lies before the next row.
    /// Behind the last row taken there is always a stop along the path, within the limits. The next
    /// row replaces it. So a path whose rows come too late ends at rest.
    ///
    /// # Errors
    /// A row that [`Path::offer`], a limit or the stepper refuses. The hub stops at the row before.
    /// [`Error::Starved`] if that stop has begun already, [`Error::Stale`] if the hub has been
    /// given another motion since the path's last row.
    pub fn feed(
        &mut self,
        path: &mut Path,
        rows: &mut impl Iterator<Item = Waypoint>,
    ) -> Result<bool, RowError> {
        loop {
            path.fill(rows)?;
            if !self.plan_piece(path)? {
                return Ok(path.is_done());
            }
        }
    }

    /// Takes those rows of a path that were [offered](Path::offer), as [`Self::feed`] does.
    ///
    /// # Errors
    /// Those of [`Self::feed`].
    pub fn advance(&mut self, path: &mut Path) -> Result<bool, RowError> {
        while self.plan_piece(path)? {}
        Ok(path.is_done())
    }

    /// Plans one row and takes it, if it is ready and there is room.
    fn plan_piece(&mut self, path: &mut Path) -> Result<bool, RowError> {
        if path.waits() {
            self.joins(path).map_err(|error| path.row_error(error))?;
        }
        match path.next_piece()? {
            Some(next) => self.take_piece(path, &next),
            None => Ok(false),
        }
    }

    /// Takes a piece that [`Path::next_piece`] has planned. False if there is no room for it yet:
    /// it stays as it is, to be taken later.
    ///
    /// [`Self::advance`] in two parts: the plan runs beside the ticks, and only its result is
    /// handed over between two of them. The bits are the same.
    ///
    /// # Errors
    /// [`Error::Starved`] and [`Error::Stale`] as of [`Self::feed`], the latter also of a piece
    /// that is not the path's next, and what the stepper refuses.
    pub fn take_piece(&mut self, path: &mut Path, next: &PathPiece) -> Result<bool, RowError> {
        let joins = if path.is_next(next) { self.joins(path) } else { Err(Error::Stale) };
        joins.map_err(|error| path.row_error(error))?;
        let kept = self.queue.len() - usize::from(path.stream.stops);
        if kept + next.queued().count() > QUEUE {
            return Ok(false);
        }
        let admitted = self.stepper.admit(&next.peaks, next.rest.end.rate);
        admitted.map_err(|error| path.row_error(error))?;
        self.put(path, next);
        path.take(next);
        Ok(true)
    }

    /// Refuses a path whose last row is no longer where the hub's motion goes on.
    fn joins(&self, path: &Path) -> Result<(), Error> {
        let Stream { revision, stops } = path.stream;
        match revision {
            None if self.next_start() != *path.start() => Err(Error::Stale),
            None => Ok(()),
            Some(revision) if revision != self.revision => Err(Error::Stale),
            // The stop, or the rest, has begun.
            Some(_) if (stops && self.queue.is_empty()) || self.is_holding() => Err(Error::Starved),
            Some(_) => Ok(()),
        }
    }

    /// Puts a piece in place of the stop at the queue's end, and behind it the next stop.
    fn put(&mut self, path: &mut Path, next: &PathPiece) {
        let first = path.stream.revision.is_none();
        let mut moment = if first { self.border_moment() } else { S::Scalar::ZERO };
        if path.stream.stops {
            self.queue.pop_back();
        }
        for segment in next.queued() {
            // There is room: just counted.
            let _ = self.queue.push_back(segment.cast().behind(&mut moment));
        }
        if first {
            self.current.end_hold();
        }
        self.end = next.rest.end;
        self.tail = hold(self.end, self.stepper.tick());
        let moment = match next.closing() {
            Some(segment) => {
                let mut motion_end = MotionEnd::new();
                motion_end.holds_tick(&segment.cast());
                motion_end.close(Some(self.last_segment()))
            }
            None => S::Scalar::from_f64(next.rest.kink_moment),
        };
        self.tail.set_kink_moment(moment);
        self.revision = self.revision.wrapping_add(1);
        path.stream = Stream { revision: Some(self.revision), stops: next.rest.stop.is_some() };
    }

    /// The segment that holds the queue's last tick.
    fn last_segment(&mut self) -> &mut Segment<S::Scalar> {
        match self.queue.back_mut() {
            Some(segment) => segment,
            None => self.current.segment_mut(),
        }
    }
}
