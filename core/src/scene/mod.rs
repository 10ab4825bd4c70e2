//! The arm as its user describes it: SI units, validated. Every number a user can get wrong in an
//! arm is checked here, before any matrix is built.

mod cross_section;
mod hub;
mod link;
mod mount;
mod piece;
mod section;
mod shape;
mod varied;

pub use cross_section::CrossSection;
pub use hub::{Damping, Hub, Payload};
pub use link::Link;
pub use mount::{AxisKind, Mount};
pub(crate) use piece::{Piece, Point};
pub use section::Section;
pub use shape::{LinkShape, Uniform};
pub use varied::{MAX_MASSES, MAX_SECTIONS, PointMass, Varied};

use crate::Error;
use crate::hub::GravityDirection;
use crate::math::{Scalar, Words, named, words};

/// An arm: a link clamped to a motor hub, with a payload at its tip.
///
/// The hub frame turns with the hub angle θ; its x axis lies along the undeformed link, the clamp
/// at `(hub.radius, 0)`. Gravity acts along global −Y.
///
/// Fields are public so that a scene reads like its file; [`Scene::validate`] is called wherever a
/// model is built from it.
///
/// A model computes in the precision of its scene. `f64` is for every model; `f32`, on a processor
/// without a double-precision unit, makes the set-up of a small one a tenth as long.
///
/// `Scene` is for any link, [`UniformScene`] for uniform ones: a program that names no other holds
/// neither memory nor code for sections. Both give the same bits for the same uniform link.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Scene<T = f64, S = Varied> {
    /// The flexible link.
    pub link: Link<T>,
    /// Distribution of stiffness and mass along it.
    pub shape: S,
    /// The rigid hub, and the joint between it and the link.
    pub hub: Hub<T>,
    /// The mass at the tip.
    pub payload: Payload<T>,
    /// Damping of link and joint.
    pub damping: Damping<T>,
    /// Gravity, m/s²; 0 is a horizontal plane. Along global −Y, but for what `mount` says.
    pub gravity: T,
    /// The mounting: kind of the axis, tilt of the plane of motion, direction of gravity in it.
    #[cfg_attr(feature = "serde", serde(default))]
    pub mount: Mount<T>,
}

/// An arm with a uniform link, of the type that holds no memory and no code for any other.
pub type UniformScene<T = f64> = Scene<T, Uniform>;

impl<S: LinkShape> Scene<f64, S> {
    /// The scene rounded to another precision; shares and positions of its shape stay as they are.
    // Not inlined: the compiler would take the comparisons of `validate` back to f64, which costs
    // 0.5 kB of code where that is soft.
    #[inline(never)]
    pub fn cast<T: Scalar>(&self) -> Scene<T, S> {
        let f = T::from_f64;
        let Self { link, shape, hub, payload, damping, gravity, mount } = *self;
        Scene {
            link: Link {
                length: f(link.length),
                mass: f(link.mass),
                bending_stiffness: f(link.bending_stiffness),
            },
            shape,
            hub: Hub {
                radius: f(hub.radius),
                inertia: f(hub.inertia),
                stiffness: hub.stiffness.map(f),
            },
            payload: Payload {
                mass: f(payload.mass),
                inertia: f(payload.inertia),
                offset: f(payload.offset),
            },
            damping: Damping {
                alpha: f(damping.alpha),
                beta: f(damping.beta),
                joint: f(damping.joint),
            },
            gravity: f(gravity),
            mount: mount.cast(),
        }
    }
}

impl Scene {
    /// A bare arm whose link has these sections, from the clamp to the tip, in the horizontal
    /// plane, undamped.
    ///
    /// # Errors
    /// No section, or more than [`MAX_SECTIONS`].
    pub fn of_sections(sections: &[Section]) -> Result<Self, Error> {
        let (link, shape) = Varied::of_sections(sections)?;
        Ok(Self { shape, ..Self::new(link) })
    }

