//! Result of a tick.

use crate::hub::Angle;
use crate::math::Scalar;
use crate::scene::AxisKind;

/// Setpoint for the motor controller, one every tick. SI units; on a linear axis a metre stands for
/// a radian and a newton for a newton metre, see [`AxisKind`](crate::AxisKind).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Setpoint<T> {
    /// Hub angle θ.
    pub angle: Angle<T>,
    /// θ̇, rad/s.
    pub rate: T,
    /// θ̈, rad/s²; where it jumps, the right-hand value.
    pub acceleration: T,
    /// Torque into the hub by inverse dynamics, N m.
    pub torque: T,
    /// The tip in the hub frame `(X, Y)`, m: X along the link where it is clamped.
    pub tip: [T; 2],
}

impl<T: Scalar> Setpoint<T> {
    /// The tip's deflection, its hub-frame Y, m.
    #[inline(always)]
    pub fn deflection(&self) -> T {
        self.tip[1]
    }

    /// The tip in the global frame `(x, y)` of a hub that turns, m: the hub's angle turns it, by
    /// sine and cosine that a tick has no need of.
    #[inline(always)]
    pub fn global_tip(&self) -> [T; 2] {
        let ([x, y], (sin, cos)) = (self.tip, self.angle.sin_cos());
        [x * cos - y * sin, x * sin + y * cos]
    }

    /// The tip in the global frame `(x, y)`, m, on an axis of that kind: see [`Self::global_tip`]
    /// for one that turns. A carriage moves along global y.
    pub fn global_tip_on(&self, axis: AxisKind) -> [T; 2] {
        match axis {
            AxisKind::Rotary => self.global_tip(),
            AxisKind::Linear => {
                let origin = Angle { turns: 0, part: T::ZERO };
                let position = T::from_f64(core::f64::consts::TAU) * self.angle.since(origin);
                [self.tip[0], self.tip[1] + position]
            }
        }
    }

    /// The payload's centre in the hub frame `(X, Y)`, m, `offset` (m) beyond the tip along the
    /// link's tangent there. `tip_angle` (rad) is the stepper's
    /// [`tip_angle`](crate::Stepper::tip_angle) of the same state.
    pub fn payload_centre(&self, offset: T, tip_angle: T) -> [T; 2] {
        let turns = T::from_f64(1.0 / core::f64::consts::TAU) * tip_angle;
        let (sin, cos) = turns.sin_cos_turns();
        [self.tip[0] + offset * cos, self.tip[1] + offset * sin]
    }
}
