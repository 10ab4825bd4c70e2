//! `plant`: runs random axes with their drives and machines under faults.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::markers::Block;
use stillbeam_lab::pages::Target;
use stillbeam_lab::plant::{self, Fault, table};
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

use super::{counted, unbroken};

#[derive(clap::Args)]
pub struct PlantArgs {
    /// A page with <!-- lab:robustness --> to be filled
    #[arg(value_name = "drive.md")]
    page: Option<PathBuf>,
    /// Runs a kind of fault, some 3 s of motion each
    #[arg(long, value_name = "N", default_value_t = 1_250)]
    count: u64,
    /// Seed of the runs
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
}

impl PlantArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let seed = self.seed;
        let count = counted(self.count)?;
        let page = Target::open(self.page, ["robustness"])?;
        let rows = with_bar("runs", Fault::ALL.len() as u64 * count, |done| {
            plant::all(seed, count, &|| done(1))
        })?;
        let text = format!(
            "`cargo lab plant --count {count} --seed {seed}`\n\n{}",
            table::markdown(&rows)
        );
        match page {
            Some(page) => page.fill(&[Block::new("robustness", text)])?,
            None => println!("{text}"),
        }
        Ok(unbroken(rows.iter().flat_map(|(_, outcome)| &outcome.broken)))
    }
}
