//! The end of a motion, whose last stretch may hold no tick.

use crate::math::Scalar;
use crate::motion::Segment;

/// The end of a motion whose segments come one by one. Those that hold no tick are left out; where
/// the last of them is one, the segment before and the hold behind take its part.
#[derive(Clone, Copy)]
pub(super) struct MotionEnd<T> {
    /// Of the last segment, if it holds no tick: θ̈ at its end, from the left, and its
    /// [moment](Segment::kink_moment), rad/s².
    left_out: Option<[T; 2]>,
}

impl<T: Scalar> MotionEnd<T> {
    /// The end of a motion that has no segment yet.
    pub(super) fn new() -> Self {
        Self { left_out: None }
    }

    /// Takes notice of the next segment. True if it holds a tick.
    pub(super) fn holds_tick(&mut self, segment: &Segment<T>) -> bool {
        let empty = segment.count() == 0;
        self.left_out = empty.then(|| [segment.end_acceleration(), segment.kink_moment()]);
        !empty
    }

    /// Has `last`, the last segment with a tick, end with the motion's own acceleration. Returns
    /// the moment for the hold behind: beside the parabola that ends with that acceleration.
    pub(super) fn close(self, last: Option<&mut Segment<T>>) -> T {
        let Some(([acceleration, moment], last)) = self.left_out.zip(last) else { return T::ZERO };
        let change = acceleration - last.end_acceleration();
        *last = last.ending(acceleration);
        moment + T::from_f64(1.0 / 12.0) * change
    }
}
