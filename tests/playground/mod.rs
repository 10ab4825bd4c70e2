//! The page of the playground, in a browser.

mod bits;
mod use_of_it;

use stillbeam_tests::browser::Browser;
use stillbeam_tests::playground;

/// True once the page has made its runs.
const READY: &str = "globalThis.playground?.runs";

/// Opens the committed page with these settings behind `#`.
fn open(browser: &mut Browser, settings: &str) {
    let page = playground::page().canonicalize().expect("the committed page");
    browser.open(&format!("file://{}#{settings}", page.display()), READY);
}

#[test]
fn the_committed_page_is_that_of_its_sources() {
    let built = playground::build().unwrap_or_else(|error| panic!("{error}"));
    let committed = std::fs::read_to_string(playground::page()).expect("the committed page");
    assert!(built == committed, "the page differs; write it anew: {}", playground::COMMAND);
    assert!(built.len() < 1_000_000, "{} bytes", built.len());
}
