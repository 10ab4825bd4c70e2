//! README's tables, filled by a sweep and checked against it.

use std::ops::Range;

use super::answers::short;
use super::execute;
use super::plan::Plan;
use super::row::Row;
use super::spec::Spec;
use stillbeam_sim::error::Error;
use stillbeam_sim::solver::SolverKeys;

/// A table that stands between `<!-- table:NAME -->` and `<!-- /table -->`.
pub struct Table {
    /// Name in the marker.
    pub name: &'static str,
    cell: fn(&Row) -> f64,
}

/// The tables there are.
pub const TABLES: [Table; 2] = [
    Table { name: "accuracy", cell: |row| 100.0 * row.errors.tip_max },
    Table { name: "torque", cell: |row| 100.0 * row.errors.torque },
];

const END: &str = "<!-- /table -->";

/// The rows of the embedded set, in the order of its plan.
pub fn rows() -> Result<Vec<Row>, Error> {
    let spec = Spec::parse("readme.toml", include_str!("../../sweeps/readme.toml"))?;
    execute::errors(&Plan::new(&spec)?)
}

/// The text with every table between markers replaced by what the rows say.
pub fn fill(text: &str, rows: &[Row]) -> Result<String, Error> {
    let mut filled = String::new();
    let mut rest = 0;
    for (table, place) in places(text)? {
        filled += &text[rest..place.start];
        filled += &format!("\n{}", table.markdown(rows));
        rest = place.end;
    }
    Ok(filled + &text[rest..])
}

/// The first difference between the tables in a text and what the rows say, none if there is none.
pub fn difference(text: &str, rows: &[Row]) -> Result<Option<String>, Error> {
    for (table, place) in places(text)? {
        let (committed, now) = (&text[place], table.markdown(rows));
        let lines = |text: &str| -> Vec<String> {
            text.lines().filter(|line| !line.trim().is_empty()).map(unaligned).collect()
        };
        let (committed, now) = (lines(committed), lines(&now));
        for line in 0..committed.len().max(now.len()) {
            let [a, b] = [&committed, &now].map(|lines| lines.get(line).map_or("", |line| line));
            if a != b {
                let name = table.name;
                return Ok(Some(format!("table:{name}, line {}: {a} is now {b}", line + 1)));
            }
        }
    }
    Ok(None)
}

/// A table's line without the blanks that align it.
fn unaligned(line: &str) -> String {
    let cells: Vec<&str> = line.trim().trim_matches('|').split('|').map(str::trim).collect();
    format!("| {} |", cells.join(" | "))
}

/// Where the tables stand in a text: between the line breaks of their markers.
fn places(text: &str) -> Result<Vec<(&'static Table, Range<usize>)>, Error> {
    const START: &str = "<!-- table:";
    let mut places = Vec::new();
    let mut from = 0;
    while let Some(at) = text[from..].find(START) {
        let begin = from + at + START.len();
        let name = text[begin..].split(" -->").next().unwrap_or_default();
        let known = TABLES.map(|table| table.name).join(", ");
        let table = TABLES.iter().find(|table| table.name == name).ok_or_else(|| {
            let name = name.chars().take(20).collect::<String>();
            Error::new(format_args!("table:{name}: must be {known}"))
        })?;
        let inside = begin + name.len() + " -->".len();
        let length = text[inside..].find(END).ok_or_else(|| {
            Error::new(format_args!("table:{name}: no end; there must be {END} after it"))
        })?;
        if text[inside..inside + length].contains(START) {
            return Err(Error::new(format_args!(
                "table:{name}: another table begins in it; there must be {END} before that"
            )));
        }
        places.push((table, inside..inside + length));
        from = inside + length;
    }
    if places.is_empty() {
        return Err(Error::new(format_args!(
            "no table; it must be a text with <!-- table:{} --> and {END} after it",
            TABLES[0].name
        )));
    }
    Ok(places)
}

