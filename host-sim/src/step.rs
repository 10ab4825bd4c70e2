//! A move of a scene and the time to settle after it.

use stillbeam::Move;

/// One move and the rest after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The move.
    pub motion: Move,
    /// Time after it, s; 0 for none.
    pub settle: f64,
}

impl Step {
    /// Returns the move and the dwell after it, if there is one.
    pub fn motions(&self) -> impl Iterator<Item = Move> + use<> {
        let dwell = (self.settle > 0.0).then_some(Move::Dwell { duration: self.settle });
        std::iter::once(self.motion).chain(dwell)
    }
}
