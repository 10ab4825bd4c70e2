//! The image: its sizes, what is in it, and which one is run.

use std::path::Path;

use stillbeam_sim::talk::{DEMONSTRATION, Machine, STILL};
use stillbeam_tests::{firmware, image};

use crate::session::{begin, run, status};

/// Whole application on the emulated board. Until arms had joints that give, offset payloads and
/// mounts it was 64 and 16 KiB; 68 KiB of flash until drives were watched and moves held against
/// their frames, until it recorded and took changes of mind; 77 KiB until newmark refused ticks
/// that hide the stiffness.
const FLASH: u64 = 78 * 1024;
const RAM: u64 = 19 * 1024;
/// With the planner of still moves: until then 116 and 32 KiB, and 128 KiB of flash.
const STILL_FLASH: u64 = 135 * 1024;
const STILL_RAM: u64 = 41 * 1024;

#[test]
fn the_application_keeps_its_budgets() {
    let images = [
        ("mps2", &DEMONSTRATION[..], FLASH, RAM),
        ("mps2,still", &STILL[..], STILL_FLASH, STILL_RAM),
    ];
    for (features, steps, flash, ram) in images {
        let image = firmware::application(features).unwrap_or_else(|error| panic!("{error}"));
        let footprint = image::footprint(&image).unwrap_or_else(|error| panic!("{error}"));
        let mut session = begin(features);
        run(&mut session, steps);
        let stack = u64::from(status(&mut session).stack);
        println!("{features}: {footprint:?}, stack {stack}");
        assert!(footprint.flash <= flash, "{features}: {footprint:?}");
        assert!(stack > 1000, "the paint was really there: {stack}");
        // Statics grow up, the stack down: what is left between them is still painted.
        assert!(footprint.ram + stack < ram, "{features}: {footprint:?}, stack {stack}");
    }
}

/// A stop may come out of any tick; no panic may.
#[test]
fn no_panic_is_reachable_from_an_axis_tick() {
    let image = firmware::build("no_panic_axis").unwrap_or_else(|error| panic!("{error}"));
    let functions = image::functions(&image).unwrap_or_else(|error| panic!("{error}"));
    // The ticks are really in there.
    assert!(functions.iter().any(|name| name.contains("axis")), "{functions:#?}");
    let error =
        firmware::build_with("no_panic_axis", "STILLBEAM_FAULT", "panic").expect_err("a panic");
    assert!(error.contains("panic-never"), "{error}");
}

/// Built and measured, not run: there are no such boards here, and QEMU has none.
#[test]
fn the_nucleo_boards_build_and_fit() {
    for (features, flash) in [
        ("nucleo-g474re", 96 * 1024),
        ("nucleo-g474re,still", 154 * 1024),
        ("nucleo-g491re", 96 * 1024),
    ] {
        let image = firmware::application(features).unwrap_or_else(|error| panic!("{error}"));
        let footprint = image::footprint(&image).unwrap_or_else(|error| panic!("{error}"));
        println!("{features}: {footprint:?}");
        assert!((20_000..flash).contains(&footprint.flash), "{footprint:?}");
        assert!(footprint.ram < 16 * 1024, "{footprint:?}");
    }
}

#[test]
fn a_missing_image_is_named_with_how_to_build_it() {
    let Err(error) = Machine::emulate(Path::new("no-such-image")) else { panic!("it is missing") };
    let error = error.to_string();
    assert!(error.contains("no-such-image") && error.contains("--profile application"), "{error}");
}

/// An image names its board: one of another board is no image to run in QEMU.
#[test]
fn an_image_of_another_board_is_refused() {
    let image = firmware::application("nucleo-g474re").unwrap_or_else(|error| panic!("{error}"));
    let Err(error) = Machine::emulate(&image) else { panic!("it is for another board") };
    let error = error.to_string();
    assert!(error.contains("board = nucleo-g474re: must be mps2"), "{error}");
    assert!(error.contains("--features mps2"), "{error}");
}

/// The golden run names no board: it is not taken for the application.
#[test]
fn another_image_is_refused() {
    let image = firmware::build("golden").unwrap_or_else(|error| panic!("{error}"));
    let Err(error) = Machine::emulate(&image) else { panic!("it is not the application") };
    assert!(error.to_string().contains("no board is named in it"), "{error}");
}
