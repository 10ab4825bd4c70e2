//! What the smallest useful program takes: set-up, one move and its ticks.

use stillbeam_tests::instructions;
use stillbeam_tests::instructions::Minimal;

fn one_element() -> Minimal {
    let minimal = instructions::minimal("Newmark1").unwrap_or_else(|error| panic!("{error}"));
    // The paint was really there: a program without stack does not exist.
    assert!(minimal.stack > 100, "{minimal:?}");
    minimal
}

/// 2 KiB of RAM without stack; flash and stack do not grow from what they are, 28,140 and 5,040
/// bytes, by more than 2 %.
#[test]
fn one_element_does_not_grow() {
    let minimal = one_element();
    assert!(minimal.ram <= 2 * 1024, "{minimal:?}");
    assert!(minimal.flash <= 28_720, "{minimal:?}");
    assert!(minimal.stack <= 5_140, "{minimal:?}");
}

/// The aim: 16 KiB of flash, 4 KiB of stack.
#[test]
#[ignore = "not reached: soft double arithmetic and the set-up that uses it take 22 KiB of flash"]
fn one_element_fits() {
    let minimal = one_element();
    assert!(minimal.flash <= 16 * 1024, "{minimal:?}");
    assert!(minimal.stack <= 4 * 1024, "{minimal:?}");
}

/// A name that is not in the list of methods is not taken for a small program.
#[test]
fn an_unknown_method_fails() {
    let error = instructions::minimal("NoSuchMethod").expect_err("nothing runs");
    assert!(error.contains("exit status: 1"), "{error}");
}
