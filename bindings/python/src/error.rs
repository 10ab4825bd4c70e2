//! Errors of the library as exceptions of Python.

use pyo3::PyErr;
use pyo3::exceptions::PyValueError;
use stillbeam_sim::error::Error;

/// Returns a `ValueError` with the library's own line, which names the field, its value, what it
/// must be and what would do.
pub fn refused(error: Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Returns the error of a core that is called directly, as [`refused`] does.
pub fn core(error: stillbeam::Error) -> PyErr {
    refused(error.into())
}
