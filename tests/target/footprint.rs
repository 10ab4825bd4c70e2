//! What the smallest useful program takes: set-up, one move and its ticks.

use stillbeam_tests::instructions;
use stillbeam_tests::instructions::Minimal;

fn one_element() -> Minimal {
    let minimal = instructions::minimal("Newmark1").unwrap_or_else(|error| panic!("{error}"));
    // The paint was really there: a program without stack does not exist.
    assert!(minimal.stack > 100, "{minimal:?}");
    minimal
}

/// 2 KiB of RAM without stack. Flash and stack do not grow by more than 2 % from what they are,
/// 25,960 and 5,500 bytes; the aim, 16 and 4 KiB, is not reached: docs/instructions.md says why.
#[test]
fn one_element_does_not_grow() {
    let minimal = one_element();
    assert!(minimal.ram <= 2 * 1024, "{minimal:?}");
    assert!(minimal.flash <= 26_480, "{minimal:?}");
    assert!(minimal.stack <= 5_610, "{minimal:?}");
}

/// A name that is not in the list of methods is not taken for a small program.
#[test]
fn an_unknown_method_fails() {
    let error = instructions::minimal("NoSuchMethod").expect_err("nothing runs");
    assert!(error.contains("exit status: 1"), "{error}");
}
