//! All of a chain that changes from tick to tick.

use super::pose::Vector;
use crate::hub::Angle;
use crate::math::Scalar;

/// Angle of a joint with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JointState<T> {
    /// θ.
    pub angle: Angle<T>,
    /// θ̇, rad/s.
    pub rate: T,
    /// θ̈, rad/s².
    pub acceleration: T,
}

impl<T: Scalar> JointState<T> {
    /// At rest at `angle`.
    pub const fn at_rest(angle: Angle<T>) -> Self {
        Self { angle, rate: T::ZERO, acceleration: T::ZERO }
    }
}

/// Commanded motion of a driven joint in a tick, at the two stages of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command<T> {
    /// A third of the way into the tick.
    pub third: JointState<T>,
    /// At the tick's end. Where the acceleration jumps there, the value before the jump.
    pub end: JointState<T>,
}

/// State of a chain at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainState<T, const LINKS: usize, const W: usize> {
    /// Angles of the joints, with their derivatives.
    pub(super) joints: [JointState<T>; LINKS],
    /// Coordinates of curvature, rad, in the slots from 1; slot 0 is the joint's and unused.
    pub(super) shape: [[T; W]; LINKS],
    /// Rates and accelerations of all coordinates, joints included, rad/s and rad/s².
    pub(super) rate: [[T; W]; LINKS],
    pub(super) acceleration: [[T; W]; LINKS],
    /// Torque at each joint, N m; 0 at a passive one.
    pub(super) torque: [T; LINKS],
    /// End of every link in the global frame, m, and from the link's joint in the link's own.
    pub(super) ends: [Vector<T>; LINKS],
    pub(super) tips: [Vector<T>; LINKS],
    /// Place of the pin in the global frame if the chain is closed, and what it pushes with, N.
    pub(super) pin: Option<Vector<T>>,
    pub(super) force: Vector<T>,
}

impl<T: Scalar, const LINKS: usize, const W: usize> ChainState<T, LINKS, W> {
    /// Joints at the latest tick.
    pub fn joints(&self) -> &[JointState<T>; LINKS] {
        &self.joints
    }

    /// Torque of every motor at the latest tick, N m; 0 at a passive joint.
    pub fn torques(&self) -> &[T; LINKS] {
        &self.torque
    }

    /// True if the end of the chain is on its pin.
    pub fn is_closed(&self) -> bool {
        self.pin.is_some()
    }

    /// Force of the pin on the chain's end, in the global frame, N; 0 while the chain is open.
    pub fn pin_force(&self) -> [T; 2] {
        self.force
    }
}
