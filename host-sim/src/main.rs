//! Command line of the desktop simulation.

mod cli;

use std::process::ExitCode;

use clap::Parser;
use clap::error::ErrorKind;
use stillbeam_sim::error::Error;

fn main() -> ExitCode {
    let result = match cli::Cli::try_parse() {
        Ok(cli) => cli.execute(),
        Err(error)
            if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) =>
        {
            print!("{error}");
            return ExitCode::SUCCESS;
        }
        Err(error) => Err(usage(&error)),
    };
    result.unwrap_or_else(|error| {
        eprintln!("error: {error}");
        ExitCode::from(Error::EXIT_CODE)
    })
}

/// The first paragraph of clap's message, without its own `error:`: one line.
fn usage(error: &clap::Error) -> Error {
    let text = error.to_string();
    let message = text.split("\n\nUsage").next().unwrap_or(&text);
    Error::new(message.trim_start_matches("error:").split("\n\nFor more").next().unwrap_or(message))
}
