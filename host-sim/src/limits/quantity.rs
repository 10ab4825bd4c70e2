//! The quantities that a drive limits.

use stillbeam::Limits;

/// A quantity that a drive limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Hub rate.
    Rate,
    /// Hub rate again, held against one radian a tick.
    Turn,
    /// Hub acceleration; of a hub that speeds up, if the deceleration has a limit of its own.
    Acceleration,
    /// Hub acceleration of a hub that slows down.
    Deceleration,
    /// Hub jerk.
    Jerk,
    /// Hub torque.
    Torque,
    /// Bending moment at the clamp.
    Moment,
}

impl Quantity {
    /// Quantities of the hub's motion alone.
    pub const KINEMATIC: [Self; 5] =
        [Self::Rate, Self::Turn, Self::Acceleration, Self::Deceleration, Self::Jerk];

    /// Returns the quantity's field of a scene file.
    pub fn parameter(self) -> &'static str {
        match self {
            Self::Rate => "limits.rate",
            Self::Turn => "solver.tick",
            Self::Acceleration => "limits.acceleration",
            Self::Deceleration => "limits.deceleration",
            Self::Jerk => "limits.jerk",
            Self::Torque => "limits.torque",
            Self::Moment => "limits.moment",
        }
    }

    /// Returns the unit of the quantity.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Rate | Self::Turn => "rad/s",
            Self::Acceleration | Self::Deceleration => "rad/s^2",
            Self::Jerk => "rad/s^3",
            Self::Torque | Self::Moment => "N m",
        }
    }

    /// Returns the limit, or `None` without one. `tick` in s.
    pub fn limit(self, limits: &Limits, tick: f64) -> Option<f64> {
        match self {
            Self::Rate => limits.rate,
            Self::Turn => Some(1.0 / tick),
            Self::Acceleration => limits.acceleration,
            Self::Deceleration => limits.deceleration,
            Self::Jerk => limits.jerk,
            Self::Torque => limits.torque,
            Self::Moment => limits.moment,
        }
    }

    /// Returns the limit's field, to be changed.
    pub fn of_mut(self, limits: &mut Limits) -> Option<&mut f64> {
        match self {
            Self::Rate => limits.rate.as_mut(),
            Self::Turn => None,
            Self::Acceleration => limits.acceleration.as_mut(),
            Self::Deceleration => limits.deceleration.as_mut(),
            Self::Jerk => limits.jerk.as_mut(),
            Self::Torque => limits.torque.as_mut(),
            Self::Moment => limits.moment.as_mut(),
        }
    }

    /// Returns the factor by which a move must be longer if it exceeds its limit `ratio` times. The
    /// move keeps its shape: rates fall with 1/T, accelerations and loads with 1/T², jerks with
    /// 1/T³.
    pub fn stretch(self, ratio: f64) -> f64 {
        match self {
            Self::Rate | Self::Turn => ratio,
            Self::Acceleration | Self::Deceleration | Self::Torque | Self::Moment => ratio.sqrt(),
            Self::Jerk => ratio.cbrt(),
        }
    }
}
