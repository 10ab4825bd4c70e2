//! One line that names the field, its value and what it must be; exit code 2; nothing written.

use std::fs;
use std::path::Path;

use crate::sim;

const GOOD: &str = r#"
[link]
length = 0.4
mass = 0.01
bending_stiffness = 0.02
[hub]
radius = 0.0
[payload]
mass = 0.03
[damping]
alpha = 0.0
beta = 0.0
[gravity]
acceleration = 0.0
[limits]
rate = 10.0
[move]
profile = "cubic"
duration = 1.0
from = 0.0
to = 1.0
settle = 0.5
[solver]
tick = 0.01
elements = 1
"#;

/// Runs the scene; asserts that it is refused in one line that contains `words`, with nothing
/// written.
fn refused(scene: &str, args: &[&str], words: &[&str]) {
    let folder = tempfile::tempdir().expect("folder");
    let path = folder.path().join("scene.toml");
    fs::write(&path, scene).expect("scene");
    let out = folder.path().join("out.csv");
    let output = sim()
        .current_dir(folder.path())
        .arg("run")
        .args(["scene.toml", "--csv", "out.csv"])
        .args(args)
        .output()
        .expect("program");
    let text = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{words:?}: {text}");
    assert_eq!(text.lines().count(), 1, "{text}");
    assert!(text.starts_with("error: "), "{text}");
    for word in words {
        assert!(text.contains(word), "{word} is not in: {text}");
    }
    assert!(output.stdout.is_empty());
    assert_untouched(folder.path(), &out);
}

fn assert_untouched(folder: &Path, out: &Path) {
    assert!(!out.exists());
    let left = fs::read_dir(folder).expect("folder").count();
    assert_eq!(left, 1, "only the scene is there");
}

#[test]
fn the_good_scene_is_good() {
    let folder = tempfile::tempdir().expect("folder");
    fs::write(folder.path().join("scene.toml"), GOOD).expect("scene");
    sim()
        .current_dir(folder.path())
        .args(["run", "scene.toml", "--csv", "out.csv"])
        .assert()
        .success();
}

#[test]
fn values_out_of_range() {
    let cases = [
        ("length = 0.4", "length = -0.4", "link.length = -0.4"),
        ("length = 0.4", "length = nan", "link.length = NaN"),
        ("length = 0.4", "length = inf", "link.length = inf"),
        ("mass = 0.01", "mass = 0.0", "link.mass = 0"),
        ("bending_stiffness = 0.02", "bending_stiffness = -1", "link.bending_stiffness = -1"),
        ("radius = 0.0", "radius = -0.1", "hub.radius = -0.1"),
        ("radius = 0.0", "inertia = -0.1", "hub.inertia = -0.1"),
        ("mass = 0.03", "mass = -0.03", "payload.mass = -0.03"),
        ("mass = 0.03", "inertia = nan", "payload.inertia = NaN"),
        ("alpha = 0.0", "alpha = -1.0", "damping.alpha = -1"),
        ("beta = 0.0", "beta = 2.0", "damping.beta = 2"),
        ("acceleration = 0.0", "acceleration = -9.81", "gravity.acceleration = -9.81"),
        ("rate = 10.0", "rate = 0.0", "limits.rate = 0"),
        ("rate = 10.0", "rate = 1.0", "limits.rate"),
        ("rate = 10.0", "jerk = 10.0", "limits.jerk"),
        ("rate = 10.0", "torque = 1e-6", "limits.torque"),
        ("duration = 1.0", "duration = 0.0", "move.duration = 0"),
        ("duration = 1.0", "duration = nan", "move.duration = NaN"),
        ("from = 0.0", "from = inf", "move.from = inf"),
        ("to = 1.0", "to = -inf", "move.to = -inf"),
        ("settle = 0.5", "settle = -1.0", "move.settle = -1"),
        ("tick = 0.01", "tick = 0.0", "solver.tick = 0"),
        ("elements = 1", "elements = 3", "solver.elements = 3"),
        ("elements = 1", "elements = 16", "solver.elements = 16"),
    ];
    for (good, bad, words) in cases {
        assert!(GOOD.contains(good), "{good}");
        // A link that buckles needs no other number but another arm.
        let advice =
            if words.starts_with("gravity.acceleration = 100") { "use" } else { "must be" };
        refused(&GOOD.replacen(good, bad, 1), &[], &[words, advice]);
    }
}

