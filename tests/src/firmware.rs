//! Builds the images for the target.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};
use std::{env, fs};

use crate::root;

/// Target for which the images are built.
pub const TARGET: &str = "thumbv7em-none-eabihf";

/// Target of a processor without floating-point unit, for the bench.
pub const SOFT_TARGET: &str = "thumbv7m-none-eabi";

/// Target of the smallest processors, Cortex-M0 and M0+: without floating-point unit and without
/// division. A Cortex-M3 runs its code too.
pub const SMALLEST_TARGET: &str = "thumbv6m-none-eabi";

/// Target of RISC-V without floating-point unit.
pub const RISCV_TARGET: &str = "riscv32imac-unknown-none-elf";

/// Path of an image, or cargo's messages.
type Built = Result<PathBuf, String>;

/// Images that this process has built, by the name under which each is kept. Images are built one
/// after the other, because cargo gives variants of a program the same file name.
static IMAGES: Mutex<BTreeMap<String, Built>> = Mutex::new(BTreeMap::new());

/// Builds the image `name` unless this process has built it before.
fn once(name: String, build: impl FnOnce(&str) -> Built) -> Built {
    let mut images = IMAGES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(built) = images.get(&name) {
        return built.clone();
    }
    let built = build(&name);
    images.insert(name, built.clone());
    built
}

/// Builds the program `bin` and returns its image.
///
/// # Errors
/// An error is returned with cargo's messages or with the target to install.
pub fn build(bin: &str) -> Built {
    build_variant(TARGET, bin, None)
}

/// Builds the program `bin` for a processor without floating-point unit.
///
/// # Errors
/// Errors are those of [`build`].
pub fn build_soft(bin: &str) -> Built {
    build_variant(SOFT_TARGET, bin, None)
}

/// Builds the program `bin` for the smallest processors.
///
/// # Errors
/// Errors are those of [`build`].
pub fn build_smallest(bin: &str) -> Built {
    build_variant(SMALLEST_TARGET, bin, None)
}

/// Builds the program `bin` for RISC-V: `golden` or `bench`.
///
/// # Errors
/// Errors are those of [`build`].
pub fn build_riscv(bin: &str) -> Built {
    once(format!("{bin}-riscv"), |name| {
        require_target(RISCV_TARGET)?;
        let folder = root().join("target/firmware");
        let bin = format!("{bin}_riscv");
        run(cargo()
            .args(["build", "--quiet", "--package", "stillbeam-riscv", "--bin", &bin])
            .args(["--profile", "firmware", "--target", RISCV_TARGET, "--target-dir"])
            .arg(&folder))?;
        keep(&folder, RISCV_TARGET, "firmware", &bin, name)
    })
}

/// Builds `bin` with one environment variable, on which the program's source depends.
///
/// # Errors
/// Errors are those of [`build`].
pub fn build_with(bin: &str, variable: &str, value: &str) -> Built {
    build_variant(TARGET, bin, Some((variable, value)))
}

/// Builds the application for a board, by the board's feature and others behind it.
///
/// # Errors
/// Errors are those of [`build`].
pub fn application(features: &str) -> Built {
    once(application_name(features), |name| as_application("application", features, name))
}

/// Builds two axes with one method, by its name in the list of methods, as the application is
/// built.
///
/// # Errors
/// Errors are those of [`changed_application`].
pub fn fit(method: &str) -> Built {
    let other = format!("stillbeam_methods::{method};");
    changed("fit", "mps2", format!("fit-{method}"), ["stillbeam_methods::Elastica2;", &other])
}

/// Builds the application of those features after one change to `axes.rs`, as a user would make it;
/// the file itself stays. The image's name ends with `name`.
///
/// # Errors
/// Errors are those of [`build`]. An error is also returned if `from` does not stand in `axes.rs`
/// exactly once.
pub fn changed_application(features: &str, name: &str, change: [&str; 2]) -> Built {
    let name = format!("{}-{name}", application_name(features));
    changed("application", features, name, change)
}

