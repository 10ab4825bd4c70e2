//! The interpreter that the tests run in, and the package as it would be installed.

use std::path::{Path, PathBuf};
use std::process::Command;

use tempfile::TempDir;

/// Folder of the package's sources.
pub const PACKAGE: &str = env!("CARGO_MANIFEST_DIR");

/// Runs the interpreter in the package's folder with `arguments` and variables of its environment.
/// Panics with all that it has printed if it fails.
pub fn run(arguments: &[&str], variables: &[(&str, &Path)]) {
    let installed = installed();
    let mut command = Command::new(interpreter());
    command.args(arguments).current_dir(PACKAGE);
    command.envs(variables.iter().copied());
    command.env("PYTHONPATH", installed.path()).env("PYTHONDONTWRITEBYTECODE", "1");
    // Draws without a screen. What nobody asked for is an error.
    command.env("MPLBACKEND", "Agg").env("PYTHONWARNINGS", "error::DeprecationWarning:stillbeam");
    let output = command.output().expect("an interpreter that starts");
    let (out, error) =
        (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "python {}:\n{out}{error}", arguments.join(" "));
    println!("{out}{error}");
}

/// Returns the interpreter of the environment that `tests/setup` makes.
pub fn interpreter() -> PathBuf {
    let folder = target().join("python");
    let place = if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" };
    let interpreter = folder.join(place);
    assert!(
        interpreter.exists(),
        "{}: no such file; must be a Python with numpy, matplotlib, pandas and canopen, as \
         `sh tests/setup` makes it",
        interpreter.display()
    );
    interpreter
}

/// Puts the package into a folder of its own: the modules, and the extension beside them.
fn installed() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let package = folder.path().join("stillbeam");
    std::fs::create_dir(&package).expect("a folder");
    for entry in std::fs::read_dir(Path::new(PACKAGE).join("python/stillbeam")).expect("modules") {
        let entry = entry.expect("a module");
        if entry.file_type().is_ok_and(|kind| kind.is_file()) {
            std::fs::copy(entry.path(), package.join(entry.file_name())).expect("a copy");
        }
    }
    let ending = if cfg!(windows) { "pyd" } else { "abi3.so" };
    let name = package.join(format!("_stillbeam.{ending}"));
    std::fs::copy(extension(), name).expect("a copy of the extension");
    folder
}

/// Returns the extension that was built with this test. Cargo puts it beside the test or one folder
/// up.
fn extension() -> PathBuf {
    let (prefix, suffix) = (std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let name = format!("{prefix}_stillbeam{suffix}");
    let beside = folder();
    let places = [beside.join(&name), beside.join("..").join(&name)];
    let age = |path: &PathBuf| path.metadata().and_then(|data| data.modified()).ok();
    let found = places.iter().filter(|path| path.exists()).max_by_key(|path| age(path));
    found.unwrap_or_else(|| panic!("{name}: not in {}", beside.display())).clone()
}

/// Returns the folder of this test's own program.
fn folder() -> PathBuf {
    let program = std::env::current_exe().expect("a path");
    program.parent().expect("a folder").to_owned()
}

/// Returns cargo's target folder.
fn target() -> PathBuf {
    folder().join("../..")
}
