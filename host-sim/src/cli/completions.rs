//! `completions` and `man`: the command line described for shells and for `man`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::CommandFactory;
use clap_complete::{Shell, generate};
use clap_mangen::Man;
use stillbeam_sim::error::Error;
use stillbeam_sim::output::Files;
use stillbeam_sim::println;

use super::Cli;

/// Name of the program.
const NAME: &str = "stillbeam-sim";

#[derive(clap::Args)]
pub struct CompletionsArgs {
    /// Shell that is to complete words
    shell: Shell,
}

impl CompletionsArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let mut script = Vec::new();
        generate(self.shell, &mut Cli::command(), NAME, &mut script);
        stillbeam_sim::console::say(format_args!("{}", String::from_utf8_lossy(&script)));
        Ok(ExitCode::SUCCESS)
    }
}

#[derive(clap::Args)]
pub struct ManArgs {
    /// Folder for the pages, one a command
    #[arg(value_name = "DIR", default_value = "man")]
    out: PathBuf,
}

impl ManArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let mut command = Cli::command();
        // Gives the subcommands the names that they are called by.
        command.build();
        let mut files = Files::default();
        for part in std::iter::once(&command).chain(command.get_subcommands()) {
            let name = part.get_display_name().unwrap_or(NAME);
            let man = Man::new(part.clone());
            files.add(&self.out.join(format!("{name}.1")), |mut file| man.render(&mut file))?;
        }
        let pages = files.finish()?;
        println!("{} pages in {}", pages.len(), self.out.display());
        Ok(ExitCode::SUCCESS)
    }
}