#[test]
fn unknown_names() {
    let cases = [
        ("length = 0.4", "lenght = 0.4", "lenght"),
        ("[hub]", "[hubb]", "hubb"),
        ("profile = \"cubic\"", "profile = \"cubik\"", "move.profile = \"cubik\""),
        ("elements = 1", "method = \"euler\"", "euler"),
        ("elements = 1", "scalar = \"f16\"", "f16"),
        ("bending_stiffness = 0.02", "material = \"cheese\"", "link.material = \"cheese\""),
    ];
    for (good, bad, words) in cases {
        refused(&GOOD.replacen(good, bad, 1), &[], &[words]);
    }
}

#[test]
fn missing_and_contradicting_fields() {
    let cases = [
        ("length = 0.4\n", "", "length"),
        ("mass = 0.01\n", "", "link.mass"),
        ("bending_stiffness = 0.02\n", "", "link.bending_stiffness"),
        ("bending_stiffness = 0.02", "width = 0.01", "link.thickness"),
        (
            "bending_stiffness = 0.02",
            "bending_stiffness = 0.02\nyoungs_modulus = 1e9",
            "link.bending_stiffness",
        ),
        ("to = 1.0\n", "", "move.to"),
        ("profile = \"cubic\"", "profile = \"still\"\nrate = 2.0", "move.rate = 2"),
        ("profile = \"cubic\"\n", "", "move.profile: missing"),
        ("profile = \"cubic\"", "profile = \"spin-up\"", "move.to = 1"),
        ("[move]", "[[moves]]\nprofile = \"cubic\"\nduration = 1.0\nto = 0.5\n[move]", "move"),
        ("length = 0.4", "length = \"long\"", "link.length"),
        ("[link]", "[link", "must be"),
    ];
    for (good, bad, words) in cases {
        let scene = GOOD.replacen(good, bad, 1);
        refused(&scene, &[], if words == "must be" { &[] } else { std::slice::from_ref(&words) });
    }
}

#[test]
fn words_on_the_command_line() {
    refused(GOOD, &["--elements", "5"], &["solver.elements = 5", "must be 1, 2, 4 or 8"]);
    refused(GOOD, &["--elements", "-1"], &["solver.elements = -1"]);
    refused(GOOD, &["--elements", "many"], &["many", "--elements"]);
    refused(GOOD, &["--tick", "-0.01"], &["solver.tick = -0.01"]);
    refused(GOOD, &["--tick", "nan"], &["solver.tick = NaN"]);
    refused(GOOD, &["--method", "euler"], &["euler", "newmark"]);
    refused(GOOD, &["--mass", "heavy"], &["heavy", "lumped"]);
    refused(
        GOOD,
        &["--method", "modal", "--modes", "3"],
        &["solver.modes = 3", "must be at most 2", "elements = 1"],
    );
    refused(GOOD, &["--modes", "0", "--method", "elastica"], &["solver.modes = 0", "1 to 3"]);
    refused(GOOD, &["--quality", "best"], &["best", "fine"]);
    refused(GOOD, &["--frobnicate"], &["--frobnicate"]);
}

