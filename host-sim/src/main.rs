//! Command line of the desktop simulation.

/// Prints a line as std's own does, but to a terminal or pipe that takes no more: there the program
/// ends, in one line where it is not a reader's choice, and does not panic. In the place of std's, so
/// that no command can forget it.
macro_rules! println {
    () => { $crate::say(format_args!("\n")) };
    ($($words:tt)*) => { $crate::say(format_args!("{}\n", format_args!($($words)*))) };
}

/// See [`println`].
macro_rules! print {
    ($($words:tt)*) => { $crate::say(format_args!($($words)*)) };
}

mod cli;

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

use clap::Parser;
use clap::error::ErrorKind as Clap;
use stillbeam_sim::error::Error;

/// Writes to standard output.
fn say(words: std::fmt::Arguments<'_>) {
    let Err(error) = std::io::stdout().write_fmt(words) else { return };
    if error.kind() == ErrorKind::BrokenPipe {
        // Somebody has read enough.
        std::process::exit(0);
    }
    complain(format_args!(
        "standard output cannot be written: {error}; it must be open and have room"
    ));
    std::process::exit(Error::EXIT_CODE.into());
}

/// One line on standard error. Where that cannot be written either, the exit code has to do.
fn complain(words: std::fmt::Arguments<'_>) {
    let _ = writeln!(std::io::stderr(), "error: {words}");
}

fn main() -> ExitCode {
    let result = match cli::Cli::try_parse() {
        Ok(cli) => cli.execute(),
        Err(error) if matches!(error.kind(), Clap::DisplayHelp | Clap::DisplayVersion) => {
            print!("{error}");
            return ExitCode::SUCCESS;
        }
        Err(error) => Err(usage(&error)),
    };
    result.unwrap_or_else(|error| {
        complain(format_args!("{error}"));
        ExitCode::from(Error::EXIT_CODE)
    })
}

/// The first paragraph of clap's message, without its own `error:`: one line.
fn usage(error: &clap::Error) -> Error {
    let text = error.to_string();
    let message = text.split("\n\nUsage").next().unwrap_or(&text);
    Error::new(message.trim_start_matches("error:").split("\n\nFor more").next().unwrap_or(message))
}
