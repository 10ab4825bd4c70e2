//! Material of a link or a section.

use stillbeam::material::{MATERIALS, Material};

use super::link::clash;
use crate::error::Error;

/// Young's modulus and density, as far as a file gives them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Matter {
    /// Pa.
    pub modulus: Option<f64>,
    /// kg/m³.
    pub density: Option<f64>,
}

impl Matter {
    /// Reads the keys `material`, `youngs_modulus` and `density` of the table at `place`. A
    /// material gives both numbers; one's own material is the two of them.
    pub fn of(
        place: &str,
        material: Option<&str>,
        modulus: Option<f64>,
        density: Option<f64>,
    ) -> Result<Self, Error> {
        let numbers = [
            ("youngs_modulus", modulus, 1e3, 1e13, "Pa"),
            ("density", density, 1.0, 1e5, "kg/m^3"),
        ];
        for (key, value, least, most, unit) in numbers {
            if let Some(value) = value.filter(|value| !(least..=most).contains(value)) {
                return Err(Error::new(format_args!(
                    "{place}.{key} = {value}: must be {least} to {most} {unit}"
                )));
            }
        }
        let Some(name) = material else { return Ok(Self { modulus, density }) };
        let material = named(place, name)?;
        for (key, value, ..) in numbers {
            if value.is_some() {
                return Err(clash(&format!("{place}.{key}"), "material", material.name));
            }
        }
        Ok(Self { modulus: Some(material.youngs_modulus), density: Some(material.density) })
    }

    /// Returns the material, or an error if a number is absent.
    pub fn complete(self, place: &str) -> Result<Material, Error> {
        let missing = |key: &str, whole: &str| {
            Error::new(format_args!(
                "{place}.{key}: missing; must be given, or a material, or else link.{whole} and none \
                 of the sections\u{2019} own"
            ))
        };
        Ok(Material {
            name: "",
            youngs_modulus: self
                .modulus
                .ok_or_else(|| missing("youngs_modulus", "bending_stiffness or link.frequency"))?,
            density: self.density.ok_or_else(|| missing("density", "mass"))?,
        })
    }

    /// Takes what is absent from another.
    pub fn or(self, other: Self) -> Self {
        Self { modulus: self.modulus.or(other.modulus), density: self.density.or(other.density) }
    }
}

fn named(place: &str, name: &str) -> Result<&'static Material, Error> {
    Material::named(name).ok_or_else(|| {
        let known = MATERIALS.map(|material| material.name).join(", ");
        Error::new(format_args!(
            "{place}.material = \"{name}\": must be one of {known}; of another material give \
             youngs_modulus and density"
        ))
    })
}
