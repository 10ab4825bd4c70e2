//! Sizes of the smallest useful programs: set-up or a prepared arm, one move and its ticks.

use stillbeam_tests::instructions;
use stillbeam_tests::instructions::Minimal;

fn one_element() -> Minimal {
    let minimal = instructions::minimal("Newmark1Nodal").unwrap_or_else(|error| panic!("{error}"));
    // The paint was really there: a program without stack does not exist.
    assert!(minimal.stack > 100, "{minimal:?}");
    minimal
}

/// 21 KiB of flash, 2 KiB of RAM without stack, 3 KiB of stack.
#[test]
fn one_element_is_small() {
    let minimal = one_element();
    assert!(minimal.flash <= 21 * 1024, "{minimal:?}");
    assert!(minimal.ram <= 2 * 1024, "{minimal:?}");
    assert!(minimal.stack <= 3 * 1024, "{minimal:?}");
}

/// Without set-up: 16.5 KiB of flash, 2 KiB of stack.
#[test]
fn one_prepared_element_is_smaller() {
    let prepared = instructions::prepared("Newmark1Nodal").unwrap_or_else(|e| panic!("{e}"));
    assert!(prepared.flash <= 33 * 512, "{prepared:?}");
    assert_eq!(prepared.ram, 0, "{prepared:?}");
    assert!((100..=2 * 1024).contains(&prepared.stack), "{prepared:?}");
    assert!(prepared.flash + 7 * 512 <= one_element().flash, "{prepared:?}");
}

/// The method that is a thousand times closer, without its set-up: 23 KiB of flash and 2.5 KiB of
/// stack, a quarter of what it takes with it.
#[test]
fn exact_kinematics_fit_without_their_set_up() {
    let prepared = instructions::prepared("Elastica2").unwrap_or_else(|error| panic!("{error}"));
    assert!(prepared.flash <= 23 * 1024, "{prepared:?}");
    assert_eq!(prepared.ram, 0, "{prepared:?}");
    assert!((100..=10 * 256).contains(&prepared.stack), "{prepared:?}");
}

/// A name that is not in the list of methods is not taken for a small program.
#[test]
fn an_unknown_method_fails() {
    let error = instructions::minimal("NoSuchMethod").expect_err("nothing runs");
    assert!(error.contains("exit status: 1"), "{error}");
}
