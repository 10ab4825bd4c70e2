//! What a crate takes along when it is packaged.

use std::fs;

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
