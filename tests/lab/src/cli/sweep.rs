//! `sweep`: measures run time against error, over many solvers and scenes.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use stillbeam_lab::sweep::plan::Plan;
use stillbeam_lab::sweep::spec::Spec;
use stillbeam_lab::sweep::{execute, row};
use stillbeam_sim::error::Error;
use stillbeam_sim::{console, output, println};

#[derive(clap::Args)]
pub struct SweepArgs {
    /// Solvers and scenes to cross, a TOML file [default: the embedded spec]
    spec: Option<PathBuf>,
    /// File for the rows, one a case
    #[arg(long, value_name = "OUT.csv")]
    csv: PathBuf,
}

impl SweepArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let spec = match &self.spec {
            Some(path) => Spec::read(path)?,
            None => Spec::embedded()?,
        };
        for scene in &spec.scenes {
            console::open(scene)?;
        }
        let plan = Plan::new(&spec)?;
        write(&plan, &self.csv)?;
        println!("{} cases to {}", plan.cases.len(), self.csv.display());
        println!("  `cargo lab pareto {} --out DIR` draws them", self.csv.display());
        Ok(ExitCode::SUCCESS)
    }
}

/// Runs a plan and writes its rows to a file. A path that cannot be written is refused first.
fn write(plan: &Plan, path: &Path) -> Result<(), Error> {
    let mut failed = None;
    output::write_whole(path, |file| match execute::rows(plan) {
        Ok(rows) => row::write(file, &rows),
        Err(error) => {
            failed = Some(error);
            Err(std::io::Error::other("a case failed"))
        }
    })
    .map_err(|error| failed.unwrap_or(error))
}
