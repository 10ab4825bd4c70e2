//! Limits of the drive, and the peaks of a move that are held against them.

use crate::Error;
use crate::math::words;

/// Limits of the drive; `None` is unlimited.
///
/// Rate, acceleration and jerk limit the hub's motion. Every layer that takes a move keeps them: a
/// move is accepted by the peaks of its curve, between the ticks as well as on them.
///
/// Torque and moment limit what the arm answers with, which depends on its vibration. Only a layer
/// that flies the arm through the move knows them: the planner of still moves
/// ([`Planner`](crate::planner::Planner)) and the desktop's `run`. The others
/// ([`Generator::limit`], [`Axis::new`], [`Plan::new`](super::Plan::new),
/// [`Braking::new`](super::Braking::new)) see a tick of one method at a time, whose peak may lie
/// between the ticks, and refuse these two limits rather than ignore them.
///
/// [`Generator::limit`]: crate::Generator::limit
/// [`Axis::new`]: crate::axis::Axis::new
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Limits {
    /// |θ̇|, rad/s.
    pub rate: Option<f64>,
    /// |θ̈|, rad/s².
    pub acceleration: Option<f64>,
    /// |θ̈| of a hub that slows down, rad/s²; `None` for the limit of `acceleration`. A motion that
    /// both speeds up and slows down is held with its greatest |θ̈| against the lower of the two,
    /// but for the time-optimal ones ([`optimal`](super::optimal)), which know both.
    pub deceleration: Option<f64>,
    /// |d³θ/dt³| inside the move, rad/s³. The jumps of acceleration that a cubic or a trapezoid
    /// makes have no finite jerk: with this limit they are refused.
    pub jerk: Option<f64>,
    /// |τ| at the hub, N m.
    pub torque: Option<f64>,
    /// |M|, bending moment at the clamp, N m.
    pub moment: Option<f64>,
}

/// Greatest magnitudes over a move.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Peaks {
    /// |θ̇|, rad/s.
    pub rate: f64,
    /// |θ̈|, rad/s².
    pub acceleration: f64,
    /// |d³θ/dt³|, rad/s³; infinite where the acceleration jumps.
    pub jerk: f64,
}

impl Limits {
    /// The limits themselves if each is positive and finite.
    pub fn validate(self) -> Result<Self, Error> {
        let check = |parameter, value: Option<f64>, unit| match value {
            Some(value) => Error::check(parameter, value, 1e-9, 1e12, unit).map(drop),
            None => Ok(()),
        };
        check("limits.rate", self.rate, "rad/s")?;
        check("limits.acceleration", self.acceleration, "rad/s^2")?;
        check("limits.deceleration", self.deceleration, "rad/s^2")?;
        check("limits.jerk", self.jerk, "rad/s^3")?;
        check("limits.torque", self.torque, "N m")?;
        check("limits.moment", self.moment, "N m")?;
        Ok(self)
    }

    /// The limits of the hub's motion alone: rate, acceleration, deceleration and jerk.
    #[must_use]
    pub fn kinematic(self) -> Self {
        Self { torque: None, moment: None, ..self }
    }

    /// The limits themselves if none of them depends on the arm.
    pub(crate) fn of_motion(self) -> Result<Self, Error> {
        let absent = |parameter, limit: Option<f64>| match limit {
            Some(value) => Err(Error::CannotCheck { parameter, value, unit: "N m" }),
            None => Ok(()),
        };
        absent("limits.torque", self.torque)?;
        absent("limits.moment", self.moment)?;
        Ok(self)
    }

    /// Refuses limits of which none is of the hub's motion: nothing then tells how long a move
    /// takes.
    pub(crate) fn any_of_motion(&self) -> Result<(), Error> {
        let given = [self.rate, self.acceleration, self.deceleration, self.jerk];
        if given.iter().any(Option::is_some) {
            return Ok(());
        }
        Error::check("limits.acceleration", f64::INFINITY, 1e-9, 1e12, "rad/s^2").map(drop)
    }

    /// The limits of a hub that only slows down: the deceleration's in place of the acceleration's.
    pub(crate) fn of_slowing(self) -> Self {
        let acceleration = if self.deceleration.is_some() { None } else { self.acceleration };
        Self { acceleration, ..self }
    }

    /// The limits of a hub that only speeds up.
    pub(crate) fn of_speeding(self) -> Self {
        Self { deceleration: None, ..self }
    }

    /// Refuses peaks of the hub's motion above a limit of rate, acceleration, deceleration or jerk,
    /// with 1e-9 of it for rounding. The greatest acceleration is taken for one of either kind.
    pub fn admit(&self, peaks: &Peaks) -> Result<(), Error> {
        within("limits.rate", self.rate, peaks.rate, "rad/s")?;
        within("limits.acceleration", self.acceleration, peaks.acceleration, "rad/s^2")?;
        within("limits.deceleration", self.deceleration, peaks.acceleration, "rad/s^2")?;
        within("limits.jerk", self.jerk, peaks.jerk, "rad/s^3")
    }

    /// Refuses a torque (N m) above the limit.
    pub fn admit_torque(&self, torque: f64) -> Result<(), Error> {
        within("limits.torque", self.torque, torque, "N m")
    }

    /// Refuses a bending moment at the clamp (N m) above the limit.
    pub fn admit_moment(&self, moment: f64) -> Result<(), Error> {
        within("limits.moment", self.moment, moment, "N m")
    }
}

fn within(
    parameter: &'static str,
    limit: Option<f64>,
    needed: f64,
    unit: &'static str,
) -> Result<(), Error> {
    match limit {
        Some(limit) if needed.is_nan() || needed > limit * (1.0 + 1e-9) => {
            Err(Error::LimitExceeded { parameter, limit, needed, unit })
        }
        _ => Ok(()),
    }
}

words! {
    [] Limits: rate, acceleration, deceleration, jerk, torque, moment;
}
