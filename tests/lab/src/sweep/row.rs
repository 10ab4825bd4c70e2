//! A row of a sweep's CSV.

use std::fs::File;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use stillbeam_sim::error::Error;
use stillbeam_sim::solver::SolverKeys;
use stillbeam_sim::table::significant;

/// One case: its identification, its solver, its errors and its cost.
///
/// The columns stand in the order of the fields. Readers go by the order, after they have checked
/// that the header is [`header`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Identification of the case and its sweep.
    pub id: CaseId,
    /// Solver. A key that its method does not read is empty.
    pub keys: SolverKeys,
    /// Errors against the reference rod.
    pub errors: Errors,
    /// Cost, empty until it is measured.
    pub cost: Option<Cost>,
}

/// Names a case.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CaseId {
    /// Name of the sweep, from its contents.
    pub sweep: String,
    /// Number, from 1.
    pub case: u64,
    /// Number of cases in the sweep.
    pub cases: u64,
    /// Scene.
    pub scene: String,
}

/// Differences from the reference rod, as `compare` defines them. Infinite if the run diverged: a
/// value that is not a number, or a tip ten lengths off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Largest distance of the tips, fraction of L.
    pub tip_max: f64,
    /// Root mean square distance of the tips, fraction of L.
    pub tip_rms: f64,
    /// Difference of the residual vibrations, fraction of L; `None` if the hub keeps turning.
    pub residual: Option<f64>,
    /// Largest torque difference away from jumps, fraction of the peak torque.
    pub torque: f64,
}

/// Time and memory of a solver on the machine that ran it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// Time from scene to stepper, median, µs.
    pub setup_us: f64,
    /// Size of the state, bytes.
    pub state_bytes: u64,
    /// Size of the stepper's constants, bytes.
    pub stepper_bytes: u64,
    /// Time a tick, median, ns.
    pub tick_ns: f64,
    /// Time of the slowest tick of the run, interruptions by the machine left out, ns.
    pub worst_ns: f64,
}

const ID: [&str; 4] = ["sweep", "case", "cases", "scene"];
const ERRORS: [&str; 4] = ["tip_error_max", "tip_error_rms", "residual_error", "torque_error"];
const COST: [&str; 5] =
    ["setup_us", "state_bytes", "stepper_bytes", "tick_ns_median", "tick_ns_worst"];

/// Returns the names of the columns.
pub fn header() -> Vec<&'static str> {
    [&ID[..], &SolverKeys::NAMES, &ERRORS, &COST].concat()
}

impl Errors {
    /// Errors of a run that diverged.
    pub const DIVERGED: Self = Self {
        tip_max: f64::INFINITY,
        tip_rms: f64::INFINITY,
        residual: Some(f64::INFINITY),
        torque: f64::INFINITY,
    };

    /// Rounds to the six digits that are written.
    pub fn rounded(self) -> Self {
        Self {
            tip_max: significant(self.tip_max, 6),
            tip_rms: significant(self.tip_rms, 6),
            residual: self.residual.map(|x| significant(x, 6)),
            torque: significant(self.torque, 6),
        }
    }
}

impl Cost {
    /// Returns the processor time for a second of motion, µs. It is the cost of a tick length.
    pub fn load_us(&self, tick_s: f64) -> f64 {
        1e-3 * self.tick_ns / tick_s
    }
}

impl Row {
    /// Returns the setpoint interval, s.
    pub fn tick_s(&self) -> f64 {
        self.keys.tick.unwrap_or(f64::NAN)
    }

    /// Writes the row as CSV.
    fn write<W: std::io::Write>(&self, csv: &mut csv::Writer<W>) -> Result<(), csv::Error> {
        match &self.cost {
            Some(_) => csv.serialize(self),
            // An absent struct would be one empty field; it has five.
            None => csv.serialize((&self.id, &self.keys, &self.errors, [None::<f64>; COST.len()])),
        }
    }

