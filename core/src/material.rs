//! A small table of link materials, and the strip's cross-section.

use crate::Error;

/// A link material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Name in scene files.
    pub name: &'static str,
    /// Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Density, kg/m³.
    pub density: f64,
}

/// Materials known by name.
///
/// Acrylic and aluminium are the paper's own (Table 1: modulus as printed, density from mass over
/// volume); the others are typical handbook values at room temperature, good to some 5 %: where it
/// matters, measure the first period and give `bending_stiffness`.
pub const MATERIALS: [Material; 7] = [
    Material { name: "acrylic", youngs_modulus: 3.2e9, density: 1190.0 },
    Material { name: "aluminium", youngs_modulus: 69.0e9, density: 2800.0 },
    Material { name: "steel", youngs_modulus: 200.0e9, density: 7850.0 },
    Material { name: "stainless-steel", youngs_modulus: 193.0e9, density: 8000.0 },
    Material { name: "titanium", youngs_modulus: 114.0e9, density: 4430.0 },
    Material { name: "glass-epoxy", youngs_modulus: 24.0e9, density: 1850.0 },
    Material { name: "carbon-epoxy", youngs_modulus: 120.0e9, density: 1600.0 },
];

impl Material {
    /// The material of that name in [`MATERIALS`].
    pub fn named(name: &str) -> Option<&'static Self> {
        MATERIALS.iter().find(|material| material.name == name)
    }
}

/// A rectangular cross-section that bends about its thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// Size across the plane of motion, m.
    pub width: f64,
    /// Size in the plane of motion, m.
    pub thickness: f64,
}

impl Strip {
    /// `A = w t`, m².
    pub fn area(&self) -> f64 {
        self.width * self.thickness
    }

    /// `I = w t³/12`, m⁴.
    pub fn second_moment(&self) -> f64 {
        self.width * self.thickness * self.thickness * self.thickness / 12.0
    }

    /// The strip itself if both sides are in range.
    pub fn validate(self) -> Result<Self, Error> {
        Error::check("link.width", self.width, 1e-6, 10.0, "m")?;
        Error::check("link.thickness", self.thickness, 1e-6, 10.0, "m")?;
        Ok(self)
    }
}
