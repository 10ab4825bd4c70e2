//! The motor side of the joint: from the hub's angle and torque to what the motor's shaft has to
//! do. Drives count motor turns.

mod joint;
mod lead;
mod mapping;

pub use joint::{Joint, MotorTorque};
pub use mapping::{Direction, Mapping, Ratio};

use crate::hub::Angle;
use crate::math::Scalar;
use crate::{Error, Setpoint};

/// Setpoint of the drive, at the motor's shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[must_use]
pub struct Demand<T> {
    /// Shaft angle, turns from the encoder's zero.
    pub position: Angle<T>,
    /// Turns per second.
    pub velocity: T,
    /// Torque of the motor, N m.
    pub torque: T,
}

impl<T: Scalar> Demand<T> {
    /// Every number finite.
    pub fn is_finite(&self) -> bool {
        self.position.part.is_finite() && self.velocity.is_finite() && self.torque.is_finite()
    }
}

/// A joint and where its motor stands: setpoints of the hub in, demands on the shaft out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drivetrain<T> {
    joint: Joint<T>,
    mapping: Mapping<T>,
}

impl<T: Scalar> Drivetrain<T> {
    /// `zero` is the shaft's angle, in turns, where the hub's is 0.
    pub fn new(joint: &Joint<f64>, direction: Direction, zero: f64) -> Result<Self, Error> {
        let joint = joint.validate()?;
        let mapping = Mapping::new(joint.ratio, direction, zero)?;
        Ok(Self { joint: joint.cast(), mapping })
    }

    /// The demand that a setpoint makes.
    pub fn demand(&self, setpoint: &Setpoint<T>) -> Demand<T> {
        Demand {
            position: self.mapping.to_motor(setpoint.angle),
            velocity: self.mapping.velocity(setpoint.rate),
            torque: self.mapping.signed(
                self.joint.motor(setpoint.torque, setpoint.rate, setpoint.acceleration).torque,
            ),
        }
    }

    /// Link to motor and back.
    pub fn mapping(&self) -> &Mapping<T> {
        &self.mapping
    }

    /// Re-homes the joint: from now on the shaft's angle `shaft` belongs to the hub angle `hub`. No
    /// demand moves, because the shaft's counts stay what they are.
    pub fn home(&mut self, shaft: Angle<T>, hub: Angle<T>) {
        self.mapping = self.mapping.homed(shaft, hub);
    }
}
