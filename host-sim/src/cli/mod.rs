//! The command line: words in, a library call, lines out. One command a file.

mod compare;
mod run;
mod study;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use stillbeam_sim::error::Error;
use stillbeam_sim::scenes;

/// Feed-forward setpoints for flexible robot links, tried on the desktop.
///
/// Without a command: the paper's study, with tables and a report.
#[derive(Parser)]
#[command(name = "stillbeam-sim", version)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    /// Run the paper's study: tables and a report (also without a command)
    Study(study::StudyArgs),
    /// Run the core on a scene and write its setpoints
    Run(run::RunArgs),
    /// How far two runs of a scene are apart
    Compare(compare::CompareArgs),
    /// List the embedded scenes
    Scenes,
}

impl Cli {
    /// Carries out the command.
    pub fn execute(self) -> Result<ExitCode, Error> {
        match self.command {
            None => study::StudyArgs::default().execute(),
            Some(Command::Study(args)) => args.execute(),
            Some(Command::Run(args)) => args.execute(),
            Some(Command::Compare(args)) => args.execute(),
            Some(Command::Scenes) => {
                for (name, about) in scenes::list() {
                    println!("{name:<20} {about}");
                }
                Ok(ExitCode::SUCCESS)
            }
        }
    }
}
