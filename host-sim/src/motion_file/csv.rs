//! A motion as CSV: `t_s, hub_angle_rad[, hub_rate_rad_s[, hub_accel_rad_s2]]`.

use super::Row;
use crate::error::Error;

/// Columns by name. The first two must be there; others, such as those of a run, are not read.
pub(super) const COLUMNS: [&str; 4] =
    ["t_s", "hub_angle_rad", "hub_rate_rad_s", "hub_accel_rad_s2"];

/// Reads the rows of a text. Lines that begin with `#` are not read.
pub(super) fn read(name: &str, text: &str) -> Result<Vec<Row>, Error> {
    let mut csv = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.trim_start_matches('\u{feff}').as_bytes());
    let header = csv.headers().map_err(|error| Error::new(error).within(name))?.clone();
    let columns = COLUMNS.map(|column| header.iter().position(|found| found == column));
    for (column, found) in COLUMNS.iter().zip(columns).take(2) {
        if found.is_none() {
            let has = header.iter().collect::<Vec<_>>().join(", ");
            return Err(Error::new(format_args!(
                "{name}: line 1: no column {column} among \"{has}\"; must have t_s and \
                 hub_angle_rad, and may have hub_rate_rad_s and hub_accel_rad_s2"
            )));
        }
    }
    let mut rows = Vec::new();
    for record in csv.records() {
        let record = record.map_err(|error| unequal(name, &error))?;
        let place = format!("{name}: line {}", record.position().map_or(0, csv::Position::line));
        let number = |k: usize| -> Result<Option<f64>, Error> {
            let Some(cell) = columns[k].and_then(|column| record.get(column)) else {
                return Ok(None);
            };
            if cell.is_empty() && k >= 2 {
                return Ok(None);
            }
            cell.parse().map(Some).map_err(|_| {
                Error::new(format_args!("{place}: {} = \"{cell}\": must be a number", COLUMNS[k]))
            })
        };
        let (time, angle) = (number(0)?.unwrap_or(f64::NAN), number(1)?.unwrap_or(f64::NAN));
        let (rate, acceleration) = (number(2)?, number(3)?);
        rows.push(Row { time, angle, rate, acceleration, place });
    }
    if rows.is_empty() {
        return Err(Error::new(format_args!("{name}: no rows; must be two at least")));
    }
    Ok(rows)
}

fn unequal(name: &str, error: &csv::Error) -> Error {
    let line = error.position().map_or(0, csv::Position::line);
    match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => Error::new(format_args!(
            "{name}: line {line}: {len} columns; must be {expected_len}, as in the header"
        )),
        _ => Error::new(format_args!("{name}: line {line}: {error}; must be CSV")),
    }
}
