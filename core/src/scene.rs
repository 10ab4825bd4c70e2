//! The arm as its user describes it: SI units, validated. Every number a user can get wrong in an
//! arm is checked here, before any matrix is built.

mod mount;

pub use mount::{AxisKind, Mount};

use crate::Error;
use crate::hub::GravityDirection;
use crate::material::{Material, Strip};
use crate::math::Scalar;

/// An arm: a strip clamped to a motor hub, with a payload at its tip.
///
/// The hub frame turns with the hub angle θ; its x axis lies along the undeformed link, the clamp
/// at `(hub.radius, 0)`. Gravity acts along global −Y.
///
/// Fields are public so that a scene reads like its file; [`Scene::validate`] is called wherever a
/// model is built from it.
///
/// A model computes in the precision of its scene. `f64` is for every model; `f32`, on a processor
/// without a double-precision unit, makes the set-up of a small one a tenth as long.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Scene<T = f64> {
    /// The flexible link.
    pub link: Link<T>,
    /// The rigid hub.
    pub hub: Hub<T>,
    /// The mass at the tip.
    pub payload: Payload<T>,
    /// Rayleigh damping.
    pub damping: Damping<T>,
    /// Gravity, m/s²; 0 is a horizontal plane. Along global −Y, but for what `mount` says.
    pub gravity: T,
    /// The mounting: kind of the axis, tilt of the plane of motion, direction of gravity in it.
    #[cfg_attr(feature = "serde", serde(default))]
    pub mount: Mount<T>,
}

/// A uniform link: cubic Bernoulli-Euler bending in the plane of motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Link<T = f64> {
    /// `L`, clamp to tip, m.
    pub length: T,
    /// `m`, whole link, kg.
    pub mass: T,
    /// `EI`, N m².
    pub bending_stiffness: T,
}

/// The motor hub.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hub<T = f64> {
    /// `r`, motor axis to clamp, rigid, m.
    pub radius: T,
    /// `J_h` about the axis, kg m². On a linear axis the carriage's mass `m_c`, kg.
    pub inertia: T,
}

/// The payload at the tip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Payload<T = f64> {
    /// `m_p`, kg.
    pub mass: T,
    /// `J_p` about the tip, kg m²; up to 100 (m + m_p) L².
    pub inertia: T,
}

/// Rayleigh damping `C = αM + βK`: α on absolute velocity, β on the deformation rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Damping<T = f64> {
    /// α, 1/s.
    pub alpha: T,
    /// β, s.
    pub beta: T,
}

impl Link {
    /// Stiffness from Young's modulus `E` (Pa) and second moment of area `I` (m⁴): `EI = E · I`.
    pub fn from_section(
        length: f64,
        mass: f64,
        youngs_modulus: f64,
        second_moment: f64,
    ) -> Result<Self, Error> {
        let e = Error::check("link.youngs_modulus", youngs_modulus, 1e3, 1e13, "Pa")?;
        let i = Error::check("link.second_moment", second_moment, 1e-20, 1.0, "m^4")?;
        Self { length, mass, bending_stiffness: e * i }.validate()
    }

    /// A strip of a tabulated material, bending about its thickness: `EI = E w t³/12`,
    /// `m = ρ w t L`.
    pub fn from_material(length: f64, material: &Material, strip: Strip) -> Result<Self, Error> {
        let strip = strip.validate()?;
        Self {
            length,
            mass: material.density * strip.area() * length,
            bending_stiffness: material.youngs_modulus * strip.second_moment(),
        }
        .validate()
    }
}

impl<T: Scalar> Link<T> {
    fn validate(self) -> Result<Self, Error> {
        Error::check("link.length", self.length, 1e-3, 1e3, "m")?;
        Error::check("link.mass", self.mass, 1e-7, 1e5, "kg")?;
        Error::check("link.bending_stiffness", self.bending_stiffness, 1e-9, 1e12, "N m^2")?;
        Ok(self)
    }
}

impl Scene {
    /// The scene rounded to another precision.
    // Not inlined: the compiler would take the comparisons of `validate` back to f64, which costs
    // 0.5 kB of code where that is soft.
    #[inline(never)]
    pub fn cast<T: Scalar>(&self) -> Scene<T> {
        let f = T::from_f64;
        let Self { link, hub, payload, damping, gravity, mount } = *self;
        Scene {
            link: Link {
                length: f(link.length),
                mass: f(link.mass),
                bending_stiffness: f(link.bending_stiffness),
            },
            hub: Hub { radius: f(hub.radius), inertia: f(hub.inertia) },
            payload: Payload { mass: f(payload.mass), inertia: f(payload.inertia) },
            damping: Damping { alpha: f(damping.alpha), beta: f(damping.beta) },
            gravity: f(gravity),
            mount: mount.cast(),
        }
    }
}

