//! The scenes that the target runs, as Rust constants. A command writes them from the scene files,
//! a test checks them. A build script would compile the whole simulation for every target folder.

use std::fmt::Write;

use stillbeam_sim::scenes;

use crate::root;

/// Path of the file of the constants, from the workspace's root.
pub const PATH: &str = "tests/golden/src/embedded.in";

/// Returns the constants of every embedded scene. `Debug` writes these types as Rust does, and
/// every bit of a number.
///
/// # Errors
/// An error is returned if a scene file is wrong.
pub fn constants() -> Result<String, String> {
    let mut text = String::from("&[\n");
    for (name, _) in scenes::list() {
        let file = scenes::named(name)
            .ok_or_else(|| format!("{name} is listed and is no scene"))?
            .map_err(|error| error.to_string())?;
        let arm = file.arm.to_uniform().ok_or_else(|| format!("{name}: not a uniform link"))?;
        let solver = file.solver.resolve().map_err(|error| error.to_string())?;
        writeln!(
            text,
            "Run {{ name: {name:?}, scene: {:?}, from: {:?}, moves: &{:?}, tick: {:?} }},",
            arm,
            file.from,
            file.queue().ok_or_else(|| format!("{name} has waypoints"))?,
            solver.tick
        )
        .expect("a string");
    }
    Ok(text + "]\n")
}

/// Writes the constants.
///
/// # Errors
/// An error is returned if a scene file is wrong or the constants' file cannot be written.
pub fn write() -> Result<(), String> {
    let text = constants()?;
    std::fs::write(root().join(PATH), text).map_err(|error| format!("{PATH}: {error}"))
}
