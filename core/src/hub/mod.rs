//! Angle, rate and acceleration of the hub at one instant.

mod angle;
mod gravity;

pub use angle::Angle;
pub use gravity::GravityDirection;

use crate::Error;
use crate::math::Scalar;

/// Largest angle, rad, and rate, rad/s, that a move may have: 10⁶ rad resolve to 10⁻¹⁰ rad.
pub(crate) const MAX_ANGLE: f64 = 1e6;

/// The hub at one instant.
///
/// On a linear axis a metre stands for a radian: the angle is the position, the rate the velocity.
/// See [`AxisKind`](crate::scene::AxisKind).
///
/// Set-up and planning hold it in f64, the tick in its own scalar. Where the acceleration jumps it
/// is the right-hand value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HubState<T> {
    /// θ.
    pub angle: Angle<T>,
    /// θ̇, rad/s.
    pub rate: T,
    /// θ̈, rad/s².
    pub acceleration: T,
    /// In the ticks of an arm under gravity, sin χ: see [`GravityDirection`]. Without gravity 0.
    pub sin: T,
    /// In the ticks of an arm under gravity, cos χ: see [`GravityDirection`]. Without gravity 1.
    pub cos: T,
}

impl<T: Scalar> HubState<T> {
    /// At rest at angle 0.
    pub(crate) const ZERO: Self = Self::at_rest(Angle { turns: 0, part: T::ZERO });

    /// At rest at `angle`.
    pub const fn at_rest(angle: Angle<T>) -> Self {
        Self::turning(angle, T::ZERO)
    }

    /// At `angle`, turning evenly at `rate` rad/s.
    pub const fn turning(angle: Angle<T>, rate: T) -> Self {
        Self { angle, rate, acceleration: T::ZERO, sin: T::ZERO, cos: T::ONE }
    }

    /// Angle, rate and acceleration in the precision of set-up.
    pub fn precise(&self) -> HubState<f64> {
        let acceleration = self.acceleration.to_f64();
        HubState { acceleration, ..HubState::turning(self.angle.precise(), self.rate.to_f64()) }
    }

    /// Computes sine and cosine of the angle less `turns`, the direction of gravity.
    #[inline(never)]
    pub(crate) fn update_sin_cos(&mut self, turns: T) {
        (self.sin, self.cos) = (self.angle.part - turns).sin_cos_turns();
    }
}

impl HubState<f64> {
    /// At rest at `from` rad.
    ///
    /// # Errors
    /// An angle beyond 10⁶ rad, or none.
    pub fn resting_at(from: f64) -> Result<Self, Error> {
        let from = Error::check("move.from", from, -MAX_ANGLE, MAX_ANGLE, "rad")?;
        Ok(Self::at_rest(Angle::from_radians(from)))
    }
}
