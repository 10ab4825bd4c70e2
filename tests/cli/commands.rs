use std::fs;
use std::path::{Path, PathBuf};

use crate::sim;

fn truth_path(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/truth").join(file)
}

fn scene_path(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scenes").join(file)
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
    let scene = scene_path("b-tip30.toml");
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
    assert_eq!(
        run(folder.path(), &["run", "b-tip30", "--csv", "a.csv", "--method", "newmark"]).0,
        0
    );
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
fn every_method_runs_with_its_own_words() {
    let folder = tempfile::tempdir().expect("folder");
    let cases: [(&[&str], &str); 6] = [
        (&["--method", "modal", "--modes", "1", "--no-spin"], "modal, 1 mode of 8 consistent"),
        (&["--method", "elastica"], "elastica, 2 modes, fine"),
        (&["--method", "elastica", "--modes", "3", "--quality", "fast"], "elastica, 3 modes, fast"),
        (&["--method", "auto"], "auto, within 0.1 % of L and 1 % of torque"),
        (&[], "auto, within 0.1 % of L and 1 % of torque"),
        (
            &["--tolerance", "0.05", "--torque-tolerance", "0.1"],
            "chose            modal, 1 mode (expected error ",
        ),
    ];
    for (args, words) in cases {
        let args = [&["run", "b-tip30", "--csv", "a.csv"], args].concat();
        let (code, out, err) = run(folder.path(), &args);
        // One mode without spin terms is remarked on, rightly.
        let remarks =
            err.lines().filter(|line| !line.starts_with("note: modal is expected to err"));
        assert_eq!((code, remarks.count()), (0, 0), "{args:?}: {err}");
        assert!(out.contains(words), "{words} is not in: {out}");
    }
}

#[test]
fn auto_keeps_its_tolerance_or_says_what_it_could() {
    let folder = tempfile::tempdir().expect("folder");
    let auto = |scene: &str, tolerance: &str| {
        let args = ["run", scene, "--csv", "a.csv", "--method", "auto", "--tolerance", tolerance];
        run(folder.path(), &args)
    };
    for (scene, tolerance) in [("d-fast", "0.001"), ("a-tip30", "0.0005"), ("s-gravity", "0.01")] {
        assert_eq!(auto(scene, tolerance).0, 0);
        let truth = truth_path(&format!("{scene}.csv"));
        let truth = truth.to_str().expect("path");
        let compare = ["compare", "a.csv", truth, "--scene", scene, "--tolerance", tolerance];
        assert_eq!(run(folder.path(), &compare).0, 0, "{scene} within {tolerance}");
    }
    let (code, _, err) = auto("d-fast", "0.000002");
    assert_eq!((code, err.lines().count()), (2, 1), "{err}");
    assert!(err.contains("solver.tolerance = 0.000002: must be at least 0.000"), "{err}");
}

/// The tick is a fifth of the arm's period: Newmark's rule errs by more than the torque itself.
const COARSE: &str = "[link]\nlength = 0.4\nmass = 0.0224\nbending_stiffness = 0.46\n[payload]\n\
    mass = 0.03\n[[moves]]\nprofile = \"s-curve\"\nduration = 0.6\nto = 1.0\nsettle = 0.4\n[solver]\n\
    tick = 0.04\n";

#[test]
fn a_method_that_does_not_suit_is_remarked_on() {
    let folder = tempfile::tempdir().expect("folder");
    fs::write(folder.path().join("scene.toml"), COARSE).expect("scene");
    let with = |args: &[&str]| {
        let args = [&["run", "scene.toml", "--csv", "a.csv"], args].concat();
        let (code, out, err) = run(folder.path(), &args);
        assert_eq!(code, 0, "{err}");
        (out, err)
    };
    for method in ["newmark", "rigid"] {
        let (_, err) = with(&["--method", method]);
        assert_eq!(err.lines().count(), 1, "{err}");
        assert!(err.starts_with(&format!("note: {method} is expected to err by ")), "{err}");
        assert!(err.contains("of the torque's peak; auto would take modal, "), "{err}");
    }
    assert_eq!(with(&["--method", "modal"]).1, "");
    let (out, err) = with(&[]);
    assert!(err.is_empty() && out.contains("chose            modal, "), "{out}{err}");
}

/// Tolerances that nobody asked for are no reason not to run.
#[test]
fn without_a_method_the_nearest_is_taken() {
    let folder = tempfile::tempdir().expect("folder");
    // A hub as wide as the link is long, and a profile that jumps: the torque rings in every mode.
    let scene = "[link]\nlength = 0.3\nmass = 0.1\nbending_stiffness = 1.0\n[hub]\nradius = 0.3\n\
        [move]\nprofile = \"trapezoid\"\nduration = 0.5\nto = 1.0\nsettle = 0.2\n";
    fs::write(folder.path().join("scene.toml"), scene).expect("scene");
    let args = ["run", "scene.toml", "--csv", "a.csv"];
    let (code, out, err) = run(folder.path(), &args);
    assert_eq!((code, err.lines().count()), (0, 1), "{out}{err}");
    assert!(err.starts_with("note: no method keeps 0.1 % of L and 1 % of the torque"), "{err}");
    let asked = [&args[..], &["--method", "auto"]].concat();
    let (code, _, err) = run(folder.path(), &asked);
    assert_eq!((code, err.lines().count()), (2, 1), "{err}");
    assert!(err.starts_with("error: solver.torque_tolerance = 0.01: must be at least"), "{err}");
}

#[test]
fn keys_of_a_file_that_its_method_does_not_read_are_noted() {
    let folder = tempfile::tempdir().expect("folder");
    let scene = fs::read_to_string(scene_path("b-tip30.toml")).expect("scene");
    let scene = scene.replace("[solver]", "[solver]\nmethod = \"elastica\"\nspin = false");
    fs::write(folder.path().join("scene.toml"), scene).expect("scene");
    let (code, _, err) = run(folder.path(), &["run", "scene.toml", "--csv", "a.csv"]);
    assert_eq!((code, err.lines().count()), (0, 1), "{err}");
    assert!(err.starts_with("note: solver.spin = false: elastica does not read it"), "{err}");
    let newmark = ["run", "scene.toml", "--csv", "a.csv", "--method", "newmark"];
    // The file leaves out the spin terms, which is remarked on.
    let (_, _, err) = run(folder.path(), &newmark);
    assert!(err.lines().all(|line| line.starts_with("note: newmark is expected to err")), "{err}");
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
        let args = ["run", "s-gravity", "--csv", name, "--method", "newmark"];
        let args = [&args[..], &["--elements", "8", "--mass", "lumped"]].concat();
        assert_eq!(run(folder.path(), &args).0, 0);
    }
    let read = |name: &str| fs::read(folder.path().join(name)).expect("table");
    assert_eq!(read("a.csv"), read("b.csv"));
}

