//! A board is a file, a line of features and the line that takes the file: nothing else knows it.

use std::fs;
use std::path::{Path, PathBuf};

use stillbeam_tests::root;

/// Every file below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let paths = entries.map(|entry| entry.expect("a readable folder").path());
    paths.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

/// The features of the boards that there is a file for.
fn boards() -> Vec<String> {
    let folder = root().join("firmware/src/bin/application/boards");
    let entries = fs::read_dir(folder).expect("the boards' folder");
    let paths = entries.map(|entry| entry.expect("a readable folder").path());
    let files = paths.filter(|path| path.is_file());
    files
        .map(|path| path.file_stem().expect("a name").to_string_lossy().replace('_', "-"))
        .collect()
}

#[test]
fn a_board_stands_in_three_places() {
    let boards = boards();
    assert!(boards.len() >= 3, "{boards:?}");
    for board in &boards {
        let file = board.replace('-', "_");
        let mut places = Vec::new();
        for path in files(&root().join("firmware")) {
            let text = fs::read_to_string(&path).unwrap_or_default();
            let path = path.strip_prefix(root().join("firmware")).expect("below").to_path_buf();
            let own = path.starts_with(format!("src/bin/application/boards/{file}"))
                || path.ends_with(format!("boards/{file}.rs"));
            let named = |line: &&str| {
                line.contains(&format!("feature = \"{board}\""))
                    || line.starts_with(&format!("{board} = ["))
            };
            let lines = text.lines().filter(named).count();
            if !own && lines > 0 {
                places.push((path.display().to_string(), lines));
            }
        }
        places.sort();
        let expected =
            [("Cargo.toml".to_owned(), 1), ("src/bin/application/main.rs".to_owned(), 1)];
        assert_eq!(places, expected, "{board}");
    }
}

/// A chip that stood in the dependency's line would be every board's.
#[test]
fn no_chip_stands_in_a_dependency_of_all_boards() {
    let manifest = fs::read_to_string(root().join("firmware/Cargo.toml")).expect("a manifest");
    let chips: Vec<&str> = manifest.lines().filter(|line| line.contains("stm32g")).collect();
    assert_eq!(chips.len(), 2, "{chips:#?}");
    assert!(chips[0].starts_with("nucleo-g474re = ["), "{chips:#?}");
    assert!(chips[1].starts_with("nucleo-g491re = ["), "{chips:#?}");
}
