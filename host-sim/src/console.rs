//! Output to the terminal: lines, one line for an error, and an exit code.

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

use clap::Parser;
use clap::error::ErrorKind as Clap;

use crate::error::Error;
use crate::scene_file::SceneFile;
use crate::scenes;

/// Prints a line as std's macro does, but does not panic. If the line cannot be written, the
/// program ends with one line, or silently if a reader closed the pipe.
#[macro_export]
macro_rules! println {
    () => { $crate::console::say(format_args!("\n")) };
    ($($words:tt)*) => { $crate::console::say(format_args!("{}\n", format_args!($($words)*))) };
}

/// Writes to standard output; see [`println!`](crate::println).
pub fn say(words: std::fmt::Arguments<'_>) {
    let Err(error) = std::io::stdout().write_fmt(words) else { return };
    if error.kind() == ErrorKind::BrokenPipe {
        // Somebody has read enough.
        std::process::exit(0);
    }
    complain(format_args!("standard output: {error}; must be one that can be written"));
    std::process::exit(Error::EXIT_CODE.into());
}

/// Writes one line to standard error. If that fails too, only the exit code tells.
fn complain(words: std::fmt::Arguments<'_>) {
    let _ = writeln!(std::io::stderr(), "error: {words}");
}

/// Parses the command line, carries it out, and turns an error into one line and exit code 2.
pub fn run<C: Parser>(execute: impl FnOnce(C) -> Result<ExitCode, Error>) -> ExitCode {
    let result = match C::try_parse() {
        Ok(command) => execute(command),
        Err(error) if matches!(error.kind(), Clap::DisplayHelp | Clap::DisplayVersion) => {
            say(format_args!("{error}"));
            return ExitCode::SUCCESS;
        }
        Err(error) => Err(usage(&error)),
    };
    result.unwrap_or_else(|error| {
        complain(format_args!("{error}"));
        ExitCode::from(Error::EXIT_CODE)
    })
}

/// Returns the first paragraph of clap's message as one line, without its own `error:`.
fn usage(error: &clap::Error) -> Error {
    let text = error.to_string();
    let message = text.split("\n\nUsage").next().unwrap_or(&text);
    Error::new(message.trim_start_matches("error:").split("\n\nFor more").next().unwrap_or(message))
}

/// Writes a line that is no error to standard error. Ignores a failure to write it.
pub fn note(words: &str) {
    let _ = writeln!(std::io::stderr(), "note: {words}");
}

/// Opens a scene and notes its values that are probably in another unit.
pub fn open(name_or_path: &str) -> Result<SceneFile, Error> {
    remarked(scenes::open(name_or_path)?)
}

/// Opens a scene as [`open()`] does, but a file may be without moves.
pub fn open_arm(name_or_path: &str) -> Result<SceneFile, Error> {
    remarked(scenes::open_arm(name_or_path)?)
}

fn remarked(scene: SceneFile) -> Result<SceneFile, Error> {
    for line in &scene.remarks {
        note(line);
    }
    Ok(scene)
}
