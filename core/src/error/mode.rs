//! The mode of an axis: named by its errors, so it stands with them, below the axis itself.

use core::fmt;

/// Operating mode of an [`Axis`](crate::axis::Axis).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Mode {
    /// The drive is off; setpoints stand still and are not sent.
    Disabled,
    /// Follows moves, or holds.
    Enabled,
    /// Brakes.
    Stopping,
    /// Holds after a stop, until enabled again.
    Stopped,
}

impl Mode {
    /// Returns the action after which a request is accepted that this mode refuses.
    pub(super) fn way_out(self) -> &'static str {
        match self {
            Self::Disabled | Self::Stopped => "enable the axis first",
            Self::Enabled => "disable the axis first",
            Self::Stopping => "wait until it is at rest",
        }
    }
}

impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Disabled => "disabled",
            Self::Enabled => "enabled",
            Self::Stopping => "stopping",
            Self::Stopped => "stopped",
        })
    }
}
