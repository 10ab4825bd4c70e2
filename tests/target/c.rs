//! The C binding on a bare Cortex-M4F: the same bits and nearly the same size as the same program
//! in Rust, and a tick from which no panic can be reached.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use stillbeam_tests::emulator::{self, Clock, LIMIT};
use stillbeam_tests::firmware::{self, TARGET, cargo, require_target, run};
use stillbeam_tests::{image, root};

/// Bytes that the examples send at a tick: a setpoint and the drive's payload.
const RECORD: usize = 40 + 8;

/// Builds the archive with one method, as a user does.
fn archive() -> Result<PathBuf, String> {
    require_target(TARGET)?;
    let folder = root().join("target/firmware");
    run(cargo()
        .args(["rustc", "--quiet", "--package", "stillbeam-c", "--lib"])
        .args(["--crate-type", "staticlib", "--no-default-features", "--features", "elastica2"])
        .args(["--profile", "firmware", "--target", TARGET, "--target-dir"])
        .arg(&folder))?;
    Ok(folder.join(TARGET).join("firmware/libstillbeam_c.a"))
}

/// Compiles a program for the Cortex-M4F and links it with the archive, without a C library.
fn link(main: &Path, name: &str) -> Result<PathBuf, String> {
    static ARCHIVE: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    let archive = ARCHIVE.get_or_init(archive).clone()?;
    let binding = root().join("bindings/c");
    let board = binding.join("examples/cortex-m4f");
    let linked = root().join("target/firmware").join(name);
    let compiler = "arm-none-eabi-gcc";
    let mut command = Command::new(compiler);
    command
        .args(["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"])
        .args(["-std=c11", "-Os", "-ffreestanding", "-ffunction-sections", "-fdata-sections"])
        .args(["-Wall", "-Wextra", "-Werror", "-nostdlib", "-Wl,--gc-sections"])
        .arg(format!("-Wl,-T,{}", board.join("link.ld").display()))
        .arg("-I")
        .arg(binding.join("include"))
        .arg("-I")
        .arg(&board)
        .args([main, &board.join("board.c"), &archive])
        .arg("-o")
        .arg(&linked);
    run(&mut command).map_err(|error| {
        format!("{error}\n{compiler}: apt-get install --no-install-recommends gcc-arm-none-eabi")
    })?;
    Ok(linked)
}

/// The example in C, linked.
fn example() -> PathBuf {
    static IMAGE: OnceLock<PathBuf> = OnceLock::new();
    let build = || link(&root().join("bindings/c/examples/cortex-m4f/main.c"), "c-example.elf");
    IMAGE.get_or_init(|| build().unwrap_or_else(|error| panic!("{error}"))).clone()
}

/// The same program in Rust.
fn in_rust() -> PathBuf {
    firmware::build("prepared_axis").unwrap_or_else(|error| panic!("{error}"))
}

fn sent(image: &Path) -> Vec<u8> {
    emulator::run(image, Clock::Host, LIMIT).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn every_bit_of_the_example_agrees_with_rust() {
    let (c, rust) = (sent(&example()), sent(&in_rust()));
    assert_eq!(c.len(), 61 * RECORD);
    for (k, (c, rust)) in c.chunks(RECORD).zip(rust.chunks(RECORD)).enumerate() {
        assert_eq!(c, rust, "tick {k}");
    }
    assert_eq!(c.len(), rust.len());
    // The arm bends: the last word of a setpoint is its deflection.
    let tip = |record: &[u8]| f32::from_le_bytes(record[36..40].try_into().expect("four bytes"));
    assert!(c.chunks(RECORD).any(|record| tip(record).abs() > 0.01));
}

#[test]
fn the_example_is_no_larger_than_in_rust_by_more_than_a_tenth() {
    let size = |image: &Path| image::footprint(image).unwrap_or_else(|error| panic!("{error}"));
    let (c, rust) = (size(&example()), size(&in_rust()));
    println!("C {c:?}, Rust {rust:?}");
    assert!(10 * c.flash <= 11 * rust.flash, "C {c:?}, Rust {rust:?}");
    // The page tells both, to a hundredth.
    let page = std::fs::read_to_string(root().join("docs/c.md")).expect("docs/c.md");
    for (row, flash) in [("the example in C", c.flash), ("the same in Rust", rust.flash)] {
        let told = page.lines().find_map(|line| line.strip_prefix(&format!("| {row} | ")));
        let told = told.unwrap_or_else(|| panic!("docs/c.md: no row of {row}"));
        let told: u64 = told.replace([',', '|', ' '], "").parse().expect("bytes");
        assert!(told.abs_diff(flash) * 100 <= flash, "docs/c.md: {row} = {told}, is {flash}");
    }
}

/// A program that only ticks: what `sb_tick`, `sb_follow` and `sb_missed` can reach.
const TICKS: &str = r#"
#include "stillbeam.h"
static sb_arm arm;
int main(void)
{
    sb_setpoint at;
    const sb_hub hub = {0, 0.0f, 0.0f, 0.0f};
    return sb_missed(&arm, 1) + sb_tick(&arm, &at) + sb_follow(&arm, &hub, &at);
}
"#;

/// A program that sets an arm up on the target, which may take libm.
const SET_UP: &str = r#"
#include "stillbeam.h"
static sb_arm arm;
int main(void)
{
    const sb_scene scene = {.length = 0.4, .mass = 0.0224, .bending_stiffness = 0.46};
    const sb_setup setup = {.abi = SB_ABI, .tick = 0.01, .acceleration = 100.0};
    return sb_init_scene(&arm, sizeof arm, &scene, &setup);
}
"#;

#[test]
fn no_panic_is_reachable_from_the_calls_of_the_interrupt() {
    let folder = tempfile::tempdir().expect("a folder");
    let main = folder.path().join("ticks.c");
    std::fs::write(&main, TICKS).expect("ticks.c");
    let set_up = folder.path().join("set_up.c");
    std::fs::write(&set_up, SET_UP).expect("set_up.c");
    let ticks = link(&main, "c-ticks.elf").unwrap_or_else(|error| panic!("{error}"));
    // A handler of panics is in every archive; here nothing calls it, so that it is left out.
    let unwanted = |name: &&String| ["panic", "unwind", "libm"].iter().any(|n| name.contains(n));
    let functions = |image: &Path| image::functions(image).unwrap_or_else(|e| panic!("{e}"));
    let linked = functions(&ticks);
    assert!(linked.iter().any(|name| name == "sb_tick"), "{linked:?}");
    assert_eq!(linked.iter().find(unwanted), None);
    // The check can fail: setting an arm up takes functions of the C library's kind.
    let set_up = link(&set_up, "c-set-up.elf").unwrap_or_else(|error| panic!("{error}"));
    assert!(functions(&set_up).iter().any(|name| unwanted(&name)));
}
