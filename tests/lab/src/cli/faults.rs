//! `faults`: injects faults around an axis and counts the results.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::faults::{Fault, campaign, table};
use stillbeam_lab::markers::Block;
use stillbeam_lab::pages::Target;
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

use super::{counted, unbroken};

#[derive(clap::Args)]
pub struct FaultsArgs {
    /// A page with <!-- lab:faults --> to be filled
    #[arg(value_name = "stability.md")]
    page: Option<PathBuf>,
    /// Runs a kind of fault, some 13 s of motion each
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    count: u64,
    /// Seed of the runs
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
}

impl FaultsArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let seed = self.seed;
        let count = counted(self.count)?;
        let page = Target::open(self.page, ["faults"])?;
        let rows = with_bar("runs", Fault::ALL.len() as u64 * count, |done| {
            campaign::all(seed, count, &|| done(1))
        })?;
        let text = format!(
            "`cargo lab faults --count {count} --seed {seed}`\n\n{}\n{}",
            table::markdown(&rows),
            table::refusals(&rows)
        );
        match page {
            Some(page) => page.fill(&[Block::new("faults", text)])?,
            None => println!("{text}"),
        }
        Ok(unbroken(rows.iter().flat_map(|(_, outcome)| &outcome.broken)))
    }
}
