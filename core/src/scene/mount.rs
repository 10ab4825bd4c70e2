//! The mounting of an arm: the kind of its axis, and how axis and plane of motion lie.

use core::f64::consts::{FRAC_PI_2, TAU};

use crate::Error;
use crate::math::{Scalar, Words, named, read, words};

/// Kind of the axis that moves the hub.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "lowercase")
)]
pub enum AxisKind {
    /// The hub turns about the axis.
    #[default]
    Rotary,
    /// The hub is a carriage that moves along the hub frame's y axis, across the link, and does not
    /// turn.
    ///
    /// In numbers a metre takes the place of a radian: an [`Angle`](crate::Angle) of one turn is a
    /// position of 2π m, a rate is a velocity in m/s, an acceleration is in m/s², and a torque is
    /// the force on the carriage along the axis, N. Moves, profiles, limits and shapers need no
    /// other code then, and a position resolves to 2e-7 m in f32. Only its sine and cosine mean
    /// nothing. [`Hub::inertia`](super::Hub::inertia) is the carriage's own mass, kg.
    Linear,
}

/// How the arm is mounted. The default is a hub that turns about a fixed axis, with gravity, if
/// there is any, in the plane of motion along global −Y.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
pub struct Mount<T = f64> {
    /// The kind of the axis.
    pub axis: AxisKind,
    /// Lean of the plane of motion from the vertical, rad, 0 to π/2. Gravity acts in the plane with
    /// `g cos(tilt)`; at π/2 the plane is horizontal.
    pub tilt: T,
    /// δ, angle in the plane by which gravity is turned from global −Y, counter-clockwise, rad, −2π
    /// to 2π. On a linear axis 0 is gravity along the axis, across the link; π/2 is a link that
    /// hangs from its carriage, −π/2 one that stands on it.
    pub direction: T,
    /// Ω, rate of a carrier that turns evenly about the hub's own axis and bears the motor, rad/s,
    /// −1000 to 1000. The hub's motion is relative to it. Not with a linear axis, gravity in the
    /// plane of motion, whose direction would turn, or α, whose drag would bend the arm at rest.
    /// Steppers for such a scene are set up by
    /// [`OnCarrier`](crate::stepper::OnCarrier).
    pub carrier: T,
}

impl<T: Scalar> Mount<T> {
    /// A hub that turns about an axis, its plane of motion not tilted, gravity along global −Y.
    pub const ROTARY: Self =
        Self { axis: AxisKind::Rotary, tilt: T::ZERO, direction: T::ZERO, carrier: T::ZERO };

    /// A carriage on a linear axis, gravity along the axis.
    pub const LINEAR: Self = Self { axis: AxisKind::Linear, ..Self::ROTARY };

    /// The mount itself if every field is in range.
    pub(super) fn validate(self) -> Result<Self, Error> {
        Error::check("gravity.tilt", self.tilt, 0.0, FRAC_PI_2, "rad")?;
        Error::check("gravity.direction", self.direction, -TAU, TAU, "rad")?;
        Error::check("carrier.rate", self.carrier, -1e3, 1e3, "rad/s")?;
        Ok(self)
    }

    /// True if the hub is a carriage on a linear axis.
    pub fn is_linear(&self) -> bool {
        self.axis == AxisKind::Linear
    }
}

impl Mount {
    /// Rounds to another precision.
    pub(super) fn cast<T: Scalar>(&self) -> Mount<T> {
        let f = T::from_f64;
        Mount {
            axis: self.axis,
            tilt: f(self.tilt),
            direction: f(self.direction),
            carrier: f(self.carrier),
        }
    }
}

impl Words for AxisKind {
    const LAYOUT: u32 = named("AxisKind");
    const BLANK: Self = Self::Rotary;

    fn put(&self, sink: &mut dyn FnMut(u32)) {
        (*self == Self::Linear).put(sink);
    }

    fn fill(&mut self, source: &mut dyn FnMut() -> u32) {
        *self = if read(source) { Self::Linear } else { Self::Rotary };
    }
}

words! {
    [] Mount: axis, tilt, direction, carrier;
}
