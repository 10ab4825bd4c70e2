//! A motion of a scene and the time to settle after it.

use stillbeam::{Error as CoreError, Move};

use crate::waypoints::Waypoints;

/// One motion and the rest after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The motion.
    pub motion: Motion,
    /// Time after it, s; 0 for none.
    pub settle: f64,
}

/// Motion asked of the hub: a move, or a path through waypoints.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// A move, as a generator's queue takes it.
    Move(Move),
    /// A path through waypoints, with which a generator's queue is fed.
    Path(Waypoints),
}

impl Step {
    /// Returns the motion and the dwell after it, if there is one.
    pub fn motions(&self) -> impl Iterator<Item = Motion> + use<> {
        let dwell = (self.settle > 0.0).then_some(Move::Dwell { duration: self.settle });
        std::iter::once(self.motion.clone()).chain(dwell.map(Motion::Move))
    }
}

impl Motion {
    /// Returns the duration that is asked for, s.
    pub fn duration(&self) -> f64 {
        match self {
            Self::Move(motion) => motion.duration(),
            Self::Path(path) => path.duration(),
        }
    }

    /// Returns the same motion in another duration, s. A path passes the same angles at times,
    /// rates and accelerations that are stretched alike.
    pub fn lasting(&self, duration: f64) -> Self {
        match self {
            Self::Move(motion) => Self::Move(motion.lasting(duration)),
            Self::Path(path) => Self::Path(path.lasting(duration)),
        }
    }

    /// Returns the whole ticks of `tick` s that the motion takes.
    ///
    /// # Errors
    /// A duration of a move that is out of range.
    pub fn ticks(&self, tick: f64) -> Result<u32, CoreError> {
        match self {
            Self::Move(motion) => motion.ticks(tick),
            Self::Path(path) => Ok(path.ticks(tick)),
        }
    }

    /// True if the motion is a dwell.
    pub fn is_dwell(&self) -> bool {
        matches!(self, Self::Move(Move::Dwell { .. }))
    }

    /// Returns the move, or `None` for a path.
    pub fn as_move(&self) -> Option<Move> {
        match self {
            Self::Move(motion) => Some(*motion),
            Self::Path(_) => None,
        }
    }
}

impl From<Move> for Motion {
    fn from(motion: Move) -> Self {
        Self::Move(motion)
    }
}
