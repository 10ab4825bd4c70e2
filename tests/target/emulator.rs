//! The harness around the emulator: a program that hangs or fails is reported as what it is.

use std::time::Duration;

use stillbeam_tests::emulator::{self, Clock};
use stillbeam_tests::firmware;

#[test]
fn a_hang_is_stopped_with_a_message() {
    let image = firmware::build_with("crash", "STILLBEAM_FAULT", "hang")
        .unwrap_or_else(|error| panic!("{error}"));
    let error = emulator::run(&image, Clock::Host, Duration::from_secs(2)).expect_err("it hangs");
    assert!(error.contains("no end after 2 s, stopped"), "{error}");
}

#[test]
fn a_fault_is_an_error() {
    let image = firmware::build_with("crash", "STILLBEAM_FAULT", "fault")
        .unwrap_or_else(|error| panic!("{error}"));
    let error = emulator::run(&image, Clock::Host, Duration::from_secs(20)).expect_err("it faults");
    assert!(error.contains("exit status: 102"), "{error}");
}

#[test]
fn a_panic_is_an_error_with_its_message() {
    let image = firmware::build_with("crash", "STILLBEAM_FAULT", "panic");
    let image = image.unwrap_or_else(|error| panic!("{error}"));
    let error = emulator::run(&image, Clock::Host, Duration::from_secs(20)).expect_err("it panics");
    assert!(error.contains("exit status: 101"), "{error}");
    assert!(error.contains("crash.rs") && error.contains("hang, fault or panic"), "{error}");
}

#[test]
fn a_missing_target_is_named() {
    let error = firmware::require_target("thumbv7a-none-eabi").expect_err("not installed");
    assert!(error.contains("rustup target add thumbv7a-none-eabi"), "{error}");
}