/// Builds a program with the application's profile after one change to `axes.rs`.
fn changed(bin: &str, features: &str, name: String, [from, to]: [&str; 2]) -> Built {
    let path = root().join("wiring/src/axes.rs");
    let axes = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    if axes.matches(from).count() != 1 {
        return Err(format!("{}: \"{from}\" must stand in it once", path.display()));
    }
    once(name, |name| {
        let folder = root().join("target/firmware");
        let other = folder.join("axes.rs");
        fs::create_dir_all(&folder)
            .and_then(|()| fs::write(&other, axes.replace(from, to)))
            .map_err(|error| format!("{}: {error}", other.display()))?;
        as_application(bin, &format!("{features},_other-axes"), name)
    })
}

fn application_name(features: &str) -> String {
    format!("application-{}", features.replace(',', "-"))
}

/// Builds a program with the application's profile and keeps it under the name. For [`once`].
fn as_application(bin: &str, features: &str, name: &str) -> Built {
    require_target(TARGET)?;
    let folder = root().join("target/firmware");
    run(cargo()
        .args(["build", "--quiet", "--package", "stillbeam-firmware", "--bin", bin])
        .args(["--features", features, "--profile", "application", "--target", TARGET])
        .arg("--target-dir")
        .arg(&folder)
        .env_remove("STILLBEAM_METHOD"))?;
    keep(&folder, TARGET, "application", bin, name)
}

fn build_variant(target: &str, bin: &str, variable: Option<(&str, &str)>) -> Built {
    let variant = variable.map(|(_, value)| value).or((target != TARGET).then_some(target));
    let name = variant.map_or(bin.to_owned(), |variant| format!("{bin}-{variant}"));
    once(name, |name| {
        require_target(target)?;
        // A folder of its own: the cargo that runs the tests may hold the lock of the usual one.
        let folder = root().join("target/firmware");
        run(cargo()
            .args(["build", "--quiet", "--package", "stillbeam-firmware", "--bin", bin])
            .args(["--profile", "firmware", "--target", target, "--target-dir"])
            .arg(&folder)
            .env_remove("STILLBEAM_METHOD")
            .env_remove("STILLBEAM_FAULT")
            .envs(variable))?;
        keep(&folder, target, "firmware", bin, name)
    })
}

/// Keeps an image under a name of its own, because variants share a file name.
fn keep(folder: &Path, target: &str, profile: &str, bin: &str, name: &str) -> Built {
    let built = folder.join(target).join(profile).join(bin);
    let kept = folder.join("images").join(name);
    fs::create_dir_all(folder.join("images"))
        .and_then(|()| fs::copy(&built, &kept))
        .map_err(|error| format!("{}: {error}", kept.display()))?;
    Ok(kept)
}

/// Returns cargo in the workspace's root, without the environment that the cargo of the tests has
/// set. Flags from the environment would replace those of `.cargo/config.toml`, and a wrapper
/// around the compiler would change the code.
pub fn cargo() -> Command {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(root());
    for name in [
        "RUSTFLAGS",
        "CARGO_ENCODED_RUSTFLAGS",
        "RUSTC_WORKSPACE_WRAPPER",
        "CARGO_BUILD_TARGET",
        "CARGO_TARGET_DIR",
    ] {
        cargo.env_remove(name);
    }
    cargo
}

/// Runs a command to its end.
///
/// # Errors
/// An error is returned if the command fails. It holds the command and its output.
pub fn run(command: &mut Command) -> Result<String, String> {
    let output = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        let said = String::from_utf8_lossy(&output.stderr);
        Err(format!("{command:?}: {}\n{said}", output.status))
    }
}

/// Checks that the compiler has the target's core library.
///
/// # Errors
/// An error is returned if it is missing. It tells how to install it.
pub fn require_target(target: &str) -> Result<(), String> {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let folder = run(Command::new(rustc).current_dir(root()).args([
        "--print",
        "target-libdir",
        "--target",
        target,
    ]))?;
    if Path::new(folder.trim()).is_dir() {
        Ok(())
    } else {
        Err(format!("Rust target {target} is missing: run `rustup target add {target}`"))
    }
}