impl Table {
    /// A line a solver, a column a scene. What a tick costs is not in it: a desktop's nanoseconds are
    /// another machine's, and no test could check them.
    fn markdown(&self, rows: &[Row]) -> String {
        let scenes = super::picture::scenes(rows);
        let mut solvers: Vec<SolverKeys> = Vec::new();
        for row in rows {
            if !solvers.contains(&row.keys) {
                solvers.push(row.keys);
            }
        }
        let mut lines: Vec<Vec<String>> =
            vec![[&["solver"], &scenes[..]].concat().iter().map(|s| s.to_string()).collect()];
        for keys in solvers {
            let of_solver = rows.iter().filter(|row| row.keys == keys);
            let name = super::picture::describe(keys);
            let errors = of_solver.map(|row| short((self.cell)(row)));
            lines.push([name].into_iter().chain(errors).collect());
        }
        aligned(&lines)
    }
}

/// Markdown with columns of even width; the first to the left, numbers to the right.
pub(crate) fn aligned(lines: &[Vec<String>]) -> String {
    let columns = lines.first().map_or(0, Vec::len);
    let width = |c: usize| {
        lines.iter().filter_map(|line| line.get(c)).fold(0, |most, s| most.max(s.chars().count()))
    };
    let widths: Vec<usize> = (0..columns).map(|c| width(c).max(3)).collect();
    let mut text = String::new();
    for (index, line) in lines.iter().enumerate() {
        for (c, (cell, &width)) in line.iter().zip(&widths).enumerate() {
            text +=
                &if c == 0 { format!("| {cell:<width$} ") } else { format!("| {cell:>width$} ") };
        }
        text += "|\n";
        if index == 0 {
            for (c, width) in widths.iter().enumerate() {
                let dashes = "-".repeat(width - usize::from(c > 0));
                text += &if c == 0 { format!("| {dashes} ") } else { format!("| {dashes}: ") };
            }
            text += "|\n";
        }
    }
    text
}

/// A count with a comma between its thousands.
pub(crate) fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::row::tests::row;
    use super::*;

    #[test]
    fn filling_and_checking_a_text() {
        let rows = [row(1, 0.1304, Some(40.0)), row(2, 0.002, Some(80.0))];
        let text = "# T\n<!-- table:accuracy -->\nold\n<!-- /table -->\nend\n";
        assert!(difference(text, &rows).unwrap().is_some());
        let filled = fill(text, &rows).unwrap();
        assert!(filled.contains("13.0") && filled.ends_with("<!-- /table -->\nend\n"), "{filled}");
        assert_eq!(difference(&filled, &rows).unwrap(), None);
        // What a tick took is not in it.
        assert_eq!(
            difference(&filled, &[row(1, 0.1304, None), row(2, 0.002, None)]).unwrap(),
            None
        );
        // Every cell is compared, the last too.
        let last = filled.trim_end_matches("<!-- /table -->\nend\n").trim_end();
        let cut = last.rfind(|c: char| c.is_ascii_digit()).expect("a number");
        let mut other = filled.clone();
        other.replace_range(cut..=cut, if &filled[cut..=cut] == "9" { "8" } else { "9" });
        assert!(difference(&other, &rows).unwrap().is_some());
        // Another error, to the printed digits.
        let worse = [row(1, 0.1311, Some(40.0)), row(2, 0.002, Some(80.0))];
        assert!(difference(&filled, &worse).unwrap().is_some_and(|line| line.contains("13.1")));
        // Filling twice changes nothing.
        assert_eq!(fill(&filled, &rows).unwrap(), filled);
    }

    #[test]
    fn markers_that_do_not_fit_are_refused() {
        for text in ["none", "<!-- table:accuracy -->", "<!-- table:other -->\n<!-- /table -->"] {
            assert!(fill(text, &[]).is_err(), "{text}");
        }
    }
}
