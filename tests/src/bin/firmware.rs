//! Writes the firmware's numbers and its transcript into docs/firmware.md.

use std::process::ExitCode;

use stillbeam_tests::{firmware_page, root};

fn main() -> ExitCode {
    let written = firmware_page::blocks().and_then(|mut blocks| {
        blocks.push(firmware_page::axes()?);
        let path = root().join("docs/firmware.md");
        let page = std::fs::read_to_string(&path).map_err(|e| format!("{path:?}: {e}"))?;
        let page = firmware_page::replace(&page, &blocks)?;
        std::fs::write(&path, page).map_err(|e| format!("{path:?}: {e}"))
    });
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
