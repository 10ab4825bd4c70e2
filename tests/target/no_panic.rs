//! The tick path of every method: no panic can be reached from it, and no double is computed.

use stillbeam_tests::{firmware, image};

#[test]
fn no_panic_is_reachable_from_a_tick() {
    firmware::build("no_panic_tick").unwrap_or_else(|error| panic!("{error}"));
}

/// The proof can fail: with one index that may be out of range the image does not link.
#[test]
fn a_reachable_panic_is_found() {
    let error = firmware::build_with("no_panic_tick", "STILLBEAM_FAULT", "panic")
        .expect_err("must not link");
    assert!(error.contains("panic-never"), "{error}");
}

/// No call into the compiler's soft arithmetic, which is what a stray f64 in the tick compiles
/// to, and none into libm.
#[test]
fn the_tick_computes_in_hardware() {
    let tick = firmware::build("no_panic_tick").unwrap_or_else(|error| panic!("{error}"));
    let functions = image::functions(&tick).unwrap_or_else(|error| panic!("{error}"));
    assert!(functions.len() > 10, "{functions:?}");
    for function in functions {
        let soft = function.starts_with("__aeabi_")
            && !["mem", "ul", "l"].iter().any(|kind| function[8..].starts_with(kind));
        assert!(!soft && !function.contains("libm"), "{function} is linked");
    }
}
