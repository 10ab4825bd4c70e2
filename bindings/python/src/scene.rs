//! A scene: the text of its file, and what is read from it.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stillbeam_sim::arm;
use stillbeam_sim::error::Error;
use stillbeam_sim::scene_file::SceneFile;
use toml_edit::DocumentMut;

use crate::error::refused;
use crate::{keys, tables};

/// An arm with its moves, limits and solver: a scene file of the command line, in SI units.
///
/// Every keyword is a table or a key of the file, e.g.
/// ``Scene(link={"length": 0.4, "mass": 0.0224, "bending_stiffness": 0.46},
/// payload={"mass": 0.03}, move={"profile": "cubic", "duration": 0.8, "to": 1.57})``.
/// Lengths in m, masses in kg, times in s, angles in rad, forces in N. A scene without moves is an
/// arm to plan for. Scenes do not change; ``replace`` makes another one.
///
/// Raises ValueError with the field, its value and what it must be.
#[pyclass(frozen, module = "stillbeam")]
pub struct Scene {
    /// The scene as it is read from the text.
    pub file: SceneFile,
    /// The text of the scene file.
    pub text: String,
}

/// Name of a scene that is no file.
const UNNAMED: &str = "scene";

impl Scene {
    /// Parses a text, whose errors begin with the name, and with line and column of the key.
    pub fn parse(py: Python<'_>, name: &str, text: String) -> Result<Self, Error> {
        let file = py.detach(|| SceneFile::parse_arm(name, &text))?;
        Ok(Self { file, text })
    }

    /// Parses a text that nobody has written: its lines mean nothing to the reader of an error.
    fn of_keywords(py: Python<'_>, name: &str, document: &DocumentMut) -> PyResult<Self> {
        Self::parse(py, name, document.to_string()).map_err(|error| {
            PyValueError::new_err(keys::without_place(name, &error.to_string()).to_owned())
        })
    }

    /// Returns the scene if it has moves.
    pub fn commanded(&self) -> PyResult<&SceneFile> {
        if self.file.moves.is_empty() {
            return Err(PyValueError::new_err(
                "move: missing; must be a dict move or a list of dicts moves in this scene",
            ));
        }
        Ok(&self.file)
    }

    fn document(&self) -> PyResult<DocumentMut> {
        self.text.parse().map_err(|error| refused(Error::new(error)))
    }

    /// Returns an angle, rad, in the unit in which the scene's moves are written.
    pub fn in_own_unit(&self, angle: f64) -> PyResult<f64> {
        Ok(match self.document()?.get("unit").and_then(toml_edit::Item::as_str) {
            Some("deg") => angle.to_degrees(),
            Some("turn") => angle / std::f64::consts::TAU,
            _ => angle,
        })
    }

    /// Returns a scene with changed tables.
    pub fn changed(&self, py: Python<'_>, changes: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut document = self.document()?;
        tables::merge(&mut document, changes)?;
        Self::of_keywords(py, &self.file.name, &document)
    }
}

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (**tables))]
    fn new(py: Python<'_>, tables: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut document = DocumentMut::new();
        if let Some(given) = tables {
            tables::merge(&mut document, given)?;
        }
        Self::of_keywords(py, UNNAMED, &document)
    }

    /// Reads a scene from an embedded scene's name ("d-fast"), a scene file's path, or a text in
    /// TOML, which is one that has a line break or an equals sign.
    #[staticmethod]
    fn from_toml(py: Python<'_>, source: &Bound<'_, PyAny>) -> PyResult<Self> {
        let path = py.import("os")?.call_method1("fspath", (source,))?;
        let path: String = path.extract()?;
        if source.is_instance_of::<pyo3::types::PyString>() && path.contains(['\n', '=']) {
            return Self::parse(py, UNNAMED, path).map_err(refused);
        }
        let read = |path: &str| {
            // Names the scenes that there are if it is none of them and no file.
            stillbeam_sim::scenes::open_arm(path)?;
            stillbeam_sim::scenes::text(path)
        };
        let text = py.detach(|| read(&path)).map_err(refused)?;
        Self::parse(py, &path, text).map_err(refused)
    }

    /// Returns the scene as the text of a scene file, for the command line or a firmware's build.
    fn to_toml(&self) -> String {
        self.text.clone()
    }

    /// Returns a scene in which the given tables and keys take the place of this one's:
    /// ``scene.replace(payload={"mass": 0.05})``. ``None`` takes a key or a table away. ``move``
    /// and ``moves`` take each other's place; a move with a profile or waypoints is a whole one.
    #[pyo3(signature = (**tables))]
    fn replace(&self, py: Python<'_>, tables: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let none = PyDict::new(py);
        self.changed(py, tables.unwrap_or(&none))
    }

    /// Returns what the arm is, with units in the names: masses, the first natural frequencies
    /// (``frequency_hz``) and damping ratios, sag, what the tick resolves, and with moves the
    /// method that ``auto`` takes.
    fn describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let report = py.detach(|| arm::describe(&self.file)).map_err(refused)?;
        json(py, &report)
    }

    /// Name of the embedded scene, path of the file, or "scene".
    #[getter]
    fn name(&self) -> &str {
        &self.file.name
    }

    /// Control period of the scene's solver, s.
    #[getter]
    fn tick(&self) -> PyResult<f64> {
        Ok(self.file.solver.resolve().map_err(refused)?.tick)
    }

    /// Length of the link, clamp to tip, m.
    #[getter]
    fn length(&self) -> f64 {
        self.file.arm.link.length
    }

    /// Hub angle at the beginning, rad; on a linear axis its position, m.
    #[getter]
    fn start(&self) -> f64 {
        self.file.from
    }

    /// "rotary" or "linear".
    #[getter]
    fn axis(&self) -> &'static str {
        if self.file.arm.mount.is_linear() { "linear" } else { "rotary" }
    }

    /// Number of moves.
    #[getter]
    fn moves(&self) -> usize {
        self.file.moves.len()
    }

    /// Values that are probably in another unit, and what measured values were turned into.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.file.remarks.iter().cloned().chain(self.file.deduced.lines()).collect()
    }

    fn __repr__(&self) -> String {
        let count = self.file.moves.len();
        let moves = if count == 1 { "move" } else { "moves" };
        format!("<Scene {}: a link of {} m, {count} {moves}>", self.file.name, self.length())
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.text == other.text && self.file.name == other.file.name
    }

    /// Restores a pickled scene.
    #[staticmethod]
    fn _restore(py: Python<'_>, name: &str, text: String) -> PyResult<Self> {
        Self::parse(py, name, text).map_err(refused)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String, String))> {
        let restore = py.get_type::<Self>().getattr("_restore")?;
        Ok((restore, (self.file.name.clone(), self.text.clone())))
    }
}

/// Returns the names of the embedded scenes, each with a few words.
#[pyfunction]
pub fn scenes() -> Vec<(&'static str, &'static str)> {
    stillbeam_sim::scenes::list().collect()
}

/// Returns a report as Python's own dicts and lists.
pub fn json<'py>(py: Python<'py>, report: &impl serde::Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(report).map_err(|error| refused(Error::new(error)))?;
    py.import("json")?.call_method1("loads", (text,))
}
