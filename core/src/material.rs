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
    /// Grade or form that the values are of, and their source.
    pub source: &'static str,
}

/// Materials known by name, at room temperature.
///
/// The values are typical, and how far an arm's own are from them differs: metals some 5 %, plastics
/// 20 %, printed parts, wood and laminates 30 % and more. Nylon softens to half when it takes up
/// moisture, and a printed part weighs and bears by its infill. Where that matters, weigh the link,
/// measure its first frequency, and give `mass` and `frequency`.
pub const MATERIALS: [Material; 16] = [
    Material {
        name: "acrylic",
        youngs_modulus: 3.2e9,
        density: 1190.0,
        source: "Kato and Isobe, table 1",
    },
    Material {
        name: "aluminium",
        youngs_modulus: 69.0e9,
        density: 2800.0,
        source: "Kato and Isobe, table 1: modulus as printed, density from mass over volume",
    },
    Material {
        name: "steel",
        youngs_modulus: 200.0e9,
        density: 7850.0,
        source: "carbon steel, handbook value",
    },
    Material {
        name: "stainless-steel",
        youngs_modulus: 193.0e9,
        density: 8000.0,
        source: "AISI 304, handbook value",
    },
    Material {
        name: "spring-steel",
        youngs_modulus: 206.0e9,
        density: 7850.0,
        source: "EN 13906-1, patented cold-drawn wire of EN 10270-1",
    },
    Material {
        name: "brass",
        youngs_modulus: 110.0e9,
        density: 8440.0,
        source: "CuZn37 (CW508L), Deutsches Kupferinstitut, data sheet CuZn37",
    },
    Material {
        name: "titanium",
        youngs_modulus: 114.0e9,
        density: 4430.0,
        source: "Ti-6Al-4V, handbook value",
    },
    Material {
        name: "glass-epoxy",
        youngs_modulus: 24.0e9,
        density: 1850.0,
        source: "woven laminate FR4, handbook value",
    },
    Material {
        name: "carbon-epoxy",
        youngs_modulus: 120.0e9,
        density: 1600.0,
        source: "laminate with all fibres along the link, handbook value",
    },
    Material {
        name: "cfrp-tube",
        youngs_modulus: 127.0e9,
        density: 1500.0,
        source: "pultruded carbon tube, 60 % fibres along it, flexural modulus, Goodwinds, technical \
                 specifications; tubes rolled of woven cloth have half of it",
    },
    Material {
        name: "pla",
        youngs_modulus: 3.25e9,
        density: 1240.0,
        source: "printed solid and flat, Ultimaker PLA, technical data sheet",
    },
    Material {
        name: "petg",
        youngs_modulus: 2.1e9,
        density: 1270.0,
        source: "moulded, flexural modulus, Eastman Eastar 6763, technical data sheet",
    },
    Material {
        name: "abs",
        youngs_modulus: 2.3e9,
        density: 1040.0,
        source: "moulded, INEOS Terluran GP-22, technical data sheet",
    },
    Material {
        name: "pom",
        youngs_modulus: 2.8e9,
        density: 1410.0,
        source: "copolymer, extruded, Ensinger TECAFORM AH natural, data sheet",
    },
    Material {
        name: "nylon",
        youngs_modulus: 3.5e9,
        density: 1150.0,
        source: "PA 66, dry, extruded, Ensinger TECAMID 66 natural, data sheet",
    },
    Material {
        name: "wood",
        youngs_modulus: 10.8e9,
        density: 450.0,
        source: "Sitka spruce along the grain at 12 % moisture, in bending, USDA Wood Handbook \
                 FPL-GTR-190, table 5-3",
    },
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
            assert!(material.source.len() > 10, "{}", material.name);
            assert_eq!(Material::named(material.name), Some(material));
        }
    }
}
