//! The table of a run as arrays.

use std::path::PathBuf;

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stillbeam::AxisKind;
use stillbeam_sim::compare::{self, Residual};
use stillbeam_sim::table::{self, Row};

use crate::error::refused;
use crate::scene::Scene;

/// The rows of a run.
#[pyclass(frozen, module = "stillbeam._stillbeam")]
pub struct Rows {
    /// The rows, from t = 0 on.
    pub list: Vec<Row>,
    /// Kind of the axis, which names the columns.
    pub axis: AxisKind,
    /// Interval of the run, s.
    pub tick: f64,
}

/// A column's name and its values.
type Column = (&'static str, fn(&Row) -> f64);

/// Names of the columns in Python, and the values.
const COLUMNS: [Column; 8] = [
    ("time", |row| row.t_s),
    ("hub_angle", |row| row.hub_angle_rad),
    ("hub_rate", |row| row.hub_rate_rad_s),
    ("hub_acceleration", |row| row.hub_accel_rad_s2),
    ("tip_x", |row| row.tip_x_m),
    ("tip_y", |row| row.tip_y_m),
    ("deflection", |row| row.deflection_m),
    ("torque", |row| row.torque_nm),
];

#[pymethods]
impl Rows {
    /// Returns the columns by name. Those of the payload's centre are there if it is not the tip.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let columns = PyDict::new(py);
        let column = |value: fn(&Row) -> f64| -> Vec<f64> { self.list.iter().map(value).collect() };
        for (name, value) in COLUMNS {
            columns.set_item(name, PyArray1::from_vec(py, column(value)))?;
        }
        if self.list.first().is_some_and(|row| row.payload_x_m.is_some()) {
            let [x, y]: [fn(&Row) -> f64; 2] = [
                |row| row.payload_x_m.unwrap_or(f64::NAN),
                |row| row.payload_y_m.unwrap_or(f64::NAN),
            ];
            columns.set_item("payload_x", PyArray1::from_vec(py, column(x)))?;
            columns.set_item("payload_y", PyArray1::from_vec(py, column(y)))?;
        }
        Ok(columns)
    }

    /// Returns the names of the first eight columns in the command line's CSV.
    fn names(&self) -> [&'static str; 8] {
        table::columns(self.axis)
    }

    /// Writes the CSV that the command line writes.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| table::write(&path, self.axis, &self.list)).map_err(refused)
    }

    /// Returns the residual vibration as a fraction of the length, or the reason why there is none.
    fn residual(&self, py: Python<'_>, scene: &Scene) -> PyResult<(Option<f64>, String)> {
        let found = py.detach(|| compare::residual(&self.list, &scene.file, self.tick));
        Ok(match found.map_err(refused)? {
            Residual::Of(residual) => (Some(residual), String::new()),
            Residual::Turning => (None, "the hub does not end at rest".to_owned()),
            Residual::Cut { ends, needed } => {
                (None, format!("the run ends at {ends} s; must reach {needed} s, see move.settle"))
            }
        })
    }

    fn __len__(&self) -> usize {
        self.list.len()
    }
}
