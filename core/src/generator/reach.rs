//! A time-optimal motion in place of the one under way.

use heapless::Vec;

use super::{Generator, MotionEnd, Part, hold};
use crate::Error;
use crate::hub::HubState;
use crate::motion::optimal::{Bounds, MAX_PIECES, TimeOptimal};
use crate::motion::{MoveSummary, Segment};
use crate::stepper::Stepper;

/// A motion ready to be taken up.
struct Planned<T> {
    /// The segments that hold a tick.
    segments: Vec<Segment<T>, MOST>,
    /// Moment for the hold behind them, see [`Segment::kink_moment`].
    kink_moment: T,
    summary: MoveSummary,
}

/// Segments of the longest motion: its pieces and the tick that they end in.
const MOST: usize = MAX_PIECES + 1;

impl<S: Stepper, const QUEUE: usize> Generator<S, QUEUE> {
    /// Replaces all that follows by the shortest motion from the hub's present state to `end`,
    /// within the generator's limits of rate, acceleration, deceleration and jerk, as
    /// [`Self::retarget`] does by a quintic. Plans in f64. Behind a queue it is a
    /// [`Move::Reach`](crate::Move::Reach).
    ///
    /// # Errors
    /// Those of [`TimeOptimal::reach`], [`Error::QueueFull`], or what the stepper was not set up
    /// for. Nothing has changed then.
    pub fn reach(&mut self, end: &HubState<f64>) -> Result<MoveSummary, Error> {
        let Planned { segments, kink_moment, summary } = self.shortest_to(end)?;
        let Some((first, others)) = segments.split_first() else { return Ok(summary) };
        self.end_acceleration = self.acceleration_before();
        self.queue.clear();
        let k = if self.current.is_unstarted() { u32::MAX } else { 0 };
        self.current.take_up(first, Part::Move, k, &self.stepper);
        // The right-hand value, where the acceleration jumps.
        self.hub.acceleration = first.hub(0).acceleration;
        for segment in others {
            // There is room: just counted.
            let _ = self.queue.push_back(*segment);
        }
        self.revision = self.revision.wrapping_add(1);
        self.end = summary.end;
        self.tail = hold(self.end, self.stepper.tick());
        self.tail.set_kink_moment(kink_moment);
        Ok(summary)
    }

    fn shortest_to(&self, end: &HubState<f64>) -> Result<Planned<S::Scalar>, Error> {
        let tick = self.stepper.tick();
        let bounds = Bounds::new(&self.limits, tick)?;
        let motion = TimeOptimal::reach(&self.hub.precise(), end, &bounds)?;
        let (mut segments, mut motion_end) = (Vec::new(), MotionEnd::new());
        let summary = motion.lay(tick, &mut |segment| {
            if motion_end.holds_tick(segment) {
                // No motion has more.
                let _ = segments.push(*segment);
            }
        })?;
        // The first is under way at once and needs no place.
        let (needed, free) = (segments.len(), QUEUE + 1);
        if needed > free {
            return Err(Error::QueueFull { needed, free });
        }
        self.stepper.admit(&summary.peaks, summary.end.rate)?;
        let kink_moment = motion_end.close(segments.last_mut());
        Ok(Planned { segments, kink_moment, summary })
    }
}
