//! Keywords of the solver, as the command line takes them.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Deserialize;
use stillbeam_sim::document::Document;
use stillbeam_sim::error::Error;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Solver, SolverKeys};
use toml_edit::DocumentMut;

use crate::error::refused;
use crate::tables;

/// A text with nothing but a solver.
#[derive(Deserialize)]
struct Keywords {
    #[serde(default)]
    solver: SolverKeys,
}

/// Name under which the keywords are parsed.
const PLACE: &str = "keywords";

/// Returns the keywords as keys. Absent ones are `None` in the dict, or not there.
pub fn of(keywords: &Bound<'_, PyDict>) -> PyResult<SolverKeys> {
    let wrapped = PyDict::new(keywords.py());
    wrapped.set_item("solver", keywords)?;
    let mut document = DocumentMut::new();
    tables::merge(&mut document, &wrapped)?;
    let text = document.to_string();
    let read = Document::parse(PLACE, &text).and_then(|document| document.read::<Keywords>());
    read.map(|keywords| keywords.solver)
        .map_err(|error| PyValueError::new_err(without_place(PLACE, &error.to_string()).to_owned()))
}

/// Returns an error without the name, line and column that it begins with: of a text that nobody
/// has written they tell nothing.
pub fn without_place<'a>(name: &str, error: &'a str) -> &'a str {
    let Some(rest) = error.strip_prefix(name).and_then(|rest| rest.strip_prefix(':')) else {
        return error;
    };
    rest.trim_start_matches(|c: char| c.is_ascii_digit() || c == ':').trim_start()
}

/// Returns the solver of a run, and all keys that were given. What is typed is meant, so keys that
/// the method does not read are refused.
pub fn resolve(
    keywords: &Bound<'_, PyDict>,
    scene: &SceneFile,
) -> PyResult<(Solver, SolverKeys, SolverKeys)> {
    let typed = of(keywords)?;
    let keys = typed.or(scene.solver);
    let solver = keys.resolve().map_err(refused)?;
    match typed.unread(solver.method).into_iter().next() {
        Some(line) => Err(refused(Error::new(line))),
        None => Ok((solver, typed, keys)),
    }
}

/// Returns the control period of a scene, s.
pub fn tick(scene: &SceneFile) -> PyResult<f64> {
    Ok(scene.solver.resolve().map_err(refused)?.tick)
}
