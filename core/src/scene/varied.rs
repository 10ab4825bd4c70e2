//! A link of several sections, with masses mounted on it.

use super::{Link, Section};
use crate::Error;
use crate::math::{gauss_points, polynomial};

/// Most sections of a link.
pub const MAX_SECTIONS: usize = 8;

/// Most masses mounted on a link.
pub const MAX_MASSES: usize = 4;

/// A point mass mounted on the link, such as a sensor or a motor. It has no rotary inertia.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PointMass {
    /// Distance from the clamp along the link, m.
    pub position: f64,
    /// kg.
    pub mass: f64,
}

/// A section of a [`Varied`] link, relative to the whole: its share of the length, `EI` over the
/// link's, `ρA` over the link's `m/L`.
pub(super) const EMPTY: Section = Section { length: 0.0, stiffness: [0.0; 5], density: [0.0; 3] };

/// Sections and point masses of a link, as fractions of the [`Link`]'s own numbers: a change of
/// `link.bending_stiffness` stiffens every section.
///
/// Up to [`MAX_SECTIONS`] sections, of which none makes a uniform link, and up to [`MAX_MASSES`]
/// masses.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Varied {
    /// Lengths as fractions of `L`, stiffnesses of `EI`, densities of `m/L`. Those that are not
    /// used have no length.
    pub(super) sections: [Section; MAX_SECTIONS],
    /// Position as a fraction of `L`, mass in kg. Those that are not used have no mass.
    pub(super) masses: [PointMass; MAX_MASSES],
}

impl Default for Varied {
    fn default() -> Self {
        Self::UNIFORM
    }
}

impl Varied {
    /// A uniform link without masses on it.
    pub const UNIFORM: Self = Self {
        sections: [EMPTY; MAX_SECTIONS],
        masses: [PointMass { position: 0.0, mass: 0.0 }; MAX_MASSES],
    };

    /// True if the link is uniform and nothing is mounted on it.
    pub fn is_uniform(&self) -> bool {
        self.sections[0].length == 0.0 && self.masses[0].mass == 0.0
    }

    /// The link of these sections, from the clamp to the tip, and its shape.
    ///
    /// # Errors
    /// None, or more than [`MAX_SECTIONS`].
    pub fn of_sections(sections: &[Section]) -> Result<(Link, Self), Error> {
        let count = sections.len() as f64;
        Error::check("link.sections", count, 1.0, MAX_SECTIONS as f64, "sections")?;
        let (mut length, mut mass) = (0.0, 0.0);
        for section in sections {
            length += section.length;
            mass += section.length * mean(&section.density);
        }
        let mut shape = Self::UNIFORM;
        for (own, section) in shape.sections.iter_mut().zip(sections) {
            *own = Section {
                length: section.length / length,
                stiffness: section.stiffness,
                density: section.density.map(|rho| rho * length / mass),
            };
        }
        let bending_stiffness = shape.tip_stiffness();
        for section in &mut shape.sections {
            section.stiffness = section.stiffness.map(|ei| ei / bending_stiffness);
        }
        Ok((Link { length, mass, bending_stiffness }.validate()?, shape))
    }

    /// The shape with a mass mounted at `position` (m) of a link of `length` (m).
    ///
    /// # Errors
    /// A position outside the link, a negative mass, or more than [`MAX_MASSES`].
    pub fn with_mass(mut self, length: f64, mass: PointMass) -> Result<Self, Error> {
        Error::check("link.masses.position", mass.position, 0.0, length, "m")?;
        Error::check("link.masses.mass", mass.mass, 0.0, 1e5, "kg")?;
        if mass.mass == 0.0 {
            return Ok(self);
        }
        let count = self.masses.iter().filter(|own| own.mass > 0.0).count();
        let next = (count + 1) as f64;
        Error::check("link.masses", next, 0.0, MAX_MASSES as f64, "masses")?;
        self.masses[count] = PointMass { position: mass.position / length, ..mass };
        Ok(self)
    }

    /// The point masses that are mounted, their positions as fractions of `L`.
    pub fn masses(&self) -> impl Iterator<Item = &PointMass> {
        self.masses.iter().filter(|mass| mass.mass > 0.0)
    }

    /// `EI` at `xi`, a fraction of `L`, over the link's. On a border, that of the section nearer to
    /// the clamp.
    pub fn stiffness(&self, xi: f64) -> f64 {
        let (section, s) = self.section_at(xi);
        polynomial(&section.stiffness, s)
    }

    /// `ρA` at `xi`, a fraction of `L`, over `m/L`; likewise.
    pub fn density(&self, xi: f64) -> f64 {
        let (section, s) = self.section_at(xi);
        polynomial(&section.density, s)
    }

