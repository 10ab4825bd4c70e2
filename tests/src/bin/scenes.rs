//! Writes the embedded scenes as constants for the target: `tests/golden/src/embedded.in`.

use std::process::ExitCode;

use stillbeam_tests::embedded;

fn main() -> ExitCode {
    match embedded::write() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
