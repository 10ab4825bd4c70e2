//! `merge`: the shards of a sweep become one table.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::sweep::merge::merge;
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

#[derive(clap::Args)]
pub struct MergeArgs {
    /// Where the rows go
    #[arg(value_name = "OUT.csv")]
    out: PathBuf,
    /// The shards, in any order
    #[arg(value_name = "SHARD.csv", required = true)]
    shards: Vec<PathBuf>,
}

impl MergeArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let rows = merge(&self.out, &self.shards)?;
        println!("{rows} cases of {} shards to {}", self.shards.len(), self.out.display());
        Ok(ExitCode::SUCCESS)
    }
}
