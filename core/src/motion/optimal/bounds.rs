//! Limits in the form that a time-optimal motion is planned with.

use crate::Error;
use crate::motion::Limits;

/// Limits of a time-optimal motion, each a magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bounds {
    /// |θ̇|, rad/s; finite.
    pub rate: f64,
    /// |θ̈| of a hub that speeds up, rad/s²; infinite if only the jerk is limited.
    pub acceleration: f64,
    /// |θ̈| of a hub that slows down, rad/s².
    pub deceleration: f64,
    /// |d³θ/dt³|, rad/s³; infinite if the acceleration may jump.
    pub jerk: f64,
}

impl Bounds {
    /// Takes the bounds from `limits`, with setpoints every `tick` s. A hub without a limit of rate
    /// may turn by a radian a tick, as in every move.
    ///
    /// # Errors
    /// A limit out of range or of torque or moment, which a motion of the hub cannot check; no
    /// limit of acceleration and none of jerk.
    pub fn new(limits: &Limits, tick: f64) -> Result<Self, Error> {
        let limits = limits.validate()?.of_motion()?;
        let unlimited = f64::INFINITY;
        let acceleration = limits.acceleration.unwrap_or(unlimited);
        let jerk = limits.jerk.unwrap_or(unlimited);
        if acceleration == unlimited && jerk == unlimited {
            Error::check("limits.acceleration", acceleration, 1e-9, 1e12, "rad/s^2")?;
        }
        Ok(Self {
            rate: limits.rate.unwrap_or(unlimited).min(1.0 / tick),
            acceleration,
            deceleration: limits.deceleration.unwrap_or(acceleration),
            jerk,
        })
    }

    /// Refuses bounds that are no positive numbers, or that leave the rate free to jump.
    pub(super) fn check(&self) -> Result<(), Error> {
        let check = |parameter, value: f64, unit| {
            Error::check(parameter, value, 1e-9, 1e12, unit).map(drop)
        };
        check("bounds.rate", self.rate, "rad/s")?;
        let jumps = self.jerk == f64::INFINITY;
        for (parameter, value) in
            [("bounds.acceleration", self.acceleration), ("bounds.deceleration", self.deceleration)]
        {
            if jumps || value != f64::INFINITY {
                check(parameter, value, "rad/s^2")?;
            }
        }
        if jumps { Ok(()) } else { check("bounds.jerk", self.jerk, "rad/s^3") }
    }
}
