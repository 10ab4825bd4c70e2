//! `tables`: README's numbers, by a command.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::sweep::tables;
use stillbeam_sim::error::Error;
use stillbeam_sim::{output, println};

#[derive(clap::Args)]
pub struct TablesArgs {
    /// A text with <!-- table:accuracy --> or <!-- table:torque --> and <!-- /table -->
    #[arg(value_name = "README.md")]
    text: PathBuf,
    /// Change nothing; exit with 1 where the errors in the text are no longer true
    #[arg(long)]
    check: bool,
}

impl TablesArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let path = &self.text;
        let text = std::fs::read_to_string(path).map_err(|cause| {
            Error::file(path, format_args!("{cause}; it must be a text file that can be read"))
        })?;
        // Faults in the text show before the sweep runs.
        tables::fill(&text, &[]).map_err(|error| error.within(path.display()))?;
        let rows = tables::rows()?;
        if self.check {
            return Ok(match tables::difference(&text, &rows)? {
                None => {
                    println!("{}: the tables are true", path.display());
                    ExitCode::SUCCESS
                }
                Some(line) => {
                    println!("{}: {line}", path.display());
                    println!("  `cargo lab tables {}` fills them anew", path.display());
                    ExitCode::FAILURE
                }
            });
        }
        let filled = tables::fill(&text, &rows)?;
        output::write_whole(path, |file| file.write_all(filled.as_bytes()))?;
        println!("{}: filled", path.display());
        Ok(ExitCode::SUCCESS)
    }
}
