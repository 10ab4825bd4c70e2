//! A change of mind on the wire.

use serde::{Deserialize, Serialize};

/// A change of an axis' motion from the next tick on: those of `stillbeam::axis::Change` that are
/// planned in the precision of the tick, in a few thousand instructions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Change {
    /// Meet a target that is at `angle` rad and turns at `rate` rad/s, `duration` s after the
    /// latest setpoint. All moves are dropped.
    Target {
        /// The target's angle at the latest setpoint, rad.
        angle: f64,
        /// The target's rate, rad/s; the hub turns on with it.
        rate: f64,
        /// Time until they meet, s.
        duration: f64,
    },
    /// The move under way ends as it would have, this time after the latest setpoint, s. Moves
    /// behind it follow as planned.
    Duration(f64),
    /// Brake along the path and hold. All moves are dropped; the axis stays enabled.
    Hold,
    /// Drop the moves behind the one under way.
    Cancel,
}
