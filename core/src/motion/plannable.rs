//! Motions that a generator can plan: any move, or plain ones only.

use super::{Limits, MoveSummary, Segment};
use crate::Error;
use crate::hub::HubState;
use crate::math::Scalar;

pub(super) use sealed::Sealed;

mod sealed {
    pub trait Sealed {}
}

/// A motion that can be cut into segments: a [`Move`](super::Move) of any kind,
/// or a [`PlainMove`](super::PlainMove).
///
/// A type rather than a value, so that a program which plans plain moves only holds no code for the
/// others.
pub trait Plannable: Sealed {
    /// Plans the motion from `start`, with setpoints every `tick` s, and hands its segments to
    /// `sink`, first to last, those that hold no tick too. A motion that is refused may have handed
    /// over none.
    ///
    /// # Errors
    /// A parameter of the move out of range, a limit that it exceeds, or a limit of torque or
    /// moment, which a plan of the hub's motion cannot check.
    fn plan_segments<T: Scalar>(
        &self,
        start: HubState<f64>,
        limits: &Limits,
        tick: f64,
        sink: &mut dyn FnMut(&Segment<T>),
    ) -> Result<MoveSummary, Error>;

    /// True if the hub keeps its rate and the motion may turn it by any number of turns.
    fn keeps_rate(&self) -> bool;
}
