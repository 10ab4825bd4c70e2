//! The table of a mechanism's run: one row a setpoint, the same columns for every solver.

use std::path::Path;

use crate::error::Error;
use crate::output::Files;
use crate::table::significant;

/// A mechanism at one time. At a jump of a commanded acceleration, and at the time of closing,
/// every value is the one from before.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// Time, s.
    pub t: f64,
    /// Relative angle of every joint, passive ones too, rad.
    pub joints: Vec<f64>,
    /// End of every link in the global frame, m: where the next joint is, the tip last.
    pub ends: Vec<[f64; 2]>,
    /// Y of every link's end in the frame of its base, m.
    pub deflections: Vec<f64>,
    /// Torque of every joint's drive, N m; 0 of passive joints.
    pub torques: Vec<f64>,
}

impl Row {
    /// Returns the tip's place, m.
    pub fn tip(&self) -> [f64; 2] {
        self.ends.last().copied().unwrap_or_default()
    }

    /// Returns the numbers of the row in the order of [`columns`].
    pub fn values(&self) -> Vec<f64> {
        let (_, inner) = self.ends.split_last().unwrap_or((&[0.0; 2], &[]));
        std::iter::once(self.t)
            .chain(self.joints.iter().copied())
            .chain(self.tip())
            .chain(self.deflections.iter().copied())
            .chain(self.torques.iter().copied())
            .chain(inner.iter().flatten().copied())
            .collect()
    }

    /// Puts a row together from numbers in the order of [`columns`].
    fn from_values(count: usize, values: &[f64]) -> Self {
        let (joints, rest) = values[1..].split_at(count);
        let (tip, rest) = rest.split_at(2);
        let (deflections, rest) = rest.split_at(count);
        let (torques, rest) = rest.split_at(count);
        let inner = rest.chunks_exact(2).chain([tip]);
        Self {
            t: values[0],
            joints: joints.to_vec(),
            ends: inner.map(|end| [end[0], end[1]]).collect(),
            deflections: deflections.to_vec(),
            torques: torques.to_vec(),
        }
    }
}

/// Returns the columns of a chain of `count` links.
pub fn columns(count: usize) -> Vec<String> {
    let each = |format: fn(usize) -> String| (1..=count).map(format);
    let inner = (1..count).flat_map(|j| [format!("end{j}_x_m"), format!("end{j}_y_m")]);
    std::iter::once("t_s".to_owned())
        .chain(each(|j| format!("joint{j}_rad")))
        .chain(["tip_x_m".to_owned(), "tip_y_m".to_owned()])
        .chain(each(|j| format!("deflection{j}_m")))
        .chain(each(|j| format!("torque{j}_nm")))
        .chain(inner)
        .collect()
}

/// Writes the table as CSV, whole or not at all: the time in twelve digits, the rest in nine.
pub fn write(path: &Path, rows: &[Row]) -> Result<(), Error> {
    let mut files = Files::default();
    add(&mut files, path, rows)?;
    files.finish().map(drop)
}

/// Adds the table as CSV to files that are written together.
pub fn add(files: &mut Files, path: &Path, rows: &[Row]) -> Result<(), Error> {
    files.add(path, |file| {
        let mut csv = csv::Writer::from_writer(file);
        csv.write_record(columns(rows.first().map_or(0, |row| row.joints.len())))?;
        for row in rows {
            let digits = |(k, x): (usize, &f64)| significant(*x, if k == 0 { 12 } else { 9 });
            csv.write_record(row.values().iter().enumerate().map(digits).map(|x| x.to_string()))?;
        }
        csv.flush()
    })
}

/// Reads the table of a chain of `count` links. Refuses other columns, numbers that are not finite
/// and times that do not rise.
pub fn read(path: &Path, count: usize) -> Result<Vec<Row>, Error> {
    let refuse = |text: std::fmt::Arguments<'_>| Err(Error::file(path, text));
    let mut csv = csv::Reader::from_path(path).map_err(|error| {
        Error::file(path, format_args!("{error}; it must be a CSV of run or reference"))
    })?;
    let header = csv.headers().cloned().unwrap_or_default();
    let wanted = columns(count);
    if let Some(k) = (0..wanted.len().max(header.len()))
        .find(|&k| header.get(k) != wanted.get(k).map(String::as_str))
    {
        return refuse(format_args!(
            "column {} is {}, must be {}, of the table of a mechanism of {count} links",
            k + 1,
            header.get(k).unwrap_or("absent"),
            wanted.get(k).map_or("absent", String::as_str)
        ));
    }
    let mut rows: Vec<Row> = Vec::new();
    for (index, record) in csv.records().enumerate() {
        let line = index + 2;
        let record = record.map_err(|error| Error::file(path, error))?;
        let mut values = Vec::new();
        for (name, text) in wanted.iter().zip(&record) {
            match text.trim().parse::<f64>() {
                Ok(value) if value.is_finite() => values.push(value),
                _ => return refuse(format_args!("line {line}: {name} = {text}: must be a number")),
            }
        }
        let row = Row::from_values(count, &values);
        if rows.last().is_some_and(|last| last.t >= row.t) {
            return refuse(format_args!(
                "line {line}: t_s = {}: must be later than the row before",
                row.t
            ));
        }
        rows.push(row);
    }
    if rows.is_empty() {
        return refuse(format_args!("no rows; it must be a CSV of run or reference"));
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_what_its_numbers_say() {
        let row = Row {
            t: 0.5,
            joints: vec![1.0, 2.0, 3.0],
            ends: vec![[4.0, 5.0], [6.0, 7.0], [8.0, 9.0]],
            deflections: vec![10.0, 11.0, 12.0],
            torques: vec![13.0, 14.0, 15.0],
        };
        assert_eq!(row.values().len(), columns(3).len());
        assert_eq!(Row::from_values(3, &row.values()), row);
        assert_eq!(columns(1).len(), 6);
    }
}
