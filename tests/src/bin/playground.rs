//! Writes the page of the playground.

use std::process::ExitCode;

use stillbeam_tests::playground;

fn main() -> ExitCode {
    let written = playground::build().and_then(|page| {
        let path = playground::page();
        std::fs::write(&path, page).map_err(|error| format!("{}: {error}", path.display()))
    });
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
