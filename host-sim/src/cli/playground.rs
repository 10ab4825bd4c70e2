//! `playground`: writes the page in which an arm moves.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_sim::error::Error;
use stillbeam_sim::output::write_whole;
use stillbeam_sim::playground::PAGE;
use stillbeam_sim::println;

#[derive(clap::Args)]
pub struct PlaygroundArgs {
    /// File for the page
    #[arg(long, value_name = "PAGE.html", default_value = "playground.html")]
    out: PathBuf,
    /// Show the page in the browser
    #[arg(long)]
    open: bool,
}

impl PlaygroundArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        write_whole(&self.out, |file| file.write_all(PAGE.as_bytes()))?;
        println!("{}", self.out.display());
        if self.open {
            super::show(&self.out);
        }
        Ok(ExitCode::SUCCESS)
    }
}
