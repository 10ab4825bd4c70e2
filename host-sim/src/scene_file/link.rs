//! The `[link]` table: a uniform link, or one of sections, and the masses that are mounted on it.
//!
//! Sizes, or sections, say how stiffness and mass are spread along the link. Their sums follow from
//! the material, or are given: `mass` is the mass of all, and `bending_stiffness` that of the
//! uniform link that a force at the tip bends as far.

use std::fmt::Display;

use serde::Deserialize;
use stillbeam::Link;
use stillbeam::material::Material;
use stillbeam::scene::{CrossSection, MAX_MASSES, PointMass, Section, Varied};

use super::matter::Matter;
use super::section::SectionTable;
use super::sizes::{self, Sizes};
use super::values::{Ends, Modes};
use crate::error::Error;

/// A `[link]` table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LinkTable {
    pub(super) length: Option<f64>,
    pub(super) mass: Option<f64>,
    pub(super) bending_stiffness: Option<f64>,
    pub(super) frequency: Option<Modes>,
    pub(super) material: Option<String>,
    pub(super) youngs_modulus: Option<f64>,
    pub(super) density: Option<f64>,
    pub(super) second_moment: Option<f64>,
    pub(super) width: Option<Ends>,
    pub(super) thickness: Option<Ends>,
    pub(super) diameter: Option<Ends>,
    pub(super) wall: Option<Ends>,
    pub(super) sections: Option<Vec<SectionTable>>,
    pub(super) masses: Option<Vec<MassTable>>,
}

/// A `[[link.masses]]` table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MassTable {
    at: f64,
    mass: f64,
}

/// How the link's stiffness is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stiffness {
    /// By the keys of the table.
    Given,
    /// It is deduced, and the table must not give it.
    Deduced,
}

/// A link as built.
pub(super) struct Built {
    pub link: Link,
    pub shape: Varied,
    /// True if the stiffness is that of the material, false if it stands in for one that is
    /// deduced.
    pub is_material: bool,
}

/// Young's modulus (Pa) and density (kg/m³) that stand in for what the whole link's stiffness and
/// mass make up for.
const STAND_IN: (f64, f64) = (1e9, 1e3);

impl LinkTable {
    /// Builds the link.
    pub(super) fn build(&self, stiffness: Stiffness) -> Result<Built, Error> {
        if stiffness == Stiffness::Deduced {
            self.refuse_stiffness()?;
        }
        let mut built = match &self.sections {
            Some(sections) => self.of_sections(sections, stiffness)?,
            None => self.of_one(stiffness)?,
        };
        for (index, mass) in self.masses.iter().flatten().enumerate() {
            let point = PointMass { position: mass.at, mass: mass.mass };
            built.shape = built.shape.with_mass(built.link.length, point).map_err(|error| {
                // The core's names of the keys.
                let text = error.to_string();
                let text = match text.strip_prefix("link.masses") {
                    Some(rest) if !rest.starts_with('.') => self.too_many_masses(),
                    Some(rest) => {
                        format!("link.masses[{index}]{}", rest.replacen(".position", ".at", 1))
                    }
                    None => text,
                };
                Error::new(text)
            })?;
        }
        Ok(built)
    }

    /// The refusal of more masses than an arm takes.
    fn too_many_masses(&self) -> String {
        let count = self.masses.iter().flatten().filter(|mass| mass.mass > 0.0).count();
        format!(
            "link.masses = {count}: must be 0 to {MAX_MASSES} masses; add up those that are near"
        )
    }

    /// Sizes of the cross-section in this table.
    pub(super) fn sizes(&self) -> Sizes {
        let &Self { width, thickness, diameter, wall, .. } = self;
        Sizes { width, thickness, diameter, wall }
    }

    fn matter(&self) -> Result<Matter, Error> {
        Matter::of("link", self.material.as_deref(), self.youngs_modulus, self.density)
    }

