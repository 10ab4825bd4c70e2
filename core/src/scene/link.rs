//! The link's scale: length, mass and stiffness.

use crate::Error;
use crate::material::{Material, Strip};
use crate::math::{Scalar, words};

/// A link in cubic Bernoulli-Euler bending in the plane of motion, described as a uniform one.
///
/// Where the scene's [shape](super::LinkShape) varies along the link, these are its scale: `mass`
/// is that of all sections, and `bending_stiffness` that of the uniform link that a force at the
/// tip bends as far.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Link<T = f64> {
    /// `L`, clamp to tip, m.
    pub length: T,
    /// `m`, whole link without the masses that are mounted on it, kg.
    pub mass: T,
    /// `EI`, N m².
    pub bending_stiffness: T,
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
    pub(super) fn validate(self) -> Result<Self, Error> {
        Error::check("link.length", self.length, 1e-3, 1e3, "m")?;
        Error::check("link.mass", self.mass, 1e-7, 1e5, "kg")?;
        Error::check("link.bending_stiffness", self.bending_stiffness, 1e-9, 1e12, "N m^2")?;
        Ok(self)
    }
}

words! {
    [] Link<f64>: length, mass, bending_stiffness;
}
