//! `stability`: maps where the methods are stable and accurate.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::stability::document::Findings;
use stillbeam_lab::stability::{map, page};
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

#[derive(clap::Args)]
pub struct StabilityArgs {
    /// Folder for the maps: a page, pictures, a CSV [default: the tables on the terminal]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl StabilityArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let findings = with_bar("maps", map::STEPS as u64, |done| Findings::compute(&|| done(1)))?;
        match &self.out {
            Some(folder) => println!("{}", page::write(folder, &findings)?.display()),
            None => findings.blocks().iter().for_each(|block| println!("{}", block.text)),
        }
        Ok(ExitCode::SUCCESS)
    }
}
