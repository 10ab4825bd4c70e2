#![forbid(unsafe_code)]
//! The native half of the Python package `stillbeam`.
//!
//! Each function here does one thing of `stillbeam_sim` with the interpreter released, and hands
//! back arrays. Names, docstrings for users, tables and pictures are the package's own
//! (`python/stillbeam`).

mod choose;
mod compare;
mod driven;
mod error;
mod export;
mod generator;
mod identify;
mod keys;
mod machine;
mod plan;
mod progress;
mod rows;
mod run;
mod scene;
mod tables;
mod trials;

use pyo3::prelude::*;

/// The native half of `stillbeam`; import that.
#[pymodule]
fn _stillbeam(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<rows::Rows>()?;
    module.add_class::<generator::Generator>()?;
    module.add_class::<driven::Plant>()?;
    module.add_class::<export::Prepared>()?;
    module.add_function(wrap_pyfunction!(scene::scenes, module)?)?;
    module.add_function(wrap_pyfunction!(run::run, module)?)?;
    module.add_function(wrap_pyfunction!(run::reference, module)?)?;
    module.add_function(wrap_pyfunction!(compare::compare, module)?)?;
    module.add_function(wrap_pyfunction!(choose::choose, module)?)?;
    module.add_function(wrap_pyfunction!(plan::plan, module)?)?;
    module.add_function(wrap_pyfunction!(identify::identify, module)?)?;
    module.add_function(wrap_pyfunction!(trials::drive, module)?)?;
    module.add_function(wrap_pyfunction!(export::export, module)?)
}
