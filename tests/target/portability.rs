//! The core and the C binding compile for other processors, the firmware with a board's counter.

use std::fs;

use stillbeam_tests::firmware::{self, require_target, run};
use stillbeam_tests::root;

/// The least that there is, and the one that no image is built for. Between them are the processors
/// of the images, which hold the core.
const TARGETS: [&str; 2] = [firmware::SMALLEST_TARGET, "thumbv8m.main-none-eabihf"];

/// Names in the `[features]` table of a manifest.
fn features(manifest: &str) -> Vec<&str> {
    manifest
        .lines()
        .skip_while(|line| *line != "[features]")
        .skip(1)
        .take_while(|line| !line.starts_with('['))
        .filter(|line| !line.starts_with('#'))
        .filter_map(|line| line.split_once('='))
        .map(|(name, _)| name.trim())
        .filter(|name| *name != "default")
        .collect()
}

/// In the folder and with the profile of the images, so that proc macros and build scripts are
/// compiled once.
fn check(arguments: &[&str]) {
    let done = run(firmware::cargo()
        .args(["check", "--quiet", "--profile", "firmware", "--target-dir", "target/firmware"])
        .args(arguments));
    if let Err(error) = done {
        panic!("{error}");
    }
}

/// On the processor with the least: the C binding takes the core everywhere.
#[test]
fn the_core_compiles_with_every_feature_alone() {
    let manifest = fs::read_to_string(root().join("core/Cargo.toml")).expect("core/Cargo.toml");
    let features = features(&manifest);
    assert!(features.contains(&"defmt"), "{features:?}");
    let target = firmware::SMALLEST_TARGET;
    require_target(target).unwrap_or_else(|error| panic!("{error}"));
    let bare = ["--package", "stillbeam", "--no-default-features", "--target", target];
    check(&bare);
    for feature in features {
        check(&[&bare[..], &["--features", feature]].concat());
    }
}

/// The archive's processors; for the Cortex-M4F it is built and run.
#[test]
fn the_c_binding_compiles_everywhere_with_every_method() {
    for target in TARGETS {
        require_target(target).unwrap_or_else(|error| panic!("{error}"));
        check(&["--package", "stillbeam-c", "--lib", "--all-features", "--target", target]);
    }
}

#[test]
fn the_bench_compiles_for_a_board() {
    require_target(firmware::TARGET).unwrap_or_else(|error| panic!("{error}"));
    let image = ["--package", "stillbeam-firmware", "--bin", "bench", "--features", "dwt"];
    check(&[&image[..], &["--target", firmware::TARGET]].concat());
}
