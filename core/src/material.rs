//! A small table of link materials, and the strip's cross-section.

use crate::Error;

/// A link material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Name in scene files.
    pub name: &'static str,
    /// Young's modulus along the link, Pa.
    pub youngs_modulus: f64,
    /// Density, kg/m³.
    pub density: f64,
}

/// Materials known by name, at room temperature.
///
/// | name | values of | source |
/// |---|---|---|
/// | acrylic | the paper's | Kato and Isobe, table 1 |
/// | aluminium | the paper's, density from mass over volume | Kato and Isobe, table 1 |
/// | steel | carbon steel | handbook |
/// | stainless-steel | AISI 304 | handbook |
/// | spring-steel | patented wire, EN 10270-1 | EN 13906-1 |
/// | brass | CuZn37, CW508L | Deutsches Kupferinstitut, data sheet |
/// | titanium | Ti-6Al-4V | handbook |
/// | glass-epoxy | woven laminate, FR4 | handbook |
/// | carbon-epoxy | laminate, all fibres along the link | handbook |
/// | cfrp-tube | pultruded, 60 % fibres along it, flexural | Goodwinds, technical specifications |
/// | pla | printed solid and flat | Ultimaker PLA, data sheet |
/// | petg | moulded, flexural | Eastman Eastar 6763, data sheet |
/// | abs | moulded | INEOS Terluran GP-22, data sheet |
/// | pom | copolymer, extruded | Ensinger TECAFORM AH, data sheet |
/// | nylon | PA 66, extruded, dry | Ensinger TECAMID 66, data sheet |
/// | wood | Sitka spruce along the grain, 12 % moisture | USDA Wood Handbook, table 5-3 |
///
/// An arm's own values differ from these: of metals by some 5 %, of plastics by 20 %, of printed
/// parts, wood and laminates by 30 % and more. Nylon that takes up moisture softens to half, a
/// printed part weighs and bears by its infill, a tube rolled of woven cloth has half the modulus
/// of a pultruded one. Where that matters, weigh the link, measure its first frequency, and give
/// `mass` and `frequency`.
pub const MATERIALS: [Material; 16] = [
    Material { name: "acrylic", youngs_modulus: 3.2e9, density: 1190.0 },
    Material { name: "aluminium", youngs_modulus: 69.0e9, density: 2800.0 },
    Material { name: "steel", youngs_modulus: 200.0e9, density: 7850.0 },
    Material { name: "stainless-steel", youngs_modulus: 193.0e9, density: 8000.0 },
    Material { name: "spring-steel", youngs_modulus: 206.0e9, density: 7850.0 },
    Material { name: "brass", youngs_modulus: 110.0e9, density: 8440.0 },
    Material { name: "titanium", youngs_modulus: 114.0e9, density: 4430.0 },
    Material { name: "glass-epoxy", youngs_modulus: 24.0e9, density: 1850.0 },
    Material { name: "carbon-epoxy", youngs_modulus: 120.0e9, density: 1600.0 },
    Material { name: "cfrp-tube", youngs_modulus: 127.0e9, density: 1500.0 },
    Material { name: "pla", youngs_modulus: 3.25e9, density: 1240.0 },
    Material { name: "petg", youngs_modulus: 2.1e9, density: 1270.0 },
    Material { name: "abs", youngs_modulus: 2.3e9, density: 1040.0 },
    Material { name: "pom", youngs_modulus: 2.8e9, density: 1410.0 },
    Material { name: "nylon", youngs_modulus: 3.5e9, density: 1150.0 },
    Material { name: "wood", youngs_modulus: 10.8e9, density: 450.0 },
];

impl Material {
    /// Finds a material in [`MATERIALS`] by its name. Capitals count as small letters, and a space
    /// or an underscore as a hyphen: `CFRP tube` is `cfrp-tube`.
    pub fn named(name: &str) -> Option<&'static Self> {
        let plain = |letter: char| match letter {
            ' ' | '_' => '-',
            letter => letter.to_ascii_lowercase(),
        };
        MATERIALS.iter().find(|material| material.name.chars().eq(name.chars().map(plain)))
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

#[cfg(test)]
mod tests {
    use super::{MATERIALS, Material};

    #[test]
    fn names_are_found_as_people_write_them() {
        for (given, name) in [("PLA", "pla"), ("spring steel", "spring-steel")] {
            assert_eq!(Material::named(given).map(|material| material.name), Some(name));
        }
        assert_eq!(Material::named("CFRP_tube"), Material::named("cfrp-tube"));
        assert!(Material::named("steel ").is_none() && Material::named("").is_none());
    }

    /// Speed of sound along the link, `√(E/ρ)`: 1,000 m/s of the softest plastic to 10,000 m/s of
    /// carbon fibres. A wrong power of ten in a modulus or a density lies outside.
    #[test]
    fn every_material_carries_sound_as_solids_do() {
        for material in &MATERIALS {
            let speed = libm::sqrt(material.youngs_modulus / material.density);
            assert!((1e3..1e4).contains(&speed), "{}: {speed} m/s", material.name);
            assert_eq!(Material::named(material.name), Some(material));
        }
    }
}
