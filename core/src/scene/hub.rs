//! The mount that the link is clamped to, and its payload.

use super::AxisKind;
use crate::Error;
use crate::math::{Scalar, words};

/// The motor hub, and the joint between it and the link.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hub<T = f64> {
    /// `r`, motor axis to clamp, rigid, m.
    pub radius: T,
    /// `J_h` about the axis, kg m². On a linear axis the carriage's mass `m_c`, kg.
    pub inertia: T,
    /// `k` of the joint between hub and link, N m/rad: under a clamp moment `M` the root of the
    /// link turns by `M/k`. `None` is a clamp that does not give.
    pub stiffness: Option<T>,
}

/// The payload at the tip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Payload<T = f64> {
    /// `m_p`, kg.
    pub mass: T,
    /// `J_p` about the payload's own centre of mass, kg m²; up to 100 (m + m_p) L².
    pub inertia: T,
    /// `d`, from the tip of the link to the payload's centre of mass along the link's tangent, m;
    /// up to 10 L.
    pub offset: T,
}

/// Damping. Rayleigh's, `C = αM + βK`: α on absolute velocity, β on the deformation rate of link
/// and joint. And the joint's own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Damping<T = f64> {
    /// α, 1/s.
    pub alpha: T,
    /// β, s.
    pub beta: T,
    /// `β_J` of the joint alone, s: the moment of the joint is `k (φ₀ + (β + β_J) φ̇₀)` for a root
    /// angle `φ₀`. [`Damping::joint_of_ratio`] takes it from a damping ratio. Of no effect on a
    /// link that is clamped without give.
    pub joint: T,
}

impl Damping {
    /// `β_J = 2ζ/ω` of a joint that, as the only spring of a vibration at `omega` rad/s, would damp
    /// it with the ratio `ζ`. In a mode of the arm at that frequency the joint's share of the
    /// strain energy times `ζ` is left of it. For a measured ratio take `omega` as the arm's first
    /// angular frequency.
    pub fn joint_of_ratio(ratio: f64, omega: f64) -> f64 {
        2.0 * ratio / omega
    }
}

impl<T: Scalar> Hub<T> {
    pub(super) fn validate(&self, axis: AxisKind) -> Result<(), Error> {
        Error::check("hub.radius", self.radius, 0.0, 1e3, "m")?;
        match axis {
            AxisKind::Rotary => Error::check("hub.inertia", self.inertia, 0.0, 1e6, "kg m^2")?,
            AxisKind::Linear => Error::check("hub.mass", self.inertia, 0.0, 1e6, "kg")?,
        };
        if let Some(stiffness) = self.stiffness {
            Error::check("hub.stiffness", stiffness, 1e-9, 1e15, "N m/rad")?;
        }
        Ok(())
    }

    /// `1/k`, rad/(N m): 0 of a clamp that does not give.
    pub(crate) fn compliance(&self) -> T {
        self.stiffness.map_or(T::ZERO, |stiffness| T::ONE / stiffness)
    }
}

impl<T: Scalar> Damping<T> {
    pub(super) fn validate(&self) -> Result<(), Error> {
        Error::check("damping.alpha", self.alpha, 0.0, 1e3, "1/s")?;
        Error::check("damping.beta", self.beta, 0.0, 1.0, "s")?;
        Error::check("damping.joint", self.joint, 0.0, 1e3, "s")?;
        Ok(())
    }

    /// True if nothing is damped.
    pub fn is_zero(&self) -> bool {
        self.alpha == T::ZERO && self.beta == T::ZERO && self.joint == T::ZERO
    }
}

words! {
    [] Hub<f64>: radius, inertia, stiffness;
    [] Payload<f64>: mass, inertia, offset;
    [] Damping<f64>: alpha, beta, joint;
}