#[test]
fn reference_writes_the_columns_of_run() {
    let folder = tempfile::tempdir().expect("folder");
    let lines = |name: &str| -> Vec<String> {
        let text = fs::read_to_string(folder.path().join(name)).expect("table");
        text.lines().map(str::to_owned).collect()
    };
    let rod = ["reference", "d-fast", "--solver", "rod", "--csv", "rod.csv"];
    assert_eq!(run(folder.path(), &rod).0, 0);
    assert_eq!(run(folder.path(), &["run", "d-fast", "--csv", "run.csv"]).0, 0);
    let (rod, arm) = (lines("rod.csv"), lines("run.csv"));
    assert_eq!((&rod[0], rod.len()), (&arm[0], arm.len()));
    let (_, said, _) = run(folder.path(), &["compare", "run.csv", "rod.csv", "--scene", "d-fast"]);
    assert!(said.contains("41 common times"), "{said}");
    // The last row of the move has the left-hand acceleration, -6 pi / T^2.
    let end: Vec<f64> = rod[21].split(',').map(|cell| cell.parse().expect("number")).collect();
    assert!((end[0] - 0.2).abs() < 1e-12 && (end[3] + 471.2389).abs() < 1e-3, "{end:?}");

    let fine = ["reference", "d-fast", "--csv", "fine.csv", "--every", "0.003"];
    assert_eq!(run(folder.path(), &fine).0, 0);
    let times = lines("fine.csv");
    assert!(times[1].starts_with('0') && times[times.len() - 1].starts_with("0.4,"));
    for every in ["0", "-1", "5", "nan"] {
        let args = ["reference", "d-fast", "--csv", "no.csv", "--every", every];
        let (code, _, err) = run(folder.path(), &args);
        assert_eq!((code, err.lines().count()), (2, 1), "{err}");
    }
    assert!(!folder.path().join("no.csv").exists());
}
