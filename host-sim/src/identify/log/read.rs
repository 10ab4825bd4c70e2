//! Reads a log's rows.

use std::path::Path;

use super::columns::{Column, Columns, Found};
use super::{FEWEST, Log, Sign};
use crate::error::Error;

impl Log {
    /// Reads the columns of a CSV. Numbers become SI by the unit in which a column's name ends.
    ///
    /// Rows with the time of the row before, and rows without a number, are left out and counted.
    ///
    /// # Errors
    /// An error is returned if a column is missing, a cell is no number, times run back, or fewer
    /// than eight rows are left.
    pub fn read(path: &Path, columns: &Columns, sign: Sign) -> Result<Self, Error> {
        let text = std::fs::read_to_string(path)
            .map_err(|cause| Error::file(path, format_args!("{cause}; it must be a log as CSV")))?;
        Self::parse(&path.display().to_string(), &text, columns, sign)
    }

    /// Reads the text of a CSV as [`Self::read`] does. Errors begin with `name`.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse(name: &str, text: &str, columns: &Columns, sign: Sign) -> Result<Self, Error> {
        Self::rows(name, text, columns, sign).map_err(|error| error.within(name))
    }

    fn rows(name: &str, text: &str, columns: &Columns, sign: Sign) -> Result<Self, Error> {
        let text = text.trim_start_matches('\u{feff}');
        let mut csv = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .comment(Some(b'#'))
            .delimiter(delimiter(text))
            .from_reader(text.as_bytes());
        let header: Vec<String> =
            csv.headers().map_err(Error::new)?.iter().map(str::to_owned).collect();
        let found = columns.find(&header)?;
        let mut log = Self::empty(name, &found);
        let flip = if sign == Sign::Minus { -1.0 } else { 1.0 };
        let mut first = None;
        for record in csv.records() {
            let record = record.map_err(|error| refusal(&error))?;
            let line = record.position().map_or(0, csv::Position::line);
            let number = |column: &Column| number(&record, column, line);
            let (time, sensor) = (number(&found.time)?, number(&found.sensor)?);
            let hub = found.hub.as_ref().map(&number).transpose()?;
            if !(time.is_finite() && sensor.is_finite() && hub.is_none_or(f64::is_finite)) {
                log.empty += 1;
                continue;
            }
            let time = time - *first.get_or_insert(time);
            match log.time.last() {
                Some(&last) if time == last => {
                    log.same_time += 1;
                    continue;
                }
                Some(&last) if time < last => {
                    let begin = first.unwrap_or(0.0);
                    return Err(Error::new(format_args!(
                        "line {line}: {} runs back from {} to {}; must rise from row to row",
                        found.time.name,
                        (last + begin) / found.time.factor,
                        (time + begin) / found.time.factor
                    )));
                }
                _ => {}
            }
            log.time.push(time);
            log.sensor.push(flip * sensor);
            log.hub.iter_mut().zip(hub).for_each(|(angles, hub)| angles.push(hub));
        }
        if log.time.len() < FEWEST {
            return Err(Error::new(format_args!(
                "{} rows with numbers; must be at least {FEWEST}",
                log.time.len()
            )));
        }
        Ok(log)
    }

    fn empty(name: &str, found: &Found) -> Self {
        let unit = if found.sensor.unit.is_empty() { "units" } else { found.sensor.unit };
        Self {
            name: name.to_owned(),
            time: Vec::new(),
            hub: found.hub.as_ref().map(|_| Vec::new()),
            sensor: Vec::new(),
            column: found.sensor.name.clone(),
            kind: found.kind,
            unit: unit.to_owned(),
            same_time: 0,
            empty: 0,
        }
    }
}

/// Returns the separator that the header has most of.
fn delimiter(text: &str) -> u8 {
    let lines = text.lines().find(|line| !line.trim_start().starts_with('#'));
    let header = lines.unwrap_or_default();
    let count = |&separator: &u8| header.bytes().filter(|&byte| byte == separator).count();
    [b'\t', b';', b','].into_iter().max_by_key(count).unwrap_or(b',')
}

/// Returns a cell in SI units. An empty one is not a number.
fn number(record: &csv::StringRecord, column: &Column, line: u64) -> Result<f64, Error> {
    let cell = record.get(column.index).unwrap_or_default();
    if cell.is_empty() {
        return Ok(f64::NAN);
    }
    let number = cell.parse::<f64>().map_err(|_| {
        Error::new(format_args!("line {line}: {} = \"{cell}\": must be a number", column.name))
    })?;
    Ok(number * column.factor)
}

fn refusal(error: &csv::Error) -> Error {
    let line = error.position().map_or(0, csv::Position::line);
    match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => Error::new(format_args!(
            "line {line}: {len} columns; must be {expected_len}, as in the header"
        )),
        _ => Error::new(format_args!("line {line}: {error}; must be CSV")),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Kind;
    use super::*;

    fn parse(text: &str) -> Result<Log, Error> {
        Log::rows("log.csv", text, &Columns::default(), Sign::Plus)
    }

    fn rows(header: &str, row: impl Fn(u32) -> String) -> String {
        let rows: Vec<String> = (0..20).map(row).collect();
        format!("{header}\n{}\n", rows.join("\n"))
    }

    #[test]
    fn units_stand_in_the_names() {
        let text = rows("time_ms;hub_angle_deg;tip_deflection_mm", |k| format!("{};90;{k}", 2 * k));
        let log = parse(&text).unwrap();
        assert!((log.time[19] - 0.038).abs() < 1e-12);
        assert!((log.hub.as_ref().unwrap()[3] - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        assert!((log.sensor[19] - 0.019).abs() < 1e-12);
        assert_eq!((log.kind, log.unit.as_str()), (Kind::Deflection, "m"));
    }

    #[test]
    fn unix_times_count_from_the_first_row() {
        let log =
            parse(&rows("t_s,tip_acceleration_g", |k| format!("{}.5,{k}", 1_700_000_000 + k)));
        let log = log.unwrap();
        assert_eq!((log.time[0], log.time[19]), (0.0, 19.0));
        assert!((log.sensor[2] - 2.0 * 9.80665).abs() < 1e-12);
    }

    #[test]
    fn rows_of_one_time_and_without_numbers_are_counted() {
        let text = rows("t_s,strain_v", |k| match k {
            4 => "3,9".to_owned(),
            7 => "7,".to_owned(),
            8 => "8,nan".to_owned(),
            _ => format!("{k},{k}"),
        });
        let log = parse(&text).unwrap();
        assert_eq!((log.time.len(), log.same_time, log.empty), (17, 1, 2));
    }

    #[test]
    fn refusals_name_the_line_and_the_column() {
        let back = rows("t_s,strain_v", |k| format!("{},1", if k == 5 { 2 } else { k }));
        let cases = [
            (back, "line 7: t_s runs back from 4 to 2; must rise from row to row"),
            (rows("a,b", |k| format!("{k},1")), "no time column among \"a, b\"; must have t_s"),
            (rows("t_s,a,b", |k| format!("{k},1,1")), "no sensor column among \"t_s, a, b\""),
            (rows("t_s,a", |k| format!("{k},1")), "--kind: missing, and column a has no unit"),
            (rows("t_s,a_m", |_| "x,1".to_owned()), "line 2: t_s = \"x\": must be a number"),
            ("t_s,a_m\n1,2\n".to_owned(), "1 rows with numbers; must be at least 8"),
        ];
        for (text, expected) in cases {
            let error = parse(&text).unwrap_err().to_string();
            assert!(error.starts_with(expected), "{error}\n{expected}");
        }
    }
}
