//! The end of a motion whose last stretch holds no tick.

use crate::math::Scalar;
use crate::motion::Segment;

/// What a motion leaves to the hold behind it, if its last segment holds no tick and is left out.
#[derive(Clone, Copy)]
pub(super) struct Closing<T> {
    /// θ̈ at the motion's end, from the left, rad/s².
    acceleration: T,
    /// Moment of the borders within the last tick, see [`Segment::kink_moment`].
    moment: T,
}

impl<T: Scalar> Closing<T> {
    /// Returns what a motion leaves whose last segment is `segment`; none if that holds a tick.
    pub(super) fn of(segment: &Segment<T>) -> Option<Self> {
        (segment.count() == 0).then(|| Self {
            acceleration: segment.end_acceleration(),
            moment: segment.kink_moment(),
        })
    }

    /// Has `last`, the segment that holds the last tick, end with the motion's own acceleration.
    /// Returns the moment for the hold behind: beside the parabola that now ends with it.
    pub(super) fn close(self, last: &mut Segment<T>) -> T {
        let change = self.acceleration - last.end_acceleration();
        *last = last.ending(self.acceleration);
        self.moment + T::from_f64(1.0 / 12.0) * change
    }
}