impl<T: Scalar> Scene<T> {
    /// A bare link in the horizontal plane, clamped at the axis, undamped.
    pub const fn new(link: Link<T>) -> Self {
        Self {
            link,
            hub: Hub { radius: T::ZERO, inertia: T::ZERO },
            payload: Payload { mass: T::ZERO, inertia: T::ZERO },
            damping: Damping { alpha: T::ZERO, beta: T::ZERO },
            gravity: T::ZERO,
            mount: Mount::ROTARY,
        }
    }

    /// The scene itself if every field is finite and in range, else the first that is not.
    pub fn validate(self) -> Result<Self, Error> {
        self.link.validate()?;
        Error::check("hub.radius", self.hub.radius, 0.0, 1e3, "m")?;
        match self.mount.axis {
            AxisKind::Rotary => Error::check("hub.inertia", self.hub.inertia, 0.0, 1e6, "kg m^2")?,
            AxisKind::Linear => Error::check("hub.mass", self.hub.inertia, 0.0, 1e6, "kg")?,
        };
        Error::check("payload.mass", self.payload.mass, 0.0, 1e5, "kg")?;
        // A radius of gyration of ten lengths. Far beyond it, the mass of what turns hides the mass
        // of what moves from an f32.
        let mass = self.moved_mass();
        let square = self.link.length * self.link.length;
        let most = (T::from_f64(100.0) * mass * square).to_f64().min(1e6);
        Error::check("payload.inertia", self.payload.inertia, 0.0, most, "kg m^2")?;
        Error::check("damping.alpha", self.damping.alpha, 0.0, 1e3, "1/s")?;
        Error::check("damping.beta", self.damping.beta, 0.0, 1.0, "s")?;
        Error::check("gravity.acceleration", self.gravity, 0.0, 1e3, "m/s^2")?;
        self.mount.validate()?;
        Ok(self)
    }

    /// `ρA = m/L`, mass per length, kg/m.
    pub fn mass_per_length(&self) -> T {
        self.link.mass / self.link.length
    }

    /// `r + L`, axis to tip of the undeformed arm, m.
    pub fn reach(&self) -> T {
        self.hub.radius + self.link.length
    }

    /// Mass of link and payload, kg.
    pub fn moved_mass(&self) -> T {
        self.link.mass + self.payload.mass
    }

    /// Gravity in the plane of motion, `g cos(tilt)`, m/s².
    pub fn in_plane_gravity(&self) -> T {
        let tilt = self.mount.tilt;
        if tilt == T::ZERO {
            return self.gravity;
        }
        let (_, cos) = T::from_f64(tilt.to_f64() / core::f64::consts::TAU).sin_cos_turns();
        self.gravity * cos
    }

    /// Direction of gravity as the hub frame sees it, in the precision of a tick.
    pub fn gravity_direction<P: Scalar>(&self) -> GravityDirection<P> {
        if self.in_plane_gravity() == T::ZERO {
            return GravityDirection::NONE;
        }
        match self.mount.axis {
            AxisKind::Rotary => GravityDirection::on_turning_hub(self.mount.direction),
            AxisKind::Linear => GravityDirection::on_carriage(self.mount.direction),
        }
    }

    /// Inertia of the undeformed link and payload against the hub's acceleration.
    ///
    /// About the axis of a hub that turns, `J_r = ∫ρA(r+x)² dx + m_p(r+L)² + J_p`, kg m². On a
    /// linear axis their mass, kg.
    pub fn rigid_inertia(&self) -> T {
        if self.mount.is_linear() {
            return self.moved_mass();
        }
        let (r, l, reach) = (self.hub.radius, self.link.length, self.reach());
        self.link.mass * (r * r + r * l + l * l / T::from_f64(3.0))
            + self.payload.mass * reach * reach
            + self.payload.inertia
    }

    /// Factor of `g cos χ` in what holds the undeformed arm against gravity.
    ///
    /// On a hub that turns, and is balanced itself, the first moment of mass about the axis,
    /// `S = ∫ρA(r+x) dx + m_p(r+L)`, kg m. On a linear axis the whole mass, the carriage's
    /// included, kg.
    pub fn first_moment(&self) -> T {
        if self.mount.is_linear() {
            return self.moved_mass() + self.hub.inertia;
        }
        self.link.mass * (self.hub.radius + T::HALF * self.link.length)
            + self.payload.mass * self.reach()
    }
}
