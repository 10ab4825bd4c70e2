//! The scenes that the target runs, as Rust constants: written from the scene files by a command,
//! checked by a test. A build script would compile the whole simulation for every target folder.

use std::fmt::Write;

use stillbeam_sim::scenes;

use crate::root;

/// The file of the constants, from the workspace's root.
pub const PATH: &str = "tests/golden/src/embedded.in";

/// The constants of every embedded scene. `Debug` writes these types as Rust does, and every bit of
/// a number.
///
/// # Errors
/// What is wrong with a scene file.
pub fn constants() -> Result<String, String> {
    let mut text = String::from("&[\n");
    for (name, _) in scenes::list() {
        let file = scenes::named(name)
            .ok_or_else(|| format!("{name} is listed and is no scene"))?
            .map_err(|error| error.to_string())?;
        let solver = file.solver.resolve().map_err(|error| error.to_string())?;
        writeln!(
            text,
            "Run {{ name: {name:?}, scene: {:?}, from: {:?}, moves: &{:?}, tick: {:?} }},",
            file.arm,
            file.from,
            file.motions(),
            solver.tick
        )
        .expect("a string");
    }
    Ok(text + "]\n")
}

/// Writes the constants.
///
/// # Errors
/// What is wrong with a scene file, or why the file cannot be written.
pub fn write() -> Result<(), String> {
    let text = constants()?;
    std::fs::write(root().join(PATH), text).map_err(|error| format!("{PATH}: {error}"))
}
