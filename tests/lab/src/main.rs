//! `cargo lab`: writes the pages of docs/ and runs the campaigns behind them.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    stillbeam_sim::console::run(cli::Cli::execute)
}
