//! Frequencies and damping from logs: files, or columns of arrays.

use std::fmt::Write;

use clap::ValueEnum;
use numpy::PyArray1;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use stillbeam_sim::error::Error;
use stillbeam_sim::identify::arm::Sensor;
use stillbeam_sim::identify::forced::Lowpass;
use stillbeam_sim::identify::log::{Columns, Kind, Log, Sign};
use stillbeam_sim::identify::{Identified, Request, scene as fitted};

use crate::error::refused;
use crate::scene::{Scene, json};

/// Options by keyword, all of which may be absent.
struct Options<'a, 'py>(&'a Bound<'py, PyDict>);

impl Options<'_, '_> {
    fn get<T: for<'a, 'py> FromPyObject<'a, 'py, Error = PyErr>>(
        &self,
        key: &str,
    ) -> PyResult<Option<T>> {
        let value = self.0.get_item(key)?.filter(|value| !value.is_none());
        value.map(|value| value.extract::<T>()).transpose()
    }

    fn number(&self, key: &str) -> PyResult<Option<f64>> {
        self.get(key)
    }

    /// Returns one of a key's words.
    fn word<T: ValueEnum>(&self, key: &str) -> PyResult<Option<T>> {
        let Some(word): Option<String> = self.get(key)? else { return Ok(None) };
        word_of(key, &word).map(Some)
    }
}

/// Returns the value of a word.
fn word_of<T: ValueEnum>(key: &str, word: &str) -> PyResult<T> {
    T::from_str(word, false).map_err(|_| {
        let known = T::value_variants().iter().filter_map(ValueEnum::to_possible_value);
        let known: Vec<String> = known.map(|value| value.get_name().to_owned()).collect();
        let text = format!("{key} = \"{word}\": must be one of {}", known.join(", "));
        refused(Error::new(text))
    })
}

/// Returns the request without its logs.
fn request(scene: Option<&Scene>, keywords: &Bound<'_, PyDict>) -> PyResult<Request> {
    let options = Options(keywords);
    let free: Vec<String> = options.get("free")?.unwrap_or_default();
    let lowpass: Option<(f64, f64)> = options.get("sensor_lowpass")?;
    let sensor = match (options.number("sensor_at")?, options.number("sensor_mass")?) {
        (Some(at), Some(mass)) => Some(Sensor { at, mass }),
        (None, None) => None,
        _ => {
            let text = "sensor_at and sensor_mass: one is missing; must be given together";
            return Err(refused(Error::new(text)));
        }
    };
    Ok(Request {
        logs: Vec::new(),
        columns: Columns {
            time: options.get("time")?,
            hub: options.get("hub")?,
            sensor: options.get("sensor")?,
            kind: options.word::<Kind>("kind")?,
        },
        sign: options.word::<Sign>("sign")?.unwrap_or_default(),
        from: options.number("start")?,
        to: options.number("end")?,
        modes: options.get("modes")?,
        lowpass: lowpass.map(|(frequency, ratio)| Lowpass { frequency, ratio }),
        sensor,
        free: free.iter().map(|word| word_of("free", word)).collect::<PyResult<_>>()?,
        scene: scene.map(|scene| (scene.file.name.clone(), scene.file.arm)),
    })
}

/// Finds frequencies and damping in logs, as the command line's `identify` does.
#[pyfunction]
pub fn identify<'py>(
    py: Python<'py>,
    logs: Vec<Bound<'py, PyAny>>,
    scene: Option<&Scene>,
    keywords: &Bound<'py, PyDict>,
) -> PyResult<Bound<'py, PyDict>> {
    let request = request(scene, keywords)?;
    let texts = logs
        .iter()
        .enumerate()
        .map(|(index, log)| text_of(log, index))
        .collect::<PyResult<Vec<_>>>()?;
    let identified = py.detach(|| {
        let read = |(name, text): &(String, String)| {
            Log::parse(name, text, &request.columns, request.sign)
        };
        request.identify(texts.iter().map(read).collect::<Result<_, _>>()?)
    });
    let identified = identified.map_err(refused_here)?;
    let result = PyDict::new(py);
    result.set_item("report", json(py, &identified.report)?)?;
    result.set_item("panels", panels(py, &identified)?)?;
    result.set_item("scene", scene_of(py, scene, &request, &identified)?)?;
    Ok(result)
}