#[test]
fn words_that_the_method_does_not_read() {
    // The scene's own `elements` is for the method that it would be run with; what is typed is
    // meant.
    let cases: [(&[&str], &str); 8] = [
        (&["--method", "elastica", "--no-spin"], "solver.spin = false: elastica"),
        (&["--method", "elastica", "--elements", "4"], "solver.elements = 4: elastica"),
        (&["--method", "rigid", "--mass", "lumped"], "solver.mass = lumped: rigid"),
        (&["--method", "auto", "--modes", "2"], "solver.modes = 2: auto"),
        (&["--method", "modal", "--quality", "fast"], "solver.quality = fast: modal"),
        (&["--method", "elastica", "--tolerance", "0.01"], "solver.tolerance = 0.01: elastica"),
        (
            &["--method", "modal", "--torque-tolerance", "0.01"],
            "solver.torque_tolerance = 0.01: modal",
        ),
        (&["--modes", "2"], "solver.modes = 2: auto"),
    ];
    for (args, words) in cases {
        refused(GOOD, args, &[words, "must be"]);
    }
}

#[test]
fn files_that_are_not_there() {
    let folder = tempfile::tempdir().expect("folder");
    let run = |args: &[&str]| {
        let output = sim().current_dir(folder.path()).args(args).output().expect("program");
        let text = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert_eq!(text.lines().count(), 1, "{text}");
        assert!(text.contains("must be"), "{text}");
    };
    run(&["run", "nowhere.toml", "--csv", "out.csv"]);
    run(&["run", "d-fast", "--csv", "/dev/null/out.csv"]);
    run(&["run", "d-fast", "--csv", "."]);
    run(&["compare", "a.csv", "b.csv", "--scene", "d-fast"]);
    run(&["compare", "a.csv", "b.csv", "--scene", "d-fast", "--tolerance", "-1"]);
    assert_eq!(fs::read_dir(folder.path()).expect("folder").count(), 0);
}

/// The image is looked for where cargo would put it, not in a folder of a fixed name.
#[test]
fn the_image_is_looked_for_in_cargos_target_folder() {
    let folder = tempfile::tempdir().expect("folder");
    let target = folder.path().join("elsewhere");
    let output = sim()
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
        .env("CARGO_TARGET_DIR", &target)
        .args(["talk", "rest"])
        .output()
        .expect("program");
    let error = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert_eq!(error.lines().count(), 1, "{error}");
    let image = target.join("thumbv7em-none-eabihf/application/application");
    assert!(error.contains(&image.display().to_string()), "{error}");
    assert!(error.contains("--features mps2") && error.contains("--image"), "{error}");
}

/// A log that cannot be written, and options of a recording without one, are refused before the
/// firmware is looked for.
#[test]
fn a_recording_without_a_place_is_refused_before_it_begins() {
    let folder = std::env::temp_dir();
    let folder = folder.to_str().expect("a name in Unicode");
    for (words, wanted) in [
        (&["--record", folder][..], "is a folder; must be a file's path"),
        (&["--motion", "sweep", "rest"], "--record"),
        (&["--record", "log.csv", "--motion", "square"], "square"),
    ] {
        let words = [&["talk", "--image", "no-such-image"], words].concat();
        let output = sim().args(&words).output().expect("program");
        let error = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(2), "{words:?}: {error}");
        assert!(error.contains(wanted) && !error.contains("no-such-image"), "{words:?}: {error}");
    }
}

#[test]
fn a_link_that_buckles_says_what_to_do() {
    let scene = GOOD.replace("acceleration = 0.0", "acceleration = 100.0");
    refused(&scene, &[], &["gravity.acceleration = 100", "use less gravity"]);
}

#[test]
fn a_reference_keeps_limits_as_a_run_does() {
    let folder = tempfile::tempdir().expect("folder");
    let scene = GOOD.replace("rate = 10.0", "moment = 0.02");
    fs::write(folder.path().join("scene.toml"), scene).expect("scene");
    for command in ["run", "reference"] {
        let output = sim()
            .current_dir(folder.path())
            .args([command, "scene.toml", "--csv", "out.csv"])
            .output()
            .expect("program");
        let text = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(2), "{command}: {text}");
        assert_eq!(text.lines().count(), 1, "{command}: {text}");
        assert!(text.contains("limits.moment = 0.02: move needs"), "{command}: {text}");
        assert!(!folder.path().join("out.csv").exists());
    }
}