    /// The scene with a point mass mounted on its link.
    ///
    /// # Errors
    /// A position outside the link, a negative mass, or more than [`MAX_MASSES`].
    pub fn with_mass(self, mass: PointMass) -> Result<Self, Error> {
        Ok(Self { shape: self.shape.with_mass(self.link.length, mass)?, ..self })
    }
}

impl<T: Scalar> Scene<T> {
    /// A bare uniform link in the horizontal plane, clamped at the axis, undamped.
    pub const fn new(link: Link<T>) -> Self {
        Self::bare(link, Varied::UNIFORM)
    }
}

impl<T: Scalar> Scene<T> {
    /// The same arm as a [`UniformScene`], if its link is uniform.
    pub fn to_uniform(&self) -> Option<UniformScene<T>> {
        self.shape.is_uniform().then(|| self.shaped(Uniform))
    }
}

impl<T: Scalar> Scene<T, Uniform> {
    /// The result of [`Scene::new`], of the type that is for uniform links only.
    pub const fn uniform(link: Link<T>) -> Self {
        Self::bare(link, Uniform)
    }
}

impl<T: Scalar> From<Scene<T, Uniform>> for Scene<T> {
    fn from(scene: Scene<T, Uniform>) -> Self {
        scene.shaped(Varied::UNIFORM)
    }
}

impl<T: Scalar, S: LinkShape> Scene<T, S> {
    const fn bare(link: Link<T>, shape: S) -> Self {
        let zero = T::ZERO;
        Self {
            link,
            shape,
            hub: Hub { radius: zero, inertia: zero, stiffness: None },
            payload: Payload { mass: zero, inertia: zero, offset: zero },
            damping: Damping { alpha: zero, beta: zero, joint: zero },
            gravity: zero,
            mount: Mount::ROTARY,
        }
    }

    /// The scene with another distribution along its link.
    pub(crate) fn shaped<Q: LinkShape>(&self, shape: Q) -> Scene<T, Q> {
        let Self { link, hub, payload, damping, gravity, mount, .. } = *self;
        Scene { link, shape, hub, payload, damping, gravity, mount }
    }

    /// The arm with every stiffness, of link and joint, multiplied by `factor`: its frequencies are
    /// multiplied by the square root.
    #[must_use]
    pub fn stiffened(mut self, factor: T) -> Self {
        self.link.bending_stiffness = self.link.bending_stiffness * factor;
        self.hub.stiffness = self.hub.stiffness.map(|stiffness| stiffness * factor);
        self
    }

    /// The scene itself if every field is finite and in range, else the first that is not.
    pub fn validate(self) -> Result<Self, Error> {
        self.link.validate()?;
        if let Some(varied) = self.shape.varied() {
            varied.validate()?;
        }
        self.hub.validate(self.mount.axis)?;
        Error::check("payload.mass", self.payload.mass, 0.0, 1e5, "kg")?;
        // A radius of gyration of ten lengths. Far beyond it, the mass of what turns hides the mass
        // of what moves from an f32.
        let mass = self.link.mass + self.payload.mass;
        let square = self.link.length * self.link.length;
        let most = (T::from_f64(100.0) * mass * square).to_f64().min(1e6);
        Error::check("payload.inertia", self.payload.inertia, 0.0, most, "kg m^2")?;
        let length = self.link.length.to_f64();
        Error::check("payload.offset", self.payload.offset, 0.0, 10.0 * length, "m")?;
        self.damping.validate()?;
        Error::check("gravity.acceleration", self.gravity, 0.0, 1e3, "m/s^2")?;
        self.mount.validate()?;
        self.check_carrier()?;
        Ok(self)
    }

