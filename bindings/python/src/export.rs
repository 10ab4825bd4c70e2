//! Prepared arms for programs without set-up.

use std::path::PathBuf;

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use stillbeam_sim::export::{PreparedArm, prepare};
use stillbeam_sim::output;

use crate::error::refused;
use crate::keys;
use crate::scene::Scene;

/// A stepper as constants, which a program loads in place of its set-up.
#[pyclass(frozen, module = "stillbeam")]
pub struct Prepared {
    arm: PreparedArm,
}

/// Prepares the stepper of a scene, as the command line's `export` does.
#[pyfunction]
pub fn export(
    py: Python<'_>,
    scene: &Scene,
    payloads: Vec<f64>,
    still: bool,
    keywords: &Bound<'_, PyDict>,
) -> PyResult<Prepared> {
    let (solver, ..) = keys::resolve(keywords, &scene.file)?;
    let file = scene.commanded()?;
    let arm = py.detach(|| prepare(file, &solver, &payloads, still)).map_err(refused)?;
    Ok(Prepared { arm })
}

#[pymethods]
impl Prepared {
    /// Rust type that loads the words.
    #[getter]
    fn stepper(&self) -> &str {
        &self.arm.stepper
    }

    /// The solver in words.
    #[getter]
    fn method(&self) -> &str {
        &self.arm.method
    }

    /// Control period, s.
    #[getter]
    fn tick(&self) -> f64 {
        self.arm.tick
    }

    /// Masses of the payload, kg.
    #[getter]
    fn payloads<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.arm.payloads)
    }

    /// Words of the stepper with each payload, uint32.
    #[getter]
    fn arms<'py>(&self, py: Python<'py>) -> Vec<Bound<'py, PyArray1<u32>>> {
        self.arm.arms.iter().map(|words| PyArray1::from_slice(py, words)).collect()
    }

    /// Words of the planner of still moves with each payload, uint32; empty unless asked for.
    #[getter]
    fn planners<'py>(&self, py: Python<'py>) -> Vec<Bound<'py, PyArray1<u32>>> {
        self.arm.planners.iter().map(|words| PyArray1::from_slice(py, words)).collect()
    }

    /// Returns the constants as Rust.
    fn to_rust(&self) -> String {
        self.arm.to_rust()
    }

    /// Returns the constants as a C header.
    fn to_c(&self) -> String {
        self.arm.to_c()
    }

    /// Returns the bare bytes, four a word, the lowest first.
    fn to_bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.arm.to_bytes())
    }

    /// Writes a file, whole or not at all: Rust if it ends in .rs, a C header if in .h, else bytes.
    fn write(&self, path: PathBuf) -> PyResult<()> {
        let bytes = match path.extension().and_then(|ending| ending.to_str()) {
            Some("rs") => self.arm.to_rust().into_bytes(),
            Some("h") => self.arm.to_c().into_bytes(),
            _ => self.arm.to_bytes(),
        };
        output::write_whole(&path, |file| file.write_all(&bytes)).map_err(refused)
    }

    fn __repr__(&self) -> String {
        format!("<Prepared {}: {} bytes a payload>", self.arm.stepper, self.arm.bytes_each())
    }
}
