//! Machines by name, path, text or tables.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use stillbeam_sim::error::Error;
use stillbeam_sim::servo::{Between, Machine, Protocol};
use toml_edit::DocumentMut;

use crate::error::refused;
use crate::{keys, tables};

/// Name under which tables are parsed.
const PLACE: &str = "machine";

/// Returns the machine: the default one, an embedded one by name, a file's, a text's, or that of a
/// dict of tables.
pub fn of(machine: Option<&Bound<'_, PyAny>>) -> PyResult<Machine> {
    let Some(machine) = machine else { return Ok(Machine::default()) };
    let renamed = |error: Error| refused(Error::new(error.to_string().replace("--machine", PLACE)));
    if let Ok(given) = machine.cast::<PyDict>() {
        let mut document = DocumentMut::new();
        tables::merge(&mut document, given)?;
        return Machine::parse(PLACE, &document.to_string()).map_err(|error| {
            PyValueError::new_err(keys::without_place(PLACE, &error.to_string()).to_owned())
        });
    }
    let path = machine.py().import("os")?.call_method1("fspath", (machine,))?;
    let path: String = path.extract()?;
    if machine.is_instance_of::<PyString>() && path.contains(['\n', '=']) {
        return Machine::parse(PLACE, &path).map_err(refused);
    }
    Machine::open(&path).map_err(renamed)
}

/// Returns the machine on another drive or with another way between setpoints, if they are given.
pub fn with(mut machine: Machine, drive: Option<&str>, between: Option<&str>) -> PyResult<Machine> {
    let unknown = |key: &str, name: &str, known: &[&str]| {
        let known = known.join(", ");
        refused(Error::new(format_args!("{key} = \"{name}\": must be one of {known}")))
    };
    if let Some(name) = drive {
        machine.drive =
            Protocol::named(name).ok_or_else(|| unknown("drive", name, &Protocol::NAMES))?;
    }
    if let Some(name) = between {
        let way = Between::ALL.into_iter().find(|way| way.name() == name);
        let known = Between::ALL.map(Between::name);
        let way = way.ok_or_else(|| unknown("between", name, &known))?;
        machine.drive = machine.drive.with_between(way);
    }
    Ok(machine)
}
