//! The policy of an axis: its limits, those of a stop, and the faults after which it stops.

use crate::Error;
use crate::motion::Limits;

/// Limits of an axis, and the faults after which it stops.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Policy {
    /// Limits of the hub's motion. A move that exceeds them is refused, and a stop keeps them but
    /// for those that it has of its own. The acceleration must be limited. Torque and moment must
    /// not, as an axis cannot check them: see [`Limits`].
    pub limits: Limits,
    /// Limits that a stop has of its own. A [`Change`](super::Change) that brakes keeps `limits`,
    /// and so does the end of a path whose rows stay away.
    #[cfg_attr(feature = "serde", serde(default))]
    pub stop: StopLimits,
    /// Time without a message from the host after which the axis stops, s, rounded to whole ticks,
    /// one at least. 0 waits for ever.
    pub patience: f64,
    /// Ticks in a row that may be missed before the axis stops; the path waits for them. This is a
    /// number, not a time: each is a setpoint that the drive has to do without, and a drive counts
    /// in setpoints what it can bridge, whatever their interval.
    pub missed: u32,
}

/// Limits of a stop, which may be harder than the moves; `None` is that of the moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StopLimits {
    /// |θ̈| of a hub that brakes, rad/s²; at least that of a move that slows down.
    pub deceleration: Option<f64>,
    /// |d³θ/dt³|, rad/s³. A stop keeps its deceleration first, and this where it can.
    pub jerk: Option<f64>,
}

impl StopLimits {
    /// A stop with the limits of the moves.
    pub const OF_MOVES: Self = Self { deceleration: None, jerk: None };
}

impl Policy {
    /// Returns the limits of a stop: the policy's, with those of the stop in their place.
    ///
    /// # Errors
    /// A deceleration below that of a move. A hub that a move slows down would already exceed it
    /// when the stop begins.
    pub(super) fn limits_of_stop(&self) -> Result<Limits, Error> {
        let Self { limits, stop, .. } = self;
        let of_moves = limits.deceleration.or(limits.acceleration);
        if let (Some(own), Some(least)) = (stop.deceleration, of_moves) {
            Error::check("policy.stop.deceleration", own, least, 1e12, "rad/s^2")?;
        }
        if let Some(jerk) = stop.jerk {
            Error::check("policy.stop.jerk", jerk, 1e-9, 1e12, "rad/s^3")?;
        }
        Ok(Limits {
            deceleration: stop.deceleration.or(limits.deceleration),
            jerk: stop.jerk.or(limits.jerk),
            ..*limits
        })
    }
}
