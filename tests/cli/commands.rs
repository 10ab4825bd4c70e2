use std::fs;
use std::path::{Path, PathBuf};

use crate::sim;

fn truth_path(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/truth").join(file)
}

fn run(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let output = sim().current_dir(folder).args(args).output().expect("program");
    (
        output.status.code().expect("an exit code"),
        String::from_utf8(output.stdout).expect("text"),
        String::from_utf8(output.stderr).expect("text"),
    )
}

#[test]
fn a_run_has_the_columns_and_rows_of_truth() {
    let folder = tempfile::tempdir().expect("folder");
    let scene = truth_path("b-tip30.toml");
    let scene = scene.to_str().expect("path");
    let (code, out, err) = run(folder.path(), &["run", scene, "--csv", "deep/out.csv"]);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.contains("401 setpoints"), "{out}");
    let ours = fs::read_to_string(folder.path().join("deep/out.csv")).expect("table");
    let truth = fs::read_to_string(truth_path("b-tip30.csv")).expect("truth");
    assert_eq!(ours.lines().next(), truth.lines().next());
    assert_eq!(ours.lines().count(), truth.lines().count());
    // The row at the end of the move holds the left-hand acceleration.
    let end = ours.lines().nth(201).expect("row");
    assert!(end.starts_with("2.0,3.14159265,"), "{end}");
    assert!(end.contains(",-4.71238"), "{end}");
}

#[test]
fn compare_judges_by_the_tolerance() {
    let folder = tempfile::tempdir().expect("folder");
    assert_eq!(run(folder.path(), &["run", "b-tip30", "--csv", "a.csv"]).0, 0);
    let truth = truth_path("b-tip30.csv");
    let truth = truth.to_str().expect("path");
    let compare = |tolerance: &str| {
        let args = ["compare", "a.csv", truth, "--scene", "b-tip30", "--tolerance", tolerance];
        run(folder.path(), &args)
    };
    let (code, out, _) = compare("0.0015");
    assert_eq!(code, 0);
    for words in ["401 common times", "tip error, max", "rms", "torque error", "residual"] {
        assert!(out.contains(words), "{words} is not in: {out}");
    }
    assert_eq!(compare("0.001").0, 1);
}

#[test]
fn rounding_is_reported() {
    let folder = tempfile::tempdir().expect("folder");
    let (code, _, err) =
        run(folder.path(), &["run", "d-fast", "--csv", "a.csv", "--tick", "0.003"]);
    assert_eq!(code, 0);
    assert!(err.contains("move.duration = 0.2 s") && err.contains("rounded to 0.201 s"), "{err}");
}

#[test]
fn scenes_are_listed_by_name() {
    let folder = tempfile::tempdir().expect("folder");
    let (code, out, _) = run(folder.path(), &["scenes"]);
    assert_eq!(code, 0);
    for name in ["d-fast", "a-tip30", "b-tip30", "s-gravity", "spin-up"] {
        assert!(out.lines().any(|line| line.starts_with(name)), "{name} is not in: {out}");
    }
}

#[test]
fn the_same_run_gives_the_same_bytes() {
    let folder = tempfile::tempdir().expect("folder");
    for name in ["a.csv", "b.csv"] {
        let args = ["run", "s-gravity", "--csv", name, "--elements", "8", "--mass", "lumped"];
        assert_eq!(run(folder.path(), &args).0, 0);
    }
    let read = |name: &str| fs::read(folder.path().join(name)).expect("table");
    assert_eq!(read("a.csv"), read("b.csv"));
}
