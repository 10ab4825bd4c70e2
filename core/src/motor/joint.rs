//! Gear, friction and rotor between hub and motor.

use super::Ratio;
use crate::Error;
use crate::math::Scalar;

/// The joint's constants.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Joint<T> {
    /// n, turns of the motor per turn of the hub; [`Ratio::of_lead`] for a carriage.
    pub ratio: Ratio,
    /// η of the gear, above 0 to 1; 1 is lossless.
    pub efficiency: T,
    /// J_m of rotor and input shaft about the motor's axis, kg m².
    pub rotor_inertia: T,
    /// τ_C, Coulomb friction at the hub, N m; on a linear axis N.
    pub coulomb: T,
    /// b, viscous friction at the hub, N m s/rad; on a linear axis N s/m.
    pub viscous: T,
    /// k_t, N m/A at the motor.
    pub torque_constant: T,
}

/// Torque and current of the motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorTorque<T> {
    /// N m at the motor's shaft, positive with the motor's own positive turn.
    pub torque: T,
    /// A.
    pub current: T,
}

impl Joint<f64> {
    /// A lossless direct drive of that torque constant, N m/A.
    pub const fn direct(torque_constant: f64) -> Self {
        Self {
            ratio: Ratio { motor: 1, link: 1 },
            efficiency: 1.0,
            rotor_inertia: 0.0,
            coulomb: 0.0,
            viscous: 0.0,
            torque_constant,
        }
    }

    /// The joint itself if every field is in range.
    pub fn validate(self) -> Result<Self, Error> {
        self.ratio.validate()?;
        Error::check("motor.efficiency", self.efficiency, 0.01, 1.0, "")?;
        Error::check("motor.rotor_inertia", self.rotor_inertia, 0.0, 1e3, "kg m^2")?;
        Error::check("motor.coulomb", self.coulomb, 0.0, 1e6, "N m")?;
        Error::check("motor.viscous", self.viscous, 0.0, 1e6, "N m s/rad")?;
        Error::check("motor.torque_constant", self.torque_constant, 1e-6, 1e4, "N m/A")?;
        Ok(self)
    }

    /// Rounds to the scalar of the tick.
    pub fn cast<T: Scalar>(&self) -> Joint<T> {
        let f = T::from_f64;
        Joint {
            ratio: self.ratio,
            efficiency: f(self.efficiency),
            rotor_inertia: f(self.rotor_inertia),
            coulomb: f(self.coulomb),
            viscous: f(self.viscous),
            torque_constant: f(self.torque_constant),
        }
    }
}

impl<T: Scalar> Joint<T> {
    /// Motor torque and current for a hub torque τ (N m) at rate θ̇ and acceleration θ̈.
    ///
    /// `τ_l = τ + τ_C sgn θ̇ + bθ̇` with `sgn 0 = 0`; the motor gives `τ_l/(nη)` where it drives
    /// the load (`τ_l θ̇ > 0`), `ητ_l/n` where the load drives it, `τ_l/n` at rest, and `J_m nθ̈`
    /// for its own rotor; current is torque over `k_t`. Signs are the hub's:
    /// [`super::Mapping::signed`] turns them where the gear does.
    pub fn motor(&self, torque: T, rate: T, acceleration: T) -> MotorTorque<T> {
        let n = self.ratio.value::<T>();
        let sign = match rate.partial_cmp(&T::ZERO) {
            Some(core::cmp::Ordering::Greater) => T::ONE,
            Some(core::cmp::Ordering::Less) => -T::ONE,
            _ => T::ZERO,
        };
        let load = torque + self.coulomb * sign + self.viscous * rate;
        let power = load * rate;
        let geared = if power > T::ZERO {
            load / (n * self.efficiency)
        } else if power < T::ZERO {
            self.efficiency * load / n
        } else {
            load / n
        };
        let torque = geared + self.rotor_inertia * n * acceleration;
        MotorTorque { torque, current: torque / self.torque_constant }
    }
}
