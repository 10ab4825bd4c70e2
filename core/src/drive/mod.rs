//! A demand as bytes for a drive: one file a protocol. Pure: no bus, no clock.
//!
//! All protocols are little-endian; scaled integers are rounded to nearest, and saturation is
//! reported. A value that is not finite is not encoded: several drives take a NaN for a command of
//! its own.
//!
//! | protocol | position | velocity | torque | bytes |
//! |---|---|---|---|---|
//! | [`odrive`] CAN simple | f32 turns | i16 × 0.001 turn/s | i16 × 0.001 N m | 8, classic CAN |
//! | [`cia402`] CSP | i32 increments | i32 increments/s | i16 ‰ of rated torque | 10, or two PDOs |
//! | [`moteus`] | f32 turns | f32 turns/s | f32 N m | 24, CAN FD |
//!
//! Each says of itself what it is at ([`Condition`]). A move whose values a format does not hold is
//! refused before it begins, by [`Range::admit`], and not saturated on its way.
//!
//! No protocol has room for a count of its own, so a [`Sequence`](crate::axis::Sequence) travels
//! beside each payload: to the task that sends it, in the stamp of a captured frame, as the counter
//! of CANopen's SYNC.

pub mod cia402;
mod condition;
mod counts;
mod frame;
pub mod moteus;
pub mod odrive;
mod range;
mod resolution;

pub use condition::Condition;
pub use frame::ClassicFrame;
pub use range::{DemandPeaks, Range};
pub use resolution::{Coarse, Lost, TorquePeak};

use crate::hub::Angle;

/// Flags of the values that did not fit their format and were sent as the nearest that does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Saturated {
    /// Position.
    pub position: bool,
    /// Velocity feed-forward.
    pub velocity: bool,
    /// Torque feed-forward.
    pub torque: bool,
}

impl Saturated {
    /// True if any value was saturated.
    pub fn any(self) -> bool {
        self.position || self.velocity || self.torque
    }
}

/// A payload and the flags of the values that did not fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use]
pub struct Encoded<P> {
    /// The payload.
    pub payload: P,
    /// Flags of the values that were sent as the nearest that the format holds.
    pub saturated: Saturated,
}

/// Turns that one f32 position may be from the encoder's zero.
const WHOLE_TURNS: f32 = 2_097_151.0;

/// Turns in one f32 as an angle, if they are finite and nearest to fewer than 2²¹ whole ones.
fn turns(position: f32) -> Option<Angle<f32>> {
    let within = position > -2_097_151.5 && position < 2_097_151.5;
    within.then(|| Angle { turns: 0, part: 0.0 }.plus(position))
}