/// Returns the error of an option with the name that it has in Python.
fn refused_here(error: Error) -> PyErr {
    let mut text = error.to_string();
    for (option, keyword) in [
        ("--sensor-lowpass", "sensor_lowpass"),
        ("--sensor-mass", "sensor_mass"),
        ("--sensor-at", "sensor_at"),
        ("--sensor", "sensor"),
        ("--scene", "scene"),
        ("--from", "start"),
        ("--modes", "modes"),
        ("--time", "time"),
        ("--kind", "kind"),
        ("--free", "free"),
        ("--hub", "hub"),
        ("--to", "end"),
    ] {
        text = text.replace(option, keyword);
    }
    refused(Error::new(text))
}

/// Returns name and text of a log: a file's, or columns by name written as a CSV whose numbers are
/// read back to the bit.
fn text_of(log: &Bound<'_, PyAny>, index: usize) -> PyResult<(String, String)> {
    if let Ok(path) = log.py().import("os")?.call_method1("fspath", (log,)) {
        let path: String = path.extract()?;
        let text = std::fs::read_to_string(&path).map_err(|cause| {
            refused(Error::file(path.as_ref(), format_args!("{cause}; must be a log as CSV")))
        })?;
        return Ok((path, text));
    }
    let name = format!("logs[{index}]");
    let wrong = || {
        let text = format!("{name}: must be a path, or columns by name as a dict or a data frame");
        PyTypeError::new_err(text)
    };
    let keys: Vec<String> = log
        .call_method0("keys")
        .map_err(|_| wrong())?
        .try_iter()?
        .map(|key| key?.extract::<String>())
        .collect::<PyResult<_>>()
        .map_err(|_| wrong())?;
    let columns = keys
        .iter()
        .map(|key| {
            let column = log.get_item(key)?;
            let list = column.call_method0("tolist").unwrap_or(column);
            list.extract::<Vec<f64>>()
        })
        .collect::<PyResult<Vec<_>>>()?;
    let mut text = keys.join(",");
    let length = columns.first().map_or(0, Vec::len);
    for (key, column) in keys.iter().zip(&columns) {
        if column.len() != length {
            let (found, first) = (column.len(), &keys[0]);
            let text = format!("{name}.{key}: {found} rows; must be {length}, as many as {first}");
            return Err(refused(Error::new(text)));
        }
    }
    for row in 0..length {
        let mut mark = '\n';
        for column in &columns {
            // Rust writes as many digits as it takes to read the same number.
            let _ = write!(text, "{mark}{:?}", column[row]);
            mark = ',';
        }
    }
    text.push('\n');
    Ok((name, text))
}

/// Returns measured and fitted values of each log.
fn panels<'py>(py: Python<'py>, identified: &Identified) -> PyResult<Bound<'py, PyList>> {
    let panels = PyList::empty(py);
    for panel in &identified.panels {
        let entry = PyDict::new(py);
        entry.set_item("log", &panel.log)?;
        for (name, values) in
            [("time", &panel.time), ("measured", &panel.measured), ("fitted", &panel.fitted)]
        {
            entry.set_item(name, PyArray1::from_slice(py, values))?;
        }
        panels.append(entry)?;
    }
    Ok(panels)
}

/// Returns the scene with the fitted values in it.
fn scene_of(
    py: Python<'_>,
    scene: Option<&Scene>,
    request: &Request,
    identified: &Identified,
) -> PyResult<Option<Scene>> {
    let (Some(scene), Some(arm)) = (scene, &identified.arm) else { return Ok(None) };
    let logs = &identified.report.logs;
    let text = fitted::fitted(&scene.text, arm, &request.free, logs).map_err(refused)?;
    Scene::parse(py, &scene.file.name, text).map(Some).map_err(refused)
}
