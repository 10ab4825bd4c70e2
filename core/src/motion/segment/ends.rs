//! Exact beginning and end of a segment, whatever its formula rounds to there.

use super::{End, Segment};
use crate::hub::{Angle, HubState};
use crate::math::Scalar;

impl<T: Scalar> Segment<T> {
    /// Moves the hub, but for its sine and cosine, to the segment's tick 0.
    #[inline(always)]
    pub(crate) fn begin(&self, hub: &mut HubState<T>) {
        let End { angle, rate, acceleration } = self.begin;
        (hub.angle, hub.rate, hub.acceleration) = (angle, rate, acceleration);
    }

    /// Returns the segment with the known rate (rad/s) and acceleration (rad/s²) at its tick 0, in
    /// place of the formula's rounded values.
    pub(crate) fn beginning(mut self, rate: T, acceleration: T) -> Self {
        (self.begin.rate, self.begin.acceleration) = (rate, acceleration);
        self
    }

    /// Returns the segment with `end_acceleration` (rad/s²) as left-hand value at its end.
    pub(crate) fn ending(self, end_acceleration: T) -> Self {
        Self { end_acceleration, ..self }
    }

    /// Stores the formula's values at tick 0.
    pub(super) fn begun(mut self) -> Self {
        let mut hub = HubState::ZERO;
        self.drive_otherwise(&mut hub, 0);
        self.begin = End { angle: hub.angle, rate: hub.rate, acceleration: hub.acceleration };
        self
    }

    /// Returns the first segment of a move with the moment of the border before it, and takes that
    /// away from the segments behind.
    pub(crate) fn behind(&self, moment: &mut T) -> Self {
        let kink_moment = if *moment == T::ZERO { self.kink_moment } else { *moment };
        *moment = T::ZERO;
        Self { kink_moment, ..*self }
    }

    /// Ends a segment at constant rate `count` ticks after its beginning.
    pub(crate) fn cut(&mut self, count: u32) {
        self.count = count;
    }

    /// Returns the segment, broken off `count` ticks after its beginning.
    pub(crate) fn broken_off(self, count: u32) -> Self {
        Self { count, end_acceleration: self.hub(count).acceleration, ..self }
    }

    /// Returns the segment moved to begin at the angle `start`, which lies `by` from its old start.
    pub(crate) fn shifted(mut self, by: Angle<T>, start: Option<Angle<T>>) -> Self {
        let on = |angle: Angle<T>| Angle { turns: angle.turns.wrapping_add(by.turns), ..angle };
        self.origin = on(self.origin).plus(by.part);
        self.begin.angle = start.unwrap_or(on(self.begin.angle).plus(by.part));
        self
    }

    /// Returns the same segment at constant rate, beginning at another angle.
    pub(crate) fn moved(mut self, origin: Angle<T>) -> Self {
        (self.origin, self.begin.angle) = (origin, origin);
        self
    }
}
