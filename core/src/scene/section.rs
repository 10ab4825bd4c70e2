//! A stretch of a link with one law of stiffness and mass.

use super::CrossSection;
use crate::Error;
use crate::material::Material;
use crate::math::array;

/// A stretch of the link along which stiffness and mass per length are polynomials of `s`, 0 at the
/// end nearer to the clamp and 1 at the other.
///
/// A section that tapers straight from one cross-section to another is one of these exactly: its
/// area is of degree 2 in `s` and its second moment of degree 4.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Section {
    /// Length, m.
    pub(super) length: f64,
    /// Coefficients of `EI(s)`, N m².
    pub(super) stiffness: [f64; 5],
    /// Coefficients of `ρA(s)`, kg/m.
    pub(super) density: [f64; 3],
}

impl Section {
    /// A section with these bending stiffnesses (N m²) and masses per length (kg/m) at its two
    /// ends, linear between them. `length` in m.
    pub fn linear(
        length: f64,
        bending_stiffness: [f64; 2],
        mass_per_length: [f64; 2],
    ) -> Result<Self, Error> {
        for ei in bending_stiffness {
            Error::check("link.sections.bending_stiffness", ei, 1e-9, 1e12, "N m^2")?;
        }
        for rho in mass_per_length {
            Error::check("link.sections.mass_per_length", rho, 1e-7, 1e5, "kg/m")?;
        }
        let ([e0, e1], [m0, m1]) = (bending_stiffness, mass_per_length);
        let length = Error::check("link.sections.length", length, 1e-6, 1e3, "m")?;
        Ok(Self { length, stiffness: [e0, e1 - e0, 0.0, 0.0, 0.0], density: [m0, m1 - m0, 0.0] })
    }

    /// A section of a material whose sizes change in straight lines from those at one end to those
    /// at the other. `length` in m.
    pub fn tapered(
        length: f64,
        material: &Material,
        cross_section: CrossSection<[f64; 2]>,
    ) -> Result<Self, Error> {
        let length = Error::check("link.sections.length", length, 1e-6, 1e3, "m")?;
        for s in [0.0, 1.0] {
            let cut = cross_section.at(s).validate()?;
            let ei = material.youngs_modulus * cut.second_moment();
            Error::check("link.sections.bending_stiffness", ei, 1e-9, 1e12, "N m^2")?;
        }
        let cuts = [0.0, 0.25, 0.5, 0.75, 1.0].map(|s| cross_section.at(s));
        let stiffness = cuts.map(|cut| material.youngs_modulus * cut.second_moment());
        let [first, _, middle, _, last] = cuts.map(|cut| material.density * cut.area());
        Ok(Self { length, stiffness: quartic(stiffness), density: parabola([first, middle, last]) })
    }
}

/// Coefficients of the polynomial of degree 4 through values at 0, ¼, ½, ¾ and 1.
fn quartic(y: [f64; 5]) -> [f64; 5] {
    // Newton's forward differences, of which equal values leave exact zeros.
    let d1: [f64; 4] = array(|i| y[i + 1] - y[i]);
    let d2: [f64; 3] = array(|i| d1[i + 1] - d1[i]);
    let d3 = [d2[1] - d2[0], d2[2] - d2[1]];
    let d4 = d3[1] - d3[0];
    // In u = 4s: y₀ + d₁u + d₂u(u−1)/2 + d₃u(u−1)(u−2)/6 + d₄u(u−1)(u−2)(u−3)/24.
    let (b1, b2, b3, b4) = (d1[0], d2[0] / 2.0, d3[0] / 6.0, d4 / 24.0);
    [
        y[0],
        4.0 * (b1 - b2 + 2.0 * b3 - 6.0 * b4),
        16.0 * (b2 - 3.0 * b3 + 11.0 * b4),
        64.0 * (b3 - 6.0 * b4),
        256.0 * b4,
    ]
}

/// Coefficients of the parabola through values at 0, ½ and 1.
fn parabola([a, b, c]: [f64; 3]) -> [f64; 3] {
    [a, 4.0 * b - 3.0 * a - c, 2.0 * (a + c) - 4.0 * b]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polynomial;

    /// Every kind of cross-section, between the points that its polynomials pass through.
    #[test]
    fn a_taper_is_its_polynomials() {
        let aluminium = Material::named("aluminium").expect("a material");
        for ends in [
            CrossSection::Strip { width: [0.03, 0.015], thickness: [0.004, 0.002] },
            CrossSection::Round { diameter: [0.01, 0.004] },
            CrossSection::Tube { diameter: [0.02, 0.012], wall: [0.002, 0.001] },
            CrossSection::RectangleTube {
                width: [0.03, 0.02],
                thickness: [0.02, 0.01],
                wall: [0.003, 0.001],
            },
        ] {
            let section = Section::tapered(0.5, aluminium, ends).expect("a section");
            for s in [0.1, 0.37, 0.62, 0.9] {
                let cut = ends.at(s);
                let ei = polynomial(&section.stiffness, s) / aluminium.youngs_modulus;
                let rho = polynomial(&section.density, s) / aluminium.density;
                assert!((ei / cut.second_moment() - 1.0).abs() < 1e-12, "{ends:?} at {s}");
                assert!((rho / cut.area() - 1.0).abs() < 1e-12, "{ends:?} at {s}");
            }
        }
    }

    #[test]
    fn a_uniform_section_has_constant_polynomials() {
        let steel = Material::named("steel").expect("a material");
        let ends = CrossSection::Round { diameter: [0.006, 0.006] };
        let section = Section::tapered(0.5, steel, ends).expect("a section");
        assert_eq!(section.stiffness[1..], [0.0; 4]);
        assert_eq!(section.density[1..], [0.0; 2]);
    }
}