    /// Returns the first fault of the numbers, if any.
    fn fault(&self) -> Option<String> {
        let e = &self.errors;
        let errors = [Some(e.tip_max), Some(e.tip_rms), e.residual, Some(e.torque)];
        for (name, value) in ERRORS.iter().zip(errors) {
            if let Some(value) = value.filter(|value| value.is_nan() || *value < 0.0) {
                return Some(format!("{name} = {value}: must be 0 or more"));
            }
        }
        let cost = self.cost?;
        let times = [(COST[0], cost.setup_us), (COST[3], cost.tick_ns), (COST[4], cost.worst_ns)];
        times
            .iter()
            .find(|(_, value)| !(0.0..f64::INFINITY).contains(value))
            .map(|(name, value)| format!("{name} = {value}: must be 0 or more"))
    }
}

/// Writes rows as CSV, behind the header.
///
/// # Errors
/// An error is returned if the file cannot be written.
pub fn write<'a>(
    file: &mut dyn std::io::Write,
    rows: impl IntoIterator<Item = &'a Row>,
) -> std::io::Result<()> {
    let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(file);
    csv.write_record(header())?;
    for row in rows {
        row.write(&mut csv)?;
    }
    csv.flush()
}

/// The rows of a file, one at a time. Each error names the file and the line.
pub struct Rows {
    path: PathBuf,
    csv: csv::Reader<File>,
    record: csv::StringRecord,
}

impl Rows {
    /// Opens a file. Refuses one with another header.
    pub fn open(path: &Path) -> Result<Self, Error> {
        let wanted = "must be a CSV of sweep";
        let refuse = |error: csv::Error| Error::file(path, format_args!("{error}; {wanted}"));
        let mut csv = csv::Reader::from_path(path).map_err(refuse)?;
        let found = csv.headers().map_err(refuse)?;
        if found != header() {
            let found = found.iter().take(4).collect::<Vec<_>>().join(",");
            return Err(Error::file(path, format_args!("header = \"{found}…\": {wanted}")));
        }
        Ok(Self { path: path.to_owned(), csv, record: csv::StringRecord::new() })
    }

    fn read(&mut self) -> Result<Option<Row>, Error> {
        if !self.csv.read_record(&mut self.record).map_err(|error| {
            Error::file(&self.path, format_args!("{error}; must be a CSV of sweep"))
        })? {
            return Ok(None);
        }
        let line = self.record.position().map_or(0, csv::Position::line);
        let refuse = |text: String| Error::file(&self.path, format_args!("line {line}: {text}"));
        let row: Row = self.record.deserialize(None).map_err(|e| refuse(self.explain(&e)))?;
        match row.fault() {
            Some(fault) => Err(refuse(fault)),
            None => Ok(Some(row)),
        }
    }

    /// Explains an error by column and value.
    fn explain(&self, error: &csv::Error) -> String {
        let csv::ErrorKind::Deserialize { err, .. } = error.kind() else {
            return error.to_string();
        };
        let field = err.field().and_then(|field| usize::try_from(field).ok());
        let name = field.and_then(|field| header().get(field).copied());
        let value = field.and_then(|field| self.record.get(field));
        match (name, value) {
            (Some(name), Some(value)) => {
                format!("{name} = \"{value}\": {}; must be what sweep writes", err.kind())
            }
            _ => format!("{}; must be what sweep writes", err.kind()),
        }
    }
}

impl Iterator for Rows {
    type Item = Result<Row, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.read().transpose()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Case `case` of three, each of another tick.
    pub fn row(case: u64, tip_max: f64, tick_ns: Option<f64>) -> Row {
        let keys = SolverKeys { tick: Some(0.001 * case as f64), ..SolverKeys::default() };
        let id = CaseId { sweep: "test".into(), case, cases: 3, scene: "d-fast".into() };
        let errors = Errors { tip_max, tip_rms: 0.5 * tip_max, residual: None, torque: 0.01 };
        let cost = tick_ns.map(|tick_ns| Cost {
            setup_us: 1.0,
            state_bytes: 24,
            stepper_bytes: 300,
            tick_ns,
            worst_ns: 2.0 * tick_ns,
        });
        Row { id, keys: keys.relevant(), errors, cost }
    }

    #[test]
    fn rows_come_back_from_the_file_they_went_to() {
        let rows =
            [row(1, 0.125, Some(40.0)), row(2, 0.25, None), row(3, f64::INFINITY, Some(1.0))];
        let mut file = tempfile::NamedTempFile::new().unwrap();
        write(&mut file, &rows).unwrap();
        let back: Vec<Row> = Rows::open(file.path()).unwrap().map(Result::unwrap).collect();
        assert_eq!(back, rows);
    }
}