    /// Refuses keys that give the stiffness beside `link.frequency`, which gives it too.
    fn refuse_stiffness(&self) -> Result<(), Error> {
        let frequency = self.frequency.as_ref().map_or(String::new(), Modes::text);
        let given = [
            ("link.bending_stiffness", self.bending_stiffness),
            ("link.youngs_modulus", self.youngs_modulus),
        ];
        let own = self.sections.iter().flatten().enumerate().find_map(|(index, section)| {
            section.stiffness_key().map(|key| format!("link.sections[{index}].{key}"))
        });
        let given = given.iter().find(|(_, value)| value.is_some());
        match given.map(|(key, _)| (*key).to_owned()).or(own) {
            None => Ok(()),
            Some(key) => Err(Error::new(format_args!(
                "{key}: given beside link.frequency = {frequency}; must be absent, or the joint be \
                 what one frequency tells: hub.stiffness = \"deduced\""
            ))),
        }
    }

    /// A link of one section: uniform if its sizes are.
    fn of_one(&self, stiffness: Stiffness) -> Result<Built, Error> {
        let Some(length) = self.length else {
            return Err(Error::new(
                "link.length: missing; must be given in [link], or follow from [[link.sections]]",
            ));
        };
        let (cut, matter) = (self.sizes().cross_section("link")?, self.matter()?);
        if let (Some(moment), Some(_)) = (self.second_moment, cut) {
            return Err(Error::new(format_args!(
                "link.second_moment = {moment}: must be absent beside the sizes of a section, which \
                 give it"
            )));
        }
        match cut.filter(|cut| !sizes::is_uniform(cut)) {
            Some(cut) => {
                let material = self.filled("link", matter, stiffness)?;
                let section = Section::tapered(length, &material, cut)
                    .map_err(|error| sizes::located(&error, "link"))?;
                self.scaled(&[section], matter.modulus.is_some())
            }
            None => self.uniform(length, cut.map(|cut| cut.at(0.0)), matter, stiffness),
        }
    }

    fn uniform(
        &self,
        length: f64,
        cut: Option<CrossSection>,
        matter: Matter,
        stiffness: Stiffness,
    ) -> Result<Built, Error> {
        let second_moment = self.second_moment.or(cut.map(|cut| cut.second_moment()));
        let mass = match (self.mass, matter.density, cut) {
            (Some(mass), ..) => self.lone_mass(mass)?,
            (None, Some(density), Some(cut)) => density * cut.area() * length,
            _ => {
                return Err(Error::new(
                    "link.mass: missing; must be a mass in kg, or material or density with the \
                     sizes of a section",
                ));
            }
        };
        let (bending_stiffness, is_material) = match (
            self.bending_stiffness,
            matter.modulus,
            second_moment,
        ) {
            (Some(_), Some(modulus), _) if self.material.is_none() => {
                return Err(clash("link.bending_stiffness", "youngs_modulus", modulus));
            }
            (Some(stiffness), ..) => (stiffness, false),
            (None, Some(modulus), Some(second_moment)) => {
                let link = Link::from_section(length, mass, modulus, second_moment)?;
                (link.bending_stiffness, true)
            }
            // Any stands in for one that is deduced.
            _ if stiffness == Stiffness::Deduced => {
                ((mass * length * length * length).clamp(1e-6, 1e9), false)
            }
            _ => {
                return Err(Error::new(
                    "link.bending_stiffness: missing; must be EI in N m^2, or youngs_modulus or \
                         material with second_moment or the sizes of a section, or frequency in its \
                         place",
                ));
            }
        };
        let link = Link { length, mass, bending_stiffness };
        Ok(Built { link, shape: Varied::UNIFORM, is_material })
    }

