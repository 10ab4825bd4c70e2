//! The table of a run: one row a setpoint, the same columns for every solver.

use std::path::Path;

use serde::{Deserialize, Serialize};
use stillbeam::AxisKind;

use crate::error::Error;
use crate::output::Files;

/// One row of a run's CSV.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Time, s.
    pub t_s: f64,
    /// θ, rad, not wrapped; on a linear axis the position, m.
    #[serde(alias = "hub_position_m")]
    pub hub_angle_rad: f64,
    /// θ̇, rad/s; on a linear axis m/s.
    #[serde(alias = "hub_velocity_m_s")]
    pub hub_rate_rad_s: f64,
    /// θ̈, rad/s², on a linear axis m/s²; the left-hand value at the end of a move, else the
    /// right-hand one.
    #[serde(alias = "hub_acceleration_m_s2")]
    pub hub_accel_rad_s2: f64,
    /// Tip, global X, m.
    pub tip_x_m: f64,
    /// Tip, global Y, m.
    pub tip_y_m: f64,
    /// Tip, hub-frame Y, m.
    pub deflection_m: f64,
    /// Torque into the hub, N m; jumps with the acceleration. On a linear axis the force, N.
    #[serde(alias = "force_n")]
    pub torque_nm: f64,
    /// The payload's centre, global X and Y, m: columns of arms whose payload has an offset.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub payload_x_m: Option<f64>,
    /// See [`Self::payload_x_m`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub payload_y_m: Option<f64>,
}

impl Row {
    /// Returns the numbers that every row has, in the order of [`columns`].
    pub fn numbers(&self) -> [f64; 8] {
        [
            self.t_s,
            self.hub_angle_rad,
            self.hub_rate_rad_s,
            self.hub_accel_rad_s2,
            self.tip_x_m,
            self.tip_y_m,
            self.deflection_m,
            self.torque_nm,
        ]
    }

    /// Rounds every number to the digits that are written: nine, the time twelve.
    fn rounded(self) -> Self {
        Self {
            t_s: significant(self.t_s, 12),
            hub_angle_rad: significant(self.hub_angle_rad, 9),
            hub_rate_rad_s: significant(self.hub_rate_rad_s, 9),
            hub_accel_rad_s2: significant(self.hub_accel_rad_s2, 9),
            tip_x_m: significant(self.tip_x_m, 9),
            tip_y_m: significant(self.tip_y_m, 9),
            deflection_m: significant(self.deflection_m, 9),
            torque_nm: significant(self.torque_nm, 9),
            payload_x_m: self.payload_x_m.map(|x| significant(x, 9)),
            payload_y_m: self.payload_y_m.map(|y| significant(y, 9)),
        }
    }
}

/// Rounds `x` to that many significant digits.
pub fn significant(x: f64, digits: usize) -> f64 {
    format!("{x:.*e}", digits - 1).parse().unwrap_or(x)
}

/// Columns of a linear axis, in the order of [`Row`].
const LINEAR: [&str; 8] = [
    "t_s",
    "hub_position_m",
    "hub_velocity_m_s",
    "hub_acceleration_m_s2",
    "tip_x_m",
    "tip_y_m",
    "deflection_m",
    "force_n",
];

/// Columns of an axis that turns, in the order of [`Row`].
const ROTARY: [&str; 8] = [
    "t_s",
    "hub_angle_rad",
    "hub_rate_rad_s",
    "hub_accel_rad_s2",
    "tip_x_m",
    "tip_y_m",
    "deflection_m",
    "torque_nm",
];

/// Columns of a payload whose centre is not the tip.
const PAYLOAD: [&str; 2] = ["payload_x_m", "payload_y_m"];

/// Returns the columns of an axis, in the order of [`Row`].
pub fn columns(axis: AxisKind) -> [&'static str; 8] {
    match axis {
        AxisKind::Rotary => ROTARY,
        AxisKind::Linear => LINEAR,
    }
}

/// Writes the table as CSV, whole or not at all, with the columns of that axis.
pub fn write(path: &Path, axis: AxisKind, rows: &[Row]) -> Result<(), Error> {
    let mut files = Files::default();
    add(&mut files, path, axis, rows)?;
    files.finish().map(drop)
}

/// Adds the table as CSV to files that are written together.
pub fn add(files: &mut Files, path: &Path, axis: AxisKind, rows: &[Row]) -> Result<(), Error> {
    files.add(path, |file| {
        let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(file);
        let has_payload = rows.first().is_some_and(|row| row.payload_x_m.is_some());
        let payload: &[&str] = if has_payload { &PAYLOAD } else { &[] };
        csv.write_record(columns(axis).iter().chain(payload))?;
        for row in rows {
            csv.serialize(row.rounded()).map_err(std::io::Error::other)?;
        }
        csv.flush()
    })
}

/// Reads a table. Refuses other columns, numbers that are not finite and times that do not rise.
pub fn read(path: &Path) -> Result<Vec<Row>, Error> {
    let mut csv = csv::Reader::from_path(path).map_err(|error| {
        Error::file(path, format_args!("{error}; it must be a CSV of run or reference"))
    })?;
    let header = csv.headers().cloned().unwrap_or_default();
    let mut rows: Vec<Row> = Vec::new();
    for (index, row) in csv.deserialize().enumerate() {
        let line = index + 2;
        let row: Row = row.map_err(|error| Error::file(path, explained(&error, &header)))?;
        let payload = [row.payload_x_m, row.payload_y_m].map(|x| x.unwrap_or(0.0));
        let finite = row.numbers().iter().chain(&payload).all(|value| value.is_finite());
        if !finite {
            return Err(Error::file(path, format_args!("line {line}: all numbers must be finite")));
        }
        if rows.last().is_some_and(|last| last.t_s >= row.t_s) {
            return Err(Error::file(
                path,
                format_args!("line {line}: t_s = {}: must be later than the row before", row.t_s),
            ));
        }
        rows.push(row);
    }
    if rows.is_empty() {
        return Err(Error::file(path, "no rows; it must be a CSV of run or reference"));
    }
    Ok(rows)
}

/// Returns the error of a row: its line, its column and what it must be.
fn explained(error: &csv::Error, header: &csv::StringRecord) -> String {
    let line = error.position().map_or(0, csv::Position::line);
    match error.kind() {
        csv::ErrorKind::Deserialize { err, .. } => {
            let field = err.field().and_then(|field| header.get(usize::try_from(field).ok()?));
            match field {
                Some(name) => format!("line {line}: {name}: {}; must be a number", err.kind()),
                None => format!("line {line}: {}; must be a row of run or reference", err.kind()),
            }
        }
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("line {line}: {len} columns; must be {expected_len}, as in the header")
        }
        _ => format!("{error}; it must be a CSV of run or reference"),
    }
}

/// Adds columns of numbers under one header, for figures and studies.
pub fn add_columns(
    files: &mut Files,
    path: &Path,
    header: &[&str],
    rows: &[Vec<f64>],
) -> Result<(), Error> {
    files.add(path, |file| {
        let mut csv = csv::Writer::from_writer(file);
        csv.write_record(header)?;
        for row in rows {
            csv.write_record(row.iter().map(|&x| significant(x, 9).to_string()))?;
        }
        csv.flush()
    })
}
