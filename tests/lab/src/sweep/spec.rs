//! Specification of a sweep: a TOML file of lists that are crossed.

use std::collections::HashSet;
use std::path::Path;

use serde::Deserialize;

use stillbeam_sim::document::Document;
use stillbeam_sim::error::Error;
use stillbeam_sim::solver::{Mass, Method, Quality, Scalar, SolverKeys};

/// A sweep as its user writes it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spec {
    /// Scene files, or names of embedded scenes.
    pub scenes: Vec<String>,
    /// Grids of solvers; every scene is run with each solver of each grid, once.
    pub grid: Vec<Grid>,
}

/// Lists that are crossed with each other. An empty one stands for the default.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Grid {
    /// Steppers.
    pub method: Vec<Method>,
    /// Beam elements.
    pub elements: Vec<i64>,
    /// Mass matrices.
    pub mass: Vec<Mass>,
    /// Modes.
    pub modes: Vec<i64>,
    /// Qualities of elastica: the work a tick.
    pub quality: Vec<Quality>,
    /// Errors that auto may make, fractions of L.
    pub tolerance: Vec<f64>,
    /// Errors of the torque that auto may make, fractions of its peak.
    pub torque_tolerance: Vec<f64>,
    /// Ticks, s.
    pub tick: Vec<f64>,
    /// Precisions.
    pub scalar: Vec<Scalar>,
    /// With and without spin terms.
    pub spin: Vec<bool>,
}

impl Spec {
    /// Returns the sweep that is embedded in the program.
    pub fn embedded() -> Result<Self, Error> {
        Self::parse("default.toml", include_str!("../../sweeps/default.toml"))
    }

    /// Reads a spec from a file.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = std::fs::read_to_string(path).map_err(|cause| {
            Error::file(path, format_args!("{cause}; it must be a sweep's TOML file"))
        })?;
        Self::parse(&path.display().to_string(), &text)
    }

    /// Parses a spec. Errors begin with `name`, and the line and column of the key.
    pub fn parse(name: &str, text: &str) -> Result<Self, Error> {
        let document = Document::parse(name, text)?;
        let spec: Self = document.read()?;
        for (key, count) in [("scenes", spec.scenes.len()), ("grid", spec.grid.len())] {
            if count == 0 {
                let error = Error::new(format_args!("{key} = []: must be one or more"));
                return Err(document.locate(&error));
            }
        }
        Ok(spec)
    }

    /// Returns the solvers of all grids, each once, in the order of the file.
    pub fn solvers(&self) -> Vec<SolverKeys> {
        let mut seen = HashSet::new();
        let all = self.grid.iter().flat_map(Grid::solvers);
        all.filter(|keys| seen.insert(format!("{keys:?}"))).collect()
    }
}

impl Grid {
    /// Returns every combination. Keys that a method does not read are not crossed.
    fn solvers(&self) -> Vec<SolverKeys> {
        let mut all = vec![SolverKeys::default()];
        cross(&mut all, &self.method, |keys| &mut keys.method);
        cross(&mut all, &self.elements, |keys| &mut keys.elements);
        cross(&mut all, &self.mass, |keys| &mut keys.mass);
        cross(&mut all, &self.modes, |keys| &mut keys.modes);
        cross(&mut all, &self.quality, |keys| &mut keys.quality);
        cross(&mut all, &self.tolerance, |keys| &mut keys.tolerance);
        cross(&mut all, &self.torque_tolerance, |keys| &mut keys.torque_tolerance);
        cross(&mut all, &self.spin, |keys| &mut keys.spin);
        cross(&mut all, &self.scalar, |keys| &mut keys.scalar);
        cross(&mut all, &self.tick, |keys| &mut keys.tick);
        all.into_iter().map(SolverKeys::relevant).collect()
    }
}

/// Returns each of `all` with each of `values` in its place.
fn cross<V: Copy>(
    all: &mut Vec<SolverKeys>,
    values: &[V],
    place: impl Fn(&mut SolverKeys) -> &mut Option<V>,
) {
    if values.is_empty() {
        return;
    }
    let with = |keys: &SolverKeys, value: V| {
        let mut keys = *keys;
        *place(&mut keys) = Some(value);
        keys
    };
    *all = all.iter().flat_map(|keys| values.iter().map(move |&v| with(keys, v))).collect();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_a_method_reads_is_crossed() {
        let text = "scenes = [\"d-fast\"]\n[[grid]]\nmethod = [\"rigid\", \"newmark\"]\nelements = \
                    [1, 2]\nspin = [true, false]\n[[grid]]\nmethod = [\"newmark\"]\nelements = [2]";
        let solvers = Spec::parse("test", text).unwrap().solvers();
        assert_eq!(solvers.len(), 1 + 4, "{solvers:?}");
    }

    #[test]
    fn the_embedded_specs_are_accepted() {
        let (ticks, scalars, spins) = (5, 2, 2);
        let (elements, masses) = (4, 2);
        let (modes, qualities) = (3, 2);
        let newmark = elements * masses * ticks * scalars * spins;
        let rigid = ticks;
        let modal = modes * ticks * scalars * spins;
        let elastica = modes * qualities * ticks * scalars;
        let auto = 4 * ticks;
        let solvers = Spec::embedded().unwrap().solvers();
        assert_eq!(solvers.len(), newmark + rigid + modal + elastica + auto);
    }
}
