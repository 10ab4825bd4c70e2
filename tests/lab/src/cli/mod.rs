//! The lab's command line: words in, a library call, lines out. One command a file.

mod faults;
mod pareto;
mod stability;
mod still;
mod stress;
mod sweep;
mod tables;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use stillbeam_sim::error::Error;

/// Campaigns behind stillbeam's pages.
#[derive(Parser)]
#[command(name = "stillbeam-lab", version)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run many solvers on many scenes: error and time of each
    Sweep(sweep::SweepArgs),
    /// Draw a sweep's error against its time and answer what a choice costs
    Pareto(pareto::ParetoArgs),
    /// Fill the tables in README.md, or check them
    Tables(tables::TablesArgs),
    /// Fill the tables of docs/still.md and draw its picture, or check the tables
    Still(still::StillArgs),
    /// Map where the methods are stable and accurate; fill docs/stability.md, or check it
    Stability(stability::StabilityArgs),
    /// Run random scenes, far outside of what an arm is, by the million
    Stress(stress::StressArgs),
    /// Inject faults around an axis, and count what comes out
    Faults(faults::FaultsArgs),
}

impl Cli {
    /// Carries out the command.
    pub fn execute(self) -> Result<ExitCode, Error> {
        match self.command {
            Command::Sweep(args) => args.execute(),
            Command::Pareto(args) => args.execute(),
            Command::Tables(args) => args.execute(),
            Command::Still(args) => args.execute(),
            Command::Stability(args) => args.execute(),
            Command::Stress(args) => args.execute(),
            Command::Faults(args) => args.execute(),
        }
    }
}
