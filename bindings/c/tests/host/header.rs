//! The committed header is what cbindgen makes of the code.

use std::{env, fs};

use crate::compile::folder;

/// Writes the header, in place of comparing it, if the environment variable
/// `STILLBEAM_WRITE_HEADER` is set.
#[test]
fn the_header_is_that_of_the_code() {
    let path = folder().join("include/stillbeam.h");
    let mut text = Vec::new();
    cbindgen::generate(folder()).expect("cbindgen reads the code").write(&mut text);
    let text = String::from_utf8(text).expect("UTF-8");
    if env::var_os("STILLBEAM_WRITE_HEADER").is_some() {
        fs::write(&path, &text).expect("include/stillbeam.h");
    }
    let committed = fs::read_to_string(&path).expect("include/stillbeam.h");
    let differing = text.lines().zip(committed.lines()).find(|(is, was)| is != was);
    assert!(
        text == committed,
        "include/stillbeam.h: {differing:?}\nwrite it anew: STILLBEAM_WRITE_HEADER=1 cargo test -p \
         stillbeam-c --test host header::"
    );
}

/// The header's functions are counted: a user has to learn them.
#[test]
fn the_header_declares_four_and_twenty_functions() {
    let text = fs::read_to_string(folder().join("include/stillbeam.h")).expect("the header");
    let declares =
        |line: &&str| line.starts_with("sb_status sb_") || line.starts_with("size_t sb_");
    assert_eq!(text.lines().filter(declares).count(), 24);
}
