//! What the smallest useful program takes: set-up, one move and its ticks.

use stillbeam_tests::instructions;
use stillbeam_tests::instructions::Minimal;

fn one_element() -> Minimal {
    let minimal = instructions::minimal("Newmark1Nodal").unwrap_or_else(|error| panic!("{error}"));
    // The paint was really there: a program without stack does not exist.
    assert!(minimal.stack > 100, "{minimal:?}");
    minimal
}

/// 22 KiB of flash, 2 KiB of RAM without stack, 4 KiB of stack. Until moves ended exactly and
/// curves were judged by themselves it was 16 KiB; joints, offset payloads and mounts made five of
/// the others.
#[test]
fn one_element_is_small() {
    let minimal = one_element();
    assert!(minimal.flash <= 22 * 1024, "{minimal:?}");
    assert!(minimal.ram <= 2 * 1024, "{minimal:?}");
    assert!(minimal.stack <= 4 * 1024, "{minimal:?}");
}

/// A name that is not in the list of methods is not taken for a small program.
#[test]
fn an_unknown_method_fails() {
    let error = instructions::minimal("NoSuchMethod").expect_err("nothing runs");
    assert!(error.contains("exit status: 1"), "{error}");
}
