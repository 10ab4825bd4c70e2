//! Coming to rest before the moves are done, in the tick if need be: no f64 planning, no panic.

use super::{Generator, Part};
use crate::hub::{Angle, HubState};
use crate::math::Scalar;
use crate::motion::{Braking, Segment};
use crate::stepper::Stepper;

/// Longest remainder of a move that is finished rather than stopped, in durations of the stop.
///
/// A tail that ends more smoothly than a stop does takes up to twice as long. There must be a
/// bound: a move of less than an angle's resolution is at its end all the time, and may last for
/// days.
const PATIENCE: u32 = 4;

/// Time and place at which the move under way comes to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arrival {
    /// Ticks from the latest setpoint to the end.
    pub(crate) ticks: u32,
    /// Hub at the end of the move, at rest.
    pub(crate) end: HubState<f64>,
}

impl<S: Stepper, const QUEUE: usize> Generator<S, QUEUE> {
    /// Brakes along the path from the next tick on and holds; no move waits any more.
    ///
    /// A move that would be over before the hub could be stopped is finished: that is the quickest
    /// stop on its path, and within the limits it was accepted for.
    pub(crate) fn brake(&mut self, braking: &Braking<S::Scalar>, arrival: Option<Arrival>) {
        self.end_acceleration = self.acceleration_before();
        self.revision = self.revision.wrapping_add(1);
        if self.hub.rate == S::Scalar::ZERO {
            self.queue.clear();
            self.rest_at(self.hub.angle);
            // A move that was about to begin does not.
            self.hub.acceleration = S::Scalar::ZERO;
            self.current.take_up(&self.tail, Part::Hold, 0, &self.stepper);
            return;
        }
        let (segment, rest, acceleration) = braking.stop(&self.hub);
        if let Some(arrival) = arrival
            && arrival.ticks <= segment.count().saturating_mul(PATIENCE)
            && passes(self.hub.angle, rest, arrival.end.angle.cast())
        {
            self.finish(arrival);
            return;
        }
        self.queue.clear();
        self.rest_at(rest);
        // Its tick 0 is the latest setpoint's.
        self.current.take_up(&segment, Part::Move, 0, &self.stepper);
        // The right-hand value, where it drops.
        self.hub.acceleration = acceleration;
    }

    /// Drops what lies behind the arrival; the hub rests there.
    fn finish(&mut self, arrival: Arrival) {
        self.keep_until(arrival, Segment::rest(arrival.end.angle.cast()));
    }

    /// Drops what lies behind the arrival, and holds on along `tail`.
    fn keep_until(&mut self, arrival: Arrival, tail: Segment<S::Scalar>) {
        let under_way = self.current.segment().count().saturating_sub(self.current.k());
        let mut waiting = self.queue.iter().fold(0u32, |n, s| n.saturating_add(s.count()));
        let keep = arrival.ticks.saturating_sub(under_way);
        // What the arm feels of the arrival is with the segment behind it.
        let mut moment = self.border_moment();
        while waiting > keep
            && let Some(last) = self.queue.pop_back()
        {
            waiting = waiting.saturating_sub(last.count());
            moment = last.kink_moment();
        }
        self.revision = self.revision.wrapping_add(1);
        self.end = arrival.end;
        self.tail = tail;
        self.tail.set_kink_moment(moment);
    }

    /// Drops what lies behind the arrival, after which the hub may go on turning. Not for the tick.
    pub(crate) fn end_with(&mut self, arrival: Arrival) {
        self.keep_until(arrival, super::hold(arrival.end, self.stepper.tick()));
    }

    /// Makes the hub rest at `angle` after the queue.
    pub(super) fn rest_at(&mut self, angle: Angle<S::Scalar>) {
        self.end = HubState::at_rest(angle.precise());
        self.tail = Segment::rest(angle);
    }
}

/// True if `rest` lies at or beyond `end` as seen from `from`.
fn passes<T: Scalar>(from: Angle<T>, rest: Angle<T>, end: Angle<T>) -> bool {
    let turns = |to: Angle<T>| {
        f64::from(to.turns.wrapping_sub(from.turns)) + (to.part.to_f64() - from.part.to_f64())
    };
    let (rest, end) = (turns(rest), turns(end));
    if end < 0.0 { rest <= end } else { rest >= end }
}