    fn of_sections(&self, tables: &[SectionTable], stiffness: Stiffness) -> Result<Built, Error> {
        self.refuse_sizes()?;
        let whole = self.matter()?;
        let mut matters = Vec::new();
        for (index, table) in tables.iter().enumerate() {
            let place = format!("link.sections[{index}]");
            let given = table.numbers(&place)?.is_some();
            let known = Matter { modulus: Some(STAND_IN.0), density: Some(STAND_IN.1) };
            matters.push(if given { known } else { table.matter(&place, whole)? });
        }
        // What stands in for a number of one section does so for all of them.
        let some_modulus = matters.iter().any(|matter| matter.modulus.is_some());
        let some_density = matters.iter().any(|matter| matter.density.is_some());
        let mut sections = Vec::new();
        for (index, (table, matter)) in tables.iter().zip(&matters).enumerate() {
            let place = format!("link.sections[{index}]");
            let material = if (some_modulus && matter.modulus.is_none())
                || (some_density && matter.density.is_none())
            {
                matter.complete(&place)?
            } else {
                self.filled(&place, *matter, stiffness)?
            };
            sections.push(table.build(&place, &material)?);
        }
        let built = self.scaled(&sections, some_modulus)?;
        let sum: f64 = tables.iter().map(|table| table.length).sum();
        let differs = |length: &f64| (sum - length).abs() > 1e-9 * length || length.is_nan();
        if let Some(length) = self.length.filter(differs) {
            return Err(Error::new(format_args!(
                "link.length = {length}: must be {sum} m, the sum of [[link.sections]], or absent"
            )));
        }
        Ok(built)
    }

    /// Refuses sizes of the whole link beside sections.
    fn refuse_sizes(&self) -> Result<(), Error> {
        let sizes = [
            ("width", self.width),
            ("thickness", self.thickness),
            ("diameter", self.diameter),
            ("wall", self.wall),
        ];
        let sizes = sizes.into_iter().filter_map(|(key, ends)| Some((key, ends?.text())));
        let moment = self.second_moment.map(|moment| ("second_moment", moment.to_string()));
        match sizes.chain(moment).next() {
            Some((key, value)) => Err(Error::new(format_args!(
                "link.{key} = {value}: must be absent beside [[link.sections]], which have their own"
            ))),
            None => Ok(()),
        }
    }

    /// Builds the link of these sections, with the whole mass and stiffness where they are given.
    fn scaled(&self, sections: &[Section], is_material: bool) -> Result<Built, Error> {
        let (mut link, shape) =
            Varied::of_sections(sections).map_err(|error| sizes::located(&error, "link"))?;
        if let Some(mass) = self.mass {
            link.mass = self.lone_mass(mass)?;
        }
        if let Some(stiffness) = self.bending_stiffness {
            if let Some(modulus) = self.youngs_modulus {
                return Err(clash("link.bending_stiffness", "youngs_modulus", modulus));
            }
            link.bending_stiffness = stiffness;
        }
        Ok(Built { link, shape, is_material: is_material && self.bending_stiffness.is_none() })
    }

    /// Returns the material of a section. Where the whole link's stiffness or mass is given or
    /// deduced, any stands in for a number that is absent.
    fn filled(&self, place: &str, matter: Matter, stiffness: Stiffness) -> Result<Material, Error> {
        let is_scaled = stiffness == Stiffness::Deduced || self.bending_stiffness.is_some();
        let modulus = matter.modulus.or(is_scaled.then_some(STAND_IN.0));
        let density = matter.density.or(self.mass.map(|_| STAND_IN.1));
        Matter { modulus, density }.complete(place)
    }

    /// Refuses a mass beside a density.
    fn lone_mass(&self, mass: f64) -> Result<f64, Error> {
        match self.density {
            Some(density) => Err(clash("link.mass", "density", density)),
            None => Ok(mass),
        }
    }
}

pub(super) fn clash(field: &str, other: &str, value: impl Display) -> Error {
    Error::new(format_args!(
        "{field}: given beside {other} = {value}; only one of the two must be given"
    ))
}
