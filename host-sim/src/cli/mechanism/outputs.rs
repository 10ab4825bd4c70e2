//! Files, lines and pictures that the rows of a mechanism leave.

use std::path::{Path, PathBuf};

use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism::table::{self, Row};
use stillbeam_sim::mechanism::{MechanismScene, page};
use stillbeam_sim::output::Files;
use stillbeam_sim::println;

use super::report::RowsReport;

/// Where rows go: a table and a page, each if asked for, and standard output.
pub struct Outputs<'a> {
    csv: Option<&'a Path>,
    page: Option<&'a Path>,
    open: bool,
    json: bool,
}

impl<'a> Outputs<'a> {
    /// Takes them as they are typed.
    ///
    /// # Errors
    /// A page that is to be shown and is not written, or whose table is not.
    pub fn new(
        csv: &'a Option<PathBuf>,
        page: &'a Option<PathBuf>,
        open: bool,
        json: bool,
    ) -> Result<Self, Error> {
        let (csv, page) = (csv.as_deref(), page.as_deref());
        crate::cli::refuse_to_open(open, page, "--page OUT.html")?;
        if page.is_some() && csv.is_none() {
            return Err(Error::new(
                "--page: no table is written, which the page names; must be beside --csv OUT.csv",
            ));
        }
        Ok(Self { csv, page, open, json })
    }

    /// Writes table and page, both or none, then prints figures and pictures. `solver` says what
    /// made the rows.
    pub fn put(&self, scene: &MechanismScene, solver: &str, rows: &[Row]) -> Result<(), Error> {
        self.write(scene, solver, rows)?;
        let report = RowsReport::of(scene, solver, rows);
        if self.json {
            crate::cli::print_json(&report)?;
        } else {
            self.print(&report);
            draw(rows);
        }
        if let Some(page) = self.page.filter(|_| self.open) {
            crate::cli::show(page);
        }
        Ok(())
    }

    fn write(&self, scene: &MechanismScene, solver: &str, rows: &[Row]) -> Result<(), Error> {
        let Some(csv) = self.csv else { return Ok(()) };
        let mut files = Files::default();
        table::add(&mut files, csv, rows)?;
        if let Some(path) = self.page {
            let text = page::render(scene, solver, rows, &csv.display().to_string())?;
            files.add(path, |file| file.write_all(text.as_bytes()))?;
        }
        files.finish().map(drop)
    }

    fn print(&self, report: &RowsReport) {
        println!("{}: {}", report.scene, report.solver);
        crate::cli::print_written(report.rows, "rows", self.csv);
        if let Some(path) = self.page {
            println!("  drawn in {}", path.display());
        }
        report.print();
    }
}

/// Draws angles and torques of all joints over time, if standard output is a terminal. A joint
/// without a drive has no torque.
pub fn draw(rows: &[Row]) {
    let end = rows.last().map_or(0.0, |row| row.t);
    let count = rows.first().map_or(0, |row| row.joints.len());
    let curve = |name: &str, j: usize, unit: &str, of: fn(&Row) -> &[f64]| {
        let values: Vec<f64> = rows.iter().map(|row| of(row)[j]).collect();
        (format!("{name} {}, {unit}", j + 1), values)
    };
    let curves = (0..count)
        .flat_map(|j| {
            [
                curve("joint", j, "rad", |row| &row.joints),
                curve("torque", j, "N m", |row| &row.torques),
            ]
        })
        .filter(|(_, values)| values.iter().any(|value| *value != 0.0));
    crate::cli::draw(curves, end);
}
