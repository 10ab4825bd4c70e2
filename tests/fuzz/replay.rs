//! Every input that is kept, through its body, on the stable toolchain.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use stillbeam_fuzz::BODIES;

fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus")
}

/// Paths of a target's kept inputs, in order.
pub fn inputs(name: &str) -> Vec<PathBuf> {
    let folder = corpus().join(name);
    let files = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{folder:?}: {error}"));
    let mut paths: Vec<_> = files.map(|file| file.expect("a file").path()).collect();
    paths.sort();
    paths
}

#[test]
fn every_kept_input_comes_through() {
    for (name, body) in BODIES {
        let inputs = inputs(name);
        assert!(inputs.len() >= 5, "{name}: {} inputs", inputs.len());
        for path in inputs {
            println!("{}", path.display());
            body(&fs::read(&path).expect("an input"));
        }
    }
}

/// A target without a body, or a body without a target, would not be run.
#[test]
fn every_body_has_its_target_and_corpus() {
    let names = |folder: &str, extension: Option<&str>| {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let files = fs::read_dir(folder).expect("a folder");
        let paths = files.map(|file| file.expect("a file").path());
        let stem = |path: PathBuf| path.file_stem().map(|s| s.to_string_lossy().into_owned());
        // Around the targets stands their package, and what libFuzzer has found.
        let own = paths.filter(|path| path.extension() == extension.map(OsStr::new));
        let mut names: Vec<_> = own.filter_map(stem).collect();
        names.sort();
        names
    };
    let mut bodies: Vec<_> = BODIES.map(|(name, _)| name.to_owned()).to_vec();
    bodies.sort();
    assert_eq!(names("targets", Some("rs")), bodies);
    assert_eq!(names("corpus", None), bodies);
}
