//! Frames for a drive beside setpoint and switch, at most one a tick.

use embedded_can::Frame;
use stillbeam::drive::odrive::Node;

/// A request to the drive of an axis that is disabled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Order {
    /// Clear the errors.
    ClearErrors,
    /// Call the shaft's angle so many turns.
    SetPosition(f32),
}

impl Order {
    /// Returns the frame to `node`.
    pub fn frame<F: Frame>(self, node: Node) -> Option<F> {
        match self {
            Self::ClearErrors => node.clear_errors(),
            Self::SetPosition(turns) => node.set_absolute_position(turns),
        }
    }
}
