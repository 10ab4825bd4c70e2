//! The campaign of random scenes from the command line.

use std::fs;

use assert_cmd::Command;

/// A page's random scenes may be drawn anew without its runs of days.
#[test]
fn a_page_is_filled_with_its_scenes_only() {
    let folder = tempfile::tempdir().expect("a folder");
    let page = folder.path().join("page.md");
    let block = |name: &str| format!("<!-- lab:{name} -->\n{name} as before\n<!-- /lab -->\n");
    let names = ["scenes", "reasons", "precision", "energy", "long"];
    fs::write(&page, names.map(block).concat()).expect("a page");
    Command::new(env!("CARGO_BIN_EXE_stillbeam-lab"))
        .args(["--threads", "1", "stress", "page.md", "--only-scenes", "--count", "5"])
        .current_dir(folder.path())
        .assert()
        .success();
    let text = fs::read_to_string(&page).expect("the page");
    let kept = names.map(|name| text.contains(&format!("{name} as before")));
    assert_eq!(kept, [false, false, false, true, true], "{text}");
    assert!(text.contains("`cargo lab stress --count 5 --seed 8`"), "{text}");
}
