//! `plant`: runs random axes with their drives and machines under faults.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::markers::Block;
use stillbeam_lab::pages;
use stillbeam_lab::plant::{self, Fault, table};
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

use super::{counted, verdict};

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
        let page = self.page.map(|path| Ok::<_, Error>((pages::read(&path)?, path))).transpose()?;
        if let Some((text, path)) = &page {
            pages::has_places(path, text, ["robustness"].into_iter())?;
        }
        let rows = with_bar("runs", Fault::ALL.len() as u64 * count, |done| {
            plant::all(seed, count, &|| done(1))
        })?;
        let broken: Vec<&String> = rows.iter().flat_map(|(_, outcome)| &outcome.broken).collect();
        let text = format!(
            "`cargo lab plant --count {count} --seed {seed}`\n\n{}",
            table::markdown(&rows)
        );
        match &page {
            Some((page, path)) => {
                pages::write(path, page, &[Block::new("robustness", text)])?;
                println!("{}: filled", path.display());
            }
            None => println!("{text}"),
        }
        for line in broken.iter().take(20) {
            println!("broken: {line}");
        }
        Ok(verdict(broken.is_empty()))
    }
}
