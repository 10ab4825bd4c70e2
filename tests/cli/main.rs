//! The command line as a user meets it. Built as a test of `stillbeam-sim`, so that cargo builds
//! the program first and says where it is.

mod arm;
mod bad_input;
mod book;
mod commands;
mod export;
mod features;
mod first_hour;
mod identify;
mod interruption;
mod mechanisms;
mod motions;
mod notes;
mod syntax;
mod untouched;

use assert_cmd::Command;

/// The program.
fn sim() -> Command {
    Command::new(env!("CARGO_BIN_EXE_stillbeam-sim"))
}
