//! Command line of the desktop simulation.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    stillbeam_sim::console::run(cli::Cli::execute)
}
