//! The image: its sizes, what is in it, and which one is run.

use std::io::Write;
use std::path::Path;

use stillbeam_sim::talk::{DEMONSTRATION, Machine, STILL};
use stillbeam_tests::{firmware, image};

use crate::session::{begin, run, status};

/// Whole application on the emulated board, with still moves: flash, and statics with the deepest
/// stack.
const FLASH: u64 = 125 * 1024;
const RAM: u64 = 26 * 1024;
/// Where arms are set up on the target.
const SET_UP_FLASH: u64 = 161 * 1024;
const SET_UP_RAM: u64 = 30 * 1024;

/// On the boards that are built and not run: flash, and statics alone.
const NUCLEO_FLASH: u64 = 143 * 1024;
const NUCLEO_RAM: u64 = 12 * 1024;

/// Words in the names of functions that set an elastica and a planner up.
const SET_UP: [&str; 3] = ["3rod9expansion", "3rod8kinetics", "15stability_check"];

#[test]
fn the_application_keeps_its_budgets() {
    for (features, flash, ram) in [("mps2", FLASH, RAM), ("mps2,set-up", SET_UP_FLASH, SET_UP_RAM)]
    {
        let image = firmware::application(features).unwrap_or_else(|error| panic!("{error}"));
        let footprint = image::footprint(&image).unwrap_or_else(|error| panic!("{error}"));
        let stack = [&DEMONSTRATION[..], &STILL].map(|steps| {
            let mut session = begin(features);
            run(&mut session, steps);
            u64::from(status(&mut session).stack)
        });
        println!("{features}: {footprint:?}, stack {stack:?}");
        assert!(footprint.flash <= flash, "{features}: {footprint:?}");
        let stack = stack[0].max(stack[1]);
        assert!(stack > 1000, "the paint was really there: {stack}");
        // Statics grow up, the stack down: what is left between them is still painted.
        assert!(footprint.ram + stack < ram, "{features}: {footprint:?}, stack {stack}");
    }
}

/// Picking an arm links none of what sets one up: no rod's modes, no fit.
#[test]
fn the_application_holds_no_set_up() {
    let holds = |features: &str| {
        let image = firmware::application(features).unwrap_or_else(|error| panic!("{error}"));
        let functions = image::functions(&image).unwrap_or_else(|error| panic!("{error}"));
        SET_UP.map(|part| functions.iter().any(|name| name.contains(part)))
    };
    assert_eq!(holds("mps2"), [false; SET_UP.len()]);
    assert_eq!(holds("mps2,set-up"), [true; SET_UP.len()]);
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
#[ignore = "a minute for crates of registers: `cargo test --test target -- --ignored`"]
fn the_nucleo_boards_build_and_fit() {
    for features in ["nucleo-g474re", "nucleo-g491re"] {
        let image = firmware::application(features).unwrap_or_else(|error| panic!("{error}"));
        let footprint = image::footprint(&image).unwrap_or_else(|error| panic!("{error}"));
        println!("{features}: {footprint:?}");
        assert!((20_000..NUCLEO_FLASH).contains(&footprint.flash), "{footprint:?}");
        assert!(footprint.ram < NUCLEO_RAM, "{footprint:?}");
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
    let image = firmware::application("mps2").unwrap_or_else(|error| panic!("{error}"));
    let bytes = std::fs::read(image).expect("an image");
    let name = b"_board_mps2\0";
    let at = bytes.windows(name.len()).position(|part| part == name).expect("its board's name");
    let mut of_another = tempfile::NamedTempFile::new().expect("a file");
    let parts = [&bytes[..at], b"_board_nrf9\0", &bytes[at + name.len()..]];
    of_another.write_all(&parts.concat()).expect("room");
    let Err(error) = Machine::emulate(of_another.path()) else { panic!("another board's") };
    let error = error.to_string();
    assert!(error.contains("board = nrf9: must be mps2"), "{error}");
    assert!(error.contains("--features mps2"), "{error}");
}

/// The golden run names no board: it is not taken for the application.
#[test]
fn another_image_is_refused() {
    let image = firmware::build("golden").unwrap_or_else(|error| panic!("{error}"));
    let Err(error) = Machine::emulate(&image) else { panic!("it is not the application") };
    assert!(error.to_string().contains("no board is named in it"), "{error}");
}
