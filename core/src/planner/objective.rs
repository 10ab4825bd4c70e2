//! Objective of a still move.

/// The quantity that a move keeps small, of all moves that bring the arm to rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// Peak of the hub's rate.
    Rate,
    /// Peak of the hub's acceleration.
    Acceleration,
    /// Peak of the hub's jerk.
    Jerk,
    /// Mean square of the hub's jerk, which excites the second mode least.
    Smooth,
    /// Integral of the squared torque, which warms the motor, by [`Planner::gentlest`]. A quintic
    /// with a bulge keeps the mean square of the hub's acceleration small instead.
    ///
    /// [`Planner::gentlest`]: super::Planner::gentlest
    Effort,
}

impl Objective {
    /// Order of the derivative of the hub's rate that is kept small: 0 to 2.
    pub(super) fn order(self) -> usize {
        match self {
            Self::Rate => 0,
            Self::Acceleration | Self::Effort => 1,
            Self::Jerk | Self::Smooth => 2,
        }
    }

    /// True if it is a mean square that is kept small, not a peak.
    pub(super) fn is_mean(self) -> bool {
        matches!(self, Self::Smooth | Self::Effort)
    }
}
