//! Files and lines that a run of a mechanism leaves.

use std::path::{Path, PathBuf};

use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism::table::{self, Row};
use stillbeam_sim::mechanism::{MechanismScene, page};
use stillbeam_sim::output::Files;
use stillbeam_sim::println;

/// Where a run goes: its table, and a page if one is asked for, which may be shown.
pub struct Outputs<'a> {
    csv: &'a Path,
    page: Option<&'a Path>,
    open: bool,
}

impl<'a> Outputs<'a> {
    /// Takes them as they are typed, for a mechanism that is to be `done`.
    ///
    /// # Errors
    /// No file for the table, a page that is to be shown and is not written.
    pub fn new(
        csv: &'a Option<PathBuf>,
        page: &'a Option<PathBuf>,
        open: bool,
        done: &str,
    ) -> Result<Self, Error> {
        let csv = csv.as_deref().ok_or_else(|| {
            Error::new(format_args!("--csv: must be a file where a mechanism is {done}"))
        })?;
        let page = page.as_deref();
        crate::cli::refuse_to_open(open, page, "--page OUT.html")?;
        Ok(Self { csv, page, open })
    }

    /// Writes table and page, both or none. `solver` says what made the rows.
    pub fn write(&self, scene: &MechanismScene, solver: &str, rows: &[Row]) -> Result<(), Error> {
        let mut files = Files::default();
        table::add(&mut files, self.csv, rows)?;
        if let Some(path) = self.page {
            let text = page::render(scene, solver, rows, &self.csv.display().to_string())?;
            files.add(path, |file| file.write_all(text.as_bytes()))?;
        }
        files.finish().map(drop)
    }

    /// Prints the files' names and the peaks of the run, and shows the page.
    pub fn print(&self, scene: &MechanismScene, rows: &[Row]) {
        println!("  {} rows to {}", rows.len(), self.csv.display());
        if let Some(path) = self.page {
            println!("  drawn in {}", path.display());
        }
        let peak = |of: &dyn Fn(&Row) -> f64| rows.iter().map(of).fold(0.0, f64::max);
        for (j, link) in scene.mechanism.links.iter().enumerate() {
            let torque = peak(&|row| row.torques[j].abs());
            let bent = peak(&|row| row.deflections[j].abs());
            println!(
                "  joint {}  peak torque {torque:.4} N m, link deflects by {:.2} mm ({:.1} % of L)",
                j + 1,
                1e3 * bent,
                100.0 * bent / link.length
            );
        }
        if let Some(page) = self.page.filter(|_| self.open) {
            crate::cli::show(page);
        }
    }
}
