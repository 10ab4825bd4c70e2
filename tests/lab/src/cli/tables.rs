//! `tables`: prints the tables of docs/accuracy.md on the terminal.

use std::process::ExitCode;

use stillbeam_lab::sweep::tables;
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

#[derive(clap::Args)]
pub struct TablesArgs {}

impl TablesArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        for block in tables::blocks(&tables::rows()?) {
            println!("{}, % of the link's length or of the peak:\n\n{}", block.name, block.text);
        }
        Ok(ExitCode::SUCCESS)
    }
}
