//! Writes the firmware's numbers and its transcript into the pages that have a place for them.

use std::process::ExitCode;

use stillbeam_tests::{firmware_page, root};

fn main() -> ExitCode {
    let written = firmware_page::blocks().and_then(|mut blocks| {
        blocks.push(firmware_page::axes()?);
        for name in ["docs/firmware.md", "README.md"] {
            let path = root().join(name);
            let page = std::fs::read_to_string(&path).map_err(|e| format!("{name}: {e}"))?;
            let page = firmware_page::replace(&page, &blocks)?;
            std::fs::write(&path, page).map_err(|e| format!("{name}: {e}"))?;
        }
        Ok(())
    });
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