    /// Refuses a carrier that turns with a linear axis, with gravity in the plane of motion or with
    /// drag on absolute velocity: see [`Mount::carrier`].
    fn check_carrier(&self) -> Result<(), Error> {
        if self.mount.carrier == T::ZERO {
            return Ok(());
        }
        if self.mount.is_linear() {
            return self.check_no_carrier();
        }
        Error::check(
            "damping.alpha",
            self.damping.alpha,
            0.0,
            0.0,
            "1/s with a carrier that turns",
        )?;
        let gravity = self.in_plane_gravity();
        let unit = "m/s^2 in the plane of motion with a carrier that turns";
        Error::check("gravity.acceleration", gravity, 0.0, 0.0, unit)?;
        Ok(())
    }

    /// Refuses a carrier that turns: of a model that does not know of it.
    #[inline(never)]
    pub(crate) fn check_no_carrier(&self) -> Result<(), Error> {
        let unit = "rad/s here, which is for a carrier that rests";
        Error::check("carrier.rate", self.mount.carrier, 0.0, 0.0, unit).map(drop)
    }

    /// `m/L`, mean mass per length, kg/m; `ρA` of a uniform link.
    pub fn mass_per_length(&self) -> T {
        self.link.mass / self.link.length
    }

    /// `r + L`, axis to tip of the undeformed arm, m.
    pub fn reach(&self) -> T {
        self.hub.radius + self.link.length
    }

    /// `r + L + d`, axis to the payload's centre on the undeformed arm, m.
    pub fn payload_reach(&self) -> T {
        self.reach() + self.payload.offset
    }

    /// Mass of the link with what is mounted on it, kg, its first moment (kg m) and its second
    /// (kg m²) about the clamp.
    pub fn link_moments(&self) -> [T; 3] {
        let (m, l) = (self.link.mass, self.link.length);
        match self.shape.varied() {
            None => [m, m * (T::HALF * l), m * (l * l / T::from_f64(3.0))],
            Some(varied) => {
                varied.mass_beyond(0.0, m.to_f64(), l.to_f64()).map(|moment| T::from_f64(moment))
            }
        }
    }

    /// Mass of link and payload, kg.
    pub fn moved_mass(&self) -> T {
        let [link, _, _] = self.link_moments();
        link + self.payload.mass
    }

    /// Gravity in the plane of motion, `g cos(tilt)`, m/s².
    // Not inlined, as the next two: set-up asks several times, and has time.
    #[inline(never)]
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
    /// About the axis of a hub that turns, `J_r = ∫(r+x)² dm + m_p(r+L+d)² + J_p`, kg m². On a
    /// linear axis their mass, kg.
    pub fn rigid_inertia(&self) -> T {
        if self.mount.is_linear() {
            return self.moved_mass();
        }
        let (r, l, reach) = (self.hub.radius, self.link.length, self.payload_reach());
        let link = if self.shape.varied().is_none() {
            self.link.mass * (r * r + r * l + l * l / T::from_f64(3.0))
        } else {
            let [mass, first, second] = self.link_moments();
            mass * r * r + T::TWO * r * first + second
        };
        link + self.payload.mass * reach * reach + self.payload.inertia
    }

    /// Factor of `g cos χ` in what holds the undeformed arm against gravity.
    ///
    /// On a hub that turns, and is balanced itself, the first moment of mass about the axis,
    /// `S = ∫(r+x) dm + m_p(r+L+d)`, kg m. On a linear axis the whole mass, the carriage's
    /// included, kg.
    pub fn first_moment(&self) -> T {
        if self.mount.is_linear() {
            return self.moved_mass() + self.hub.inertia;
        }
        let link = if self.shape.varied().is_none() {
            self.link.mass * (self.hub.radius + T::HALF * self.link.length)
        } else {
            let [mass, first, _] = self.link_moments();
            mass * self.hub.radius + first
        };
        link + self.payload.mass * self.payload_reach()
    }
}

impl Words for Uniform {
    const LAYOUT: u32 = named("Uniform");
    const BLANK: Self = Self;

    fn put(&self, _: &mut dyn FnMut(u32)) {}

    fn fill(&mut self, _: &mut dyn FnMut() -> u32) {}
}

words! {
    [] Scene<f64, Uniform>: link, shape, hub, payload, damping, gravity, mount;
}