    /// Where one section ends and the next begins, fractions of `L`.
    pub fn borders(&self) -> impl Iterator<Item = f64> {
        self.sections().skip(1).map(|(begin, _)| begin)
    }

    fn section_at(&self, xi: f64) -> (Section, f64) {
        let mut found = (EMPTY, 0.0);
        for (begin, section) in self.sections() {
            if begin < xi || begin == 0.0 {
                found = (section, (xi - begin) / section.length);
            }
        }
        found
    }

    /// `1/3 / ∫(1 − ξ)²/EI dξ`: stiffness of the uniform link that a force at the tip bends as far.
    fn tip_stiffness(&self) -> f64 {
        let mut sum = 0.0;
        for (begin, section) in self.sections() {
            for (s, weight) in gauss_points() {
                let beyond = 1.0 - (begin + s * section.length);
                let ei = polynomial(&section.stiffness, s);
                sum += weight * section.length * beyond * beyond / ei;
            }
        }
        1.0 / (3.0 * sum)
    }

    /// The sections with where they begin, a fraction of `L`. A single one of a uniform link with
    /// masses on it.
    pub(crate) fn sections(&self) -> impl Iterator<Item = (f64, Section)> {
        const WHOLE: Section =
            Section { length: 1.0, stiffness: [1.0, 0.0, 0.0, 0.0, 0.0], density: [1.0, 0.0, 0.0] };
        let mut begin = 0.0;
        let uniform = self.sections[0].length == 0.0;
        (0..MAX_SECTIONS).filter_map(move |i| {
            let section = if uniform && i == 0 { WHOLE } else { self.sections[i] };
            let at = begin;
            begin += section.length;
            (section.length > 0.0).then_some((at, section))
        })
    }

    /// Mass (kg) that the link of mass `mass` (kg) and `length` (m) has beyond `xi`, a fraction of
    /// its length, and the first (kg m) and second (kg m²) moment of it about the clamp. A point
    /// mass at `xi` itself counts.
    pub(crate) fn mass_beyond(&self, xi: f64, mass: f64, length: f64) -> [f64; 3] {
        let mut moments = [0.0; 3];
        let mut add = |at: f64, m: f64| {
            let x = length * at;
            for (moment, power) in moments.iter_mut().zip([1.0, x, x * x]) {
                *moment += m * power;
            }
        };
        for (begin, section) in self.sections() {
            let from = ((xi - begin) / section.length).clamp(0.0, 1.0);
            for (s, weight) in gauss_points() {
                let s = from + s * (1.0 - from);
                let share = weight * (1.0 - from) * section.length;
                add(begin + s * section.length, mass * share * polynomial(&section.density, s));
            }
        }
        for own in self.masses().filter(|own| own.position >= xi) {
            add(own.position, own.mass);
        }
        moments
    }

    /// The shape itself if its numbers are those of a link.
    pub(super) fn validate(&self) -> Result<(), Error> {
        if self.sections[0].length != 0.0 {
            let (mut length, mut mass) = (0.0, 0.0);
            for section in &self.sections {
                length += Error::check("link.sections.length", section.length, 0.0, 1.0, "L")?;
                mass += section.length * mean(&section.density);
                if section.length > 0.0 {
                    section.validate_relative()?;
                }
            }
            Error::check("link.sections.length", length, 1.0 - 1e-9, 1.0 + 1e-9, "L in all")?;
            Error::check("link.sections.mass_per_length", mass, 1.0 - 1e-9, 1.0 + 1e-9, "m/L")?;
        }
        for mass in &self.masses {
            Error::check("link.masses.position", mass.position, 0.0, 1.0, "L")?;
            Error::check("link.masses.mass", mass.mass, 0.0, 1e5, "kg")?;
        }
        Ok(())
    }
}

impl Section {
    /// Refuses a stiffness or a density that is not positive, or that is a million times the
    /// link's.
    fn validate_relative(&self) -> Result<(), Error> {
        for (s, _) in [(0.0, 0.0), (1.0, 0.0)].into_iter().chain(gauss_points()) {
            let ei = polynomial(&self.stiffness, s);
            Error::check("link.sections.bending_stiffness", ei, 1e-6, 1e6, "of the link's")?;
            let rho = polynomial(&self.density, s);
            Error::check("link.sections.mass_per_length", rho, 1e-6, 1e6, "of the link's")?;
        }
        Ok(())
    }
}

/// Mean over `0..1` of a polynomial.
fn mean(c: &[f64; 3]) -> f64 {
    c[0] + c[1] / 2.0 + c[2] / 3.0
}
