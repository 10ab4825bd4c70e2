//! Checks cargo's manifests: the files that a crate takes along when it is packaged, and the
//! targets that are left out of the tests.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use stillbeam_tests::firmware::{cargo, run};
use stillbeam_tests::root;

const LICENSES: [&str; 2] = ["LICENSE-MIT", "LICENSE-APACHE"];

/// Folder and name of each workspace member that may be published.
fn published() -> Vec<(String, String)> {
    let workspace = fs::read_to_string(root().join("Cargo.toml")).expect("Cargo.toml");
    let (_, members) = workspace.split_once("\nmembers = [").expect("members");
    let (members, _) = members.split_once(']').expect("a list");
    let mut found = Vec::new();
    for folder in members.split('"').skip(1).step_by(2) {
        let manifest = fs::read_to_string(root().join(folder).join("Cargo.toml")).expect(folder);
        if manifest.contains("\npublish = false\n") {
            continue;
        }
        let (_, name) = manifest.split_once("name = \"").expect("a name");
        let (name, _) = name.split_once('"').expect("a name in quotes");
        found.push((folder.to_owned(), name.to_owned()));
    }
    found
}

/// A stranger gets the examples and the page that leads to them, and nothing that is for this
/// repository only.
#[test]
fn the_core_takes_its_examples_and_its_readme_along() {
    let listed =
        run(cargo().args(["package", "--list", "--allow-dirty", "--package", "stillbeam"]));
    let listed = listed.unwrap_or_else(|error| panic!("{error}"));
    let files: Vec<&str> = listed.lines().collect();
    let examples: Vec<_> = fs::read_dir(root().join("core/examples")).expect("examples").collect();
    assert!(examples.len() >= 6, "{examples:?}");
    for entry in examples {
        let name = entry.expect("an example").file_name().into_string().expect("UTF-8");
        let path = format!("examples/{name}");
        assert!(files.contains(&path.as_str()), "{path} is left out:\n{listed}");
    }
    for file in ["README.md", "Cargo.toml", "src/lib.rs"] {
        assert!(files.contains(&file), "{file} is left out:\n{listed}");
    }
}

/// Both licences ask for their text to go with the code.
#[test]
fn every_published_crate_holds_the_texts_of_its_licences() {
    let crates = published();
    assert!(crates.iter().any(|(_, name)| name == "stillbeam"), "{crates:?}");
    for (folder, name) in crates {
        let listed = run(cargo().args(["package", "--list", "--allow-dirty", "--package", &name]));
        let listed = listed.unwrap_or_else(|error| panic!("{error}"));
        for license in LICENSES {
            assert!(
                listed.lines().any(|file| file == license),
                "{name} has no {license}:\n{listed}"
            );
            let [own, of_all] = [root().join(&folder).join(license), root().join(license)]
                .map(|path| fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display())));
            assert!(own == of_all, "{folder}/{license} is not the root's");
        }
    }
}

/// A version stands in manifests that cargo does not read, too.
#[test]
fn everything_has_the_version_of_the_workspace() {
    let read = |path: &str| fs::read_to_string(root().join(path)).expect(path);
    let value = |text: &str, before: &str| -> String {
        let (_, rest) = text.split_once(before).unwrap_or_else(|| panic!("no {before}"));
        rest.split('"').next().expect("an end").trim_end().to_owned()
    };
    let workspace = read("Cargo.toml");
    let version = value(&workspace, "[workspace.package]\nversion = \"");
    let (_, dependencies) = workspace.split_once("[workspace.dependencies]").expect("a table");
    let paths = dependencies.lines().filter(|line| line.contains("path = "));
    let mut found = 0;
    for line in paths {
        assert_eq!(value(line, "version = \""), version, "{line}");
        found += 1;
    }
    assert!(found >= 9, "{found}");
    let arduino = "bindings/c/examples/arduino";
    let properties = read(&format!("{arduino}/library.properties"));
    let line = properties.lines().find_map(|line| line.strip_prefix("version="));
    assert_eq!(line, Some(version.as_str()));
    assert_eq!(value(&read(&format!("{arduino}/library.json")), "\"version\": \""), version);
    assert_eq!(value(&read("tests/fuzz/targets/Cargo.toml"), "version = \""), version);
    let (of_doc, _) = version.rsplit_once('.').expect("three numbers");
    let doc = read("host-sim/src/export.rs");
    assert_eq!(value(&doc, "//! // stillbeam-sim = { version = \""), of_doc);
    // What is not released yet stands above what is.
    let changelog = read("CHANGELOG.md");
    let headings: Vec<&str> = changelog.lines().filter(|line| line.starts_with("## ")).collect();
    assert_eq!(headings.first(), Some(&"## [Unreleased]"));
    assert!(headings[1].starts_with(&format!("## [{version}] - ")), "{headings:?}");
    for heading in headings {
        let name = heading.split(['[', ']']).nth(1).expect("a name in brackets");
        let link = format!("\n[{name}]: https://github.com/stillbeam/stillbeam/");
        assert!(changelog.contains(&link), "{heading} has no link");
    }
}

/// Cargo compiles a target once more for its tests unless its manifest says that it has none. Then
/// a test written there would never run.
#[test]
fn what_is_left_out_of_the_tests_holds_none() {
    let metadata = run(cargo().args(["metadata", "--no-deps", "--format-version", "1"]));
    let metadata = metadata.unwrap_or_else(|error| panic!("{error}"));
    let metadata: Value = serde_json::from_str(&metadata).expect("JSON");
    let list = |value: &Value| value.as_array().expect("a list").clone();
    let is = |value: &Value| value.as_bool().expect("true or false");
    let (mut without_tests, mut without_examples) = (0, 0);
    for target in list(&metadata["packages"]).iter().flat_map(|package| list(&package["targets"])) {
        let kind = list(&target["kind"]);
        let kind = kind[0].as_str().expect("a kind");
        let root = PathBuf::from(target["src_path"].as_str().expect("a path"));
        let none_has = |mark: &str| {
            for path in modules(&root) {
                let text = fs::read_to_string(&path).expect("a source");
                let found = text.lines().any(|line| line.trim_start().starts_with(mark));
                assert!(!found, "{} holds {mark}, which never runs", path.display());
            }
        };
        if ["lib", "bin"].contains(&kind) && !is(&target["test"]) {
            none_has("#[test]");
            none_has("#[cfg(test)]");
            without_tests += 1;
        }
        if kind == "lib" && !is(&target["doctest"]) {
            none_has("/// ```");
            none_has("//! ```");
            without_examples += 1;
        }
    }
    assert!(without_tests > 10 && without_examples > 5, "{without_tests}, {without_examples}");
}

/// The source file of a target, and the files of all its modules.
fn modules(root: &Path) -> Vec<PathBuf> {
    let mut files = vec![root.to_owned()];
    let mut next = 0;
    while let Some(file) = files.get(next).cloned() {
        next += 1;
        let text = fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        let folder = if next == 1 || file.ends_with("mod.rs") {
            file.parent().expect("a folder").to_owned()
        } else {
            file.with_extension("")
        };
        for line in text.lines().filter(|line| line.ends_with(';')) {
            let Some((before, name)) = line.trim_end_matches(';').split_once("mod ") else {
                continue;
            };
            if !["", "pub ", "pub(crate) "].contains(&before) {
                continue;
            }
            let places = [folder.join(name).with_extension("rs"), folder.join(name).join("mod.rs")];
            // A module with a `#[path]` of its own is another target's, or is written by a test.
            files.extend(places.into_iter().filter(|place| place.exists()));
        }
    }
    files
}
