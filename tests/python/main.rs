//! The Python package: its own tests, in an interpreter with numpy, matplotlib and pandas, on the
//! extension that cargo has built with these tests. Its environment also has the CiA 402 node that
//! [`peer`] talks to.

mod bits;
mod interpreter;
mod peer;

use interpreter::run;

#[test]
fn the_package_keeps_what_its_tests_say() {
    run(
        &["-m", "unittest", "discover", "--top-level-directory", ".", "--start-directory", "tests"],
        &[],
    );
}

#[test]
fn its_numbers_are_those_of_the_command_line_to_the_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    bits::write(folder.path());
    run(&["tests/bits.py"], &[("STILLBEAM_BITS", folder.path())]);
}

#[test]
fn the_examples_run_and_draw() {
    let folder = tempfile::tempdir().expect("a folder");
    run(&["tests/examples.py"], &[("STILLBEAM_PICTURES", folder.path())]);
    for name in ["paper_fig6", "still_against_shapers", "log_to_plan"] {
        let picture = folder.path().join(name).with_extension("png");
        let size = std::fs::metadata(&picture).expect("a picture").len();
        assert!(size > 10_000, "{}: {size} bytes", picture.display());
    }
}
