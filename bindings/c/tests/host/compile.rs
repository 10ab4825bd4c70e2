//! Compiles programs in C and C++ with the archive that cargo has built beside this test.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// The crate's folder.
pub fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Libraries of the system that the standard library in a host's archive needs.
const SYSTEM: [&str; 5] = ["-lgcc_s", "-lpthread", "-ldl", "-lm", "-lc"];

/// Path of the archive: cargo writes the library's crate types into one folder, with one hash. The
/// newest is that of this build.
fn archive() -> PathBuf {
    let test = env::current_exe().expect("this program");
    let built = fs::read_dir(test.parent().expect("a folder")).expect("the folder of the tests");
    let archives = built.filter_map(|entry| {
        let entry = entry.ok()?;
        let name = entry.file_name().into_string().ok()?;
        let is_archive = name.starts_with("libstillbeam_c") && name.ends_with(".a");
        Some((entry.metadata().ok()?.modified().ok()?, entry.path())).filter(|_| is_archive)
    });
    archives.max().expect("libstillbeam_c-….a, built with this test").1
}

/// The call of a compiler for `source`, below the crate's folder, with warnings as errors.
fn command(compiler: &str, flags: &[&str], source: &str) -> Command {
    let mut command = Command::new(compiler);
    command.args(["-O1", "-Wall", "-Wextra", "-Werror", "-pedantic"]).args(flags);
    for headers in ["include", "examples", "tests/host/stubs"] {
        command.arg("-I").arg(folder().join(headers));
    }
    command.arg(folder().join(source));
    command
}

fn compile(mut command: Command, source: &str) {
    let compiled = command.output();
    let compiled = compiled.unwrap_or_else(|e| panic!("{command:?}: {e}; apt-get install gcc g++"));
    let said = String::from_utf8_lossy(&compiled.stderr);
    assert!(compiled.status.success(), "{source}: {said}");
}

/// Compiles a program without linking it: for a platform of which only stubs are here.
///
/// # Panics
/// Panics if the compiler is missing or refuses the program.
pub fn check(compiler: &str, flags: &[&str], source: &str) {
    let mut command = command(compiler, flags, source);
    command.arg("-fsyntax-only");
    compile(command, source);
}

/// Compiles a program, runs it and returns what it printed.
///
/// # Panics
/// Panics if the compiler is missing or refuses the program, or if the program fails.
pub fn run(compiler: &str, flags: &[&str], source: &str) -> String {
    let build = tempfile::tempdir().expect("a folder");
    let program = build.path().join("program");
    let mut command = command(compiler, flags, source);
    command.arg(archive()).args(SYSTEM).arg("-o").arg(&program);
    compile(command, source);
    let ran = Command::new(&program).output().expect("the program");
    let said = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success(), "{source}: {}\n{said}", ran.status);
    String::from_utf8(ran.stdout).expect("text")
}
