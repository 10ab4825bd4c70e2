//! The pages that `cargo lab docs` writes. Here and not beside its code: there cargo would compile
//! every campaign once more.

use std::fs;

use stillbeam_lab::choice;
use stillbeam_lab::markers;
use stillbeam_lab::pages::{PAGES, Pages, named};
use stillbeam_tests::root;

/// Every page of the repository has a place for each of its blocks, once.
#[test]
fn the_pages_have_their_places() {
    for page in PAGES {
        let text = fs::read_to_string(root().join(page.path)).unwrap();
        for name in page.blocks {
            assert!(markers::has(&text, name), "{}: {name}", page.path);
            let start = format!("<!-- lab:{name} -->");
            assert_eq!(text.matches(&start).count(), 1, "{}: {start}", page.path);
        }
    }
}

#[test]
fn a_page_that_there_is_not_is_refused() {
    assert_eq!(named("docs/still.md").unwrap().path, "docs/still.md");
    let error = named("docs/styl.md").unwrap_err().to_string();
    assert!(error.starts_with("page = \"docs/styl.md\": must be README.md, "), "{error}");
}

/// Checked without the campaign: what a page says of its command and its distribution.
#[test]
fn a_page_of_auto_that_names_other_arms_is_found() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("docs")).unwrap();
    let path = folder.path().join("docs/auto.md");
    let page = named("docs/auto.md").unwrap();
    fs::write(&path, choice::page(3, &[])).unwrap();
    assert_eq!(Pages::at(folder.path()).check(&page).unwrap(), None);
    let text = choice::page(3, &[]).replace("2 to 20 ms", "2 to 30 ms");
    fs::write(&path, text).unwrap();
    let found = Pages::at(folder.path()).check(&page).unwrap().unwrap();
    assert!(found.old.unwrap().contains("30 ms") && found.new.unwrap().contains("20 ms"));
}
