//! A `[[link.sections]]` table.

use serde::Deserialize;
use stillbeam::material::Material;
use stillbeam::scene::Section;

use super::link::clash;
use super::matter::Matter;
use super::sizes::{Sizes, located};
use super::values::Ends;
use crate::error::Error;

/// A stretch of the link: the sizes of its cross-section and its material, or stiffness and mass
/// per length. A single number is of both ends.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SectionTable {
    pub(super) length: f64,
    width: Option<Ends>,
    thickness: Option<Ends>,
    diameter: Option<Ends>,
    wall: Option<Ends>,
    material: Option<String>,
    pub(super) youngs_modulus: Option<f64>,
    pub(super) density: Option<f64>,
    bending_stiffness: Option<Ends>,
    mass_per_length: Option<Ends>,
}

impl SectionTable {
    /// Returns the key that gives the section's stiffness as a number, if one does.
    pub(super) fn stiffness_key(&self) -> Option<&'static str> {
        if self.bending_stiffness.is_some() {
            Some("bending_stiffness")
        } else {
            self.youngs_modulus.map(|_| "youngs_modulus")
        }
    }

    /// Returns the sizes of the cross-section.
    pub(super) fn sizes(&self) -> Sizes {
        let &Self { width, thickness, diameter, wall, .. } = self;
        Sizes { width, thickness, diameter, wall }
    }

    /// Returns what the section is made of: its own keys, and the link's for what they leave out. A
    /// section with a stiffness and a mass of its own needs no material.
    pub(super) fn matter(&self, place: &str, link: Matter) -> Result<Matter, Error> {
        let own = Matter::of(place, self.material.as_deref(), self.youngs_modulus, self.density)?;
        Ok(own.or(link))
    }

    /// Returns stiffness and mass per length at both ends, if they are given.
    pub(super) fn numbers(&self, place: &str) -> Result<Option<[Ends; 2]>, Error> {
        let (key, other, given) = match (self.bending_stiffness, self.mass_per_length) {
            (None, None) => return Ok(None),
            (Some(stiffness), Some(mass)) => {
                let others = [
                    ("width", self.width.map(Ends::text)),
                    ("diameter", self.diameter.map(Ends::text)),
                    ("material", self.material.clone()),
                    ("youngs_modulus", self.youngs_modulus.map(|e| e.to_string())),
                    ("density", self.density.map(|rho| rho.to_string())),
                ];
                return match others.into_iter().find_map(|(key, value)| Some((key, value?))) {
                    Some((key, value)) => {
                        Err(clash(&format!("{place}.bending_stiffness"), key, value))
                    }
                    None => Ok(Some([stiffness, mass])),
                };
            }
            (Some(stiffness), None) => ("mass_per_length", "bending_stiffness", stiffness),
            (None, Some(mass)) => ("bending_stiffness", "mass_per_length", mass),
        };
        Err(Error::new(format_args!(
            "{place}.{key}: missing beside {other} = {}; both must be given, or the sizes and \
             material of the section",
            given.text()
        )))
    }

    /// Builds the section out of `material`.
    pub(super) fn build(&self, place: &str, material: &Material) -> Result<Section, Error> {
        let built = match self.numbers(place)? {
            Some([stiffness, mass]) => Section::linear(self.length, stiffness.0, mass.0),
            None => match self.sizes().cross_section(place)? {
                Some(cut) => Section::tapered(self.length, material, cut),
                None => {
                    return Err(Error::new(format_args!(
                        "{place}.width: missing; must be width and thickness, or diameter, each with \
                         wall for a tube, or bending_stiffness and mass_per_length"
                    )));
                }
            },
        };
        built.map_err(|error| located(&error, place))
    }
}
