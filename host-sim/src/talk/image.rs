//! The application's image: its path, and the board it is for.

use std::path::{Path, PathBuf};
use std::process::Command;

use object::{Object, ObjectSymbol};

use crate::error::Error;

/// Name of the board that QEMU emulates, as the firmware's feature is called.
const EMULATED: &str = "mps2";

/// Command that builds the image of the emulated board.
pub(super) const BUILD: &str = "cargo build -p stillbeam-firmware --bin application --features mps2 \
     --profile application --target thumbv7em-none-eabihf";

/// Path of the image below cargo's target folder.
const PLACE: &str = "thumbv7em-none-eabihf/application/application";

/// Returns the path to which `cargo build` writes the image. It lies in the target folder that
/// cargo names, so that `CARGO_TARGET_DIR` and cargo's configuration hold, or in `target` if cargo
/// names none. A `--target-dir` of the build's own cannot be known.
pub fn default_image() -> PathBuf {
    target_folder().unwrap_or_else(|| "target".into()).join(PLACE)
}

fn target_folder() -> Option<PathBuf> {
    #[derive(serde::Deserialize)]
    struct Metadata {
        target_directory: PathBuf,
    }
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let arguments = ["metadata", "--format-version", "1", "--no-deps", "--offline", "--quiet"];
    let output = Command::new(cargo).args(arguments).output().ok()?;
    let metadata: Metadata = serde_json::from_slice(&output.stdout).ok()?;
    Some(metadata.target_directory)
}

/// Checks that an image is for the emulated board. The firmware's build names the board by a
/// symbol, `_board_mps2`.
///
/// # Errors
/// An error is returned if the image is for another board or names none.
pub(super) fn check(path: &Path, elf: &[u8]) -> Result<(), Error> {
    let file = object::File::parse(elf).map_err(|error| Error::file(path, error))?;
    let board = file.symbols().find_map(|symbol| {
        symbol.name().ok()?.strip_prefix("_board_").map(|board| board.replace('_', "-"))
    });
    match board {
        Some(board) if board == EMULATED => Ok(()),
        Some(board) => Err(Error::file(
            path,
            format_args!("board = {board}: must be {EMULATED} to run in QEMU: {BUILD}"),
        )),
        None => Err(Error::file(
            path,
            format_args!("no board is named in it; must be the application's image: {BUILD}"),
        )),
    }
}
