//! Mechanisms on the command line: files that come out, and input that is refused.

use std::fs;
use std::path::Path;

use crate::sim;

const LOOP: &str = r#"
[[links]]
length = 0.12
mass = 0.00672
bending_stiffness = 0.46

[[links]]
length = 0.35
mass = 0.00833
bending_stiffness = 0.0213344

[[links]]
length = 0.3
mass = 0.00714
rigid = true

[[joints]]

[[joints]]
passive = true
angle = 0.8

[[joints]]
passive = true
angle = -1.5

[closure]
pin = [0.4, 0.0]

[[moves]]
joint = 1
profile = "quintic"
duration = 0.3
from = 0.5
to = 1.0

[run]
duration = 0.4
"#;

/// Runs `args` in `folder`, where `scene.toml` holds the scene.
fn execute(folder: &Path, scene: &str, args: &[&str]) -> std::process::Output {
    fs::write(folder.join("scene.toml"), scene).expect("scene");
    sim().current_dir(folder).args(args).output().expect("program")
}

/// Asserts that the scene is refused by every command in one line that contains `words`, with
/// nothing written.
fn refused(scene: &str, words: &[&str]) {
    for command in ["run", "reference"] {
        let folder = tempfile::tempdir().expect("folder");
        let args = [command, "scene.toml", "--csv", "out.csv"];
        let output = execute(folder.path(), scene, &args);
        let text = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(2), "{words:?}: {text}");
        assert_eq!(text.lines().count(), 1, "{text}");
        assert!(text.starts_with("error: scene.toml"), "{text}");
        for word in words.iter().chain(&["must "]) {
            assert!(text.contains(word), "{word} is not in: {text}");
        }
        assert!(output.stdout.is_empty());
        assert_eq!(fs::read_dir(folder.path()).expect("folder").count(), 1, "{text}");
    }
}

/// The loop with one line in place of another.
fn with(old: &str, new: &str) -> String {
    assert!(LOOP.contains(old), "{old}");
    LOOP.replacen(old, new, 1)
}

#[test]
fn joints_that_cannot_be_moved_are_named() {
    refused(&with("joint = 1", "joint = 4"), &["moves[0].joint = 4", "no such joint", "1 to 3"]);
    refused(&with("joint = 1", "joint = 0"), &["moves[0].joint = 0", "no such joint"]);
    refused(&with("joint = 1", "joint = 2"), &["moves[0].joint = 2", "passive"]);
    let released = with("pin = [0.4, 0.0]", "from = 0.1\nrelease = [1]");
    let released = released.replace("passive = true", "passive = false");
    refused(&released, &["moves[0].joint = 1", "released at 0.1 s"]);
}

#[test]
fn two_moves_at_once_on_a_joint_are_named() {
    let second =
        "[[moves]]\njoint = 1\nprofile = \"cubic\"\nduration = 0.1\nto = 1.0\nstart = 0.2\n";
    refused(&format!("{LOOP}{second}"), &["moves[1].start = 0.2", "joint 1", "moves[0]", "0.3 s"]);
}

#[test]
fn loops_that_cannot_close_are_named() {
    refused(&with("[0.4, 0.0]", "[0.9, 0.0]"), &["closure.pin"]);
    refused(&with("[0.4, 0.0]", "[0.4]"), &["closure.pin"]);
    refused(&with("pin = [0.4, 0.0]", "pin = [0.4, 0.0]\nfrom = 0.1"), &["closure.from = 0.1"]);
    refused(&with("pin = [0.4, 0.0]", "release = [2]"), &["closure.pin: missing"]);
    refused(&with("pin = [0.4, 0.0]", "from = 0.1\nrelease = [5]"), &["closure.release = 5"]);
}

#[test]
fn values_that_no_chain_has_are_named() {
    refused(&with("length = 0.35", "length = -1"), &["links[1].length = -1"]);
    refused(&with("mass = 0.00833", "mass = nan"), &["links[1].mass"]);
    refused(&with("rigid = true", ""), &["links[2].bending_stiffness: missing", "rigid = true"]);
    refused(
        &with("rigid = true", "rigid = true\nbending_stiffness = 1.0"),
        &["links[2].bending_stiffness = 1", "rigid"],
    );
    refused(&with("[[joints]]\n", ""), &["joints = 2", "3"]);
    refused(&with("duration = 0.4", "duration = 0.2"), &["moves[0]", "run.duration"]);
    refused(&with("duration = 0.3", "duration = -0.3"), &["moves[0]", "duration"]);
    refused(&with("duration = 0.3", "duration = 0.3\nstart = -1"), &["moves[0].start = -1"]);
    refused(&with("quintic", "quartic"), &["moves[0].profile = \"quartic\"", "quintic"]);
    refused(&with("[run]", "[damping]\nbeta = -1\n[run]"), &["damping.beta = -1"]);
    refused(&with("[run]", "[solver]\ncoordinates = 5\n[run]"), &["solver.coordinates = 5"]);
    refused(&with("[run]", "[solver]\nmodes = 2\n[run]"), &["solver.modes"]);
    refused(
        &with("[[joints]]", "[[joints]]\n[joints.limits]\nrate = -1"),
        &["joints[0].limits.rate"],
    );
    refused(
        &with("passive = true", "passive = true\n[joints.limits]\nrate = 1"),
        &["joints[1].limits"],
    );
    refused(&with("passive = true", "pasive = true"), &["joints[1].pasive", "passive"]);
}

#[test]
fn options_of_one_link_are_refused() {
    let folder = tempfile::tempdir().expect("folder");
    let args = ["run", "scene.toml", "--csv", "out.csv", "--method", "modal"];
    let output = execute(folder.path(), LOOP, &args);
    assert_eq!(output.status.code(), Some(2));
    let text = String::from_utf8(output.stderr).expect("text");
    assert!(text.contains("--method: must be absent with a mechanism"), "{text}");
    let args = ["run", "d-fast", "--csv", "out.csv", "--page", "out.html"];
    let output = execute(folder.path(), LOOP, &args);
    let text = String::from_utf8(output.stderr).expect("text");
    assert!(text.contains("--page: must be absent"), "{text}");
    assert_eq!(fs::read_dir(folder.path()).expect("folder").count(), 1);
}

#[test]
fn commands_of_one_link_name_those_that_take_mechanisms() {
    for args in [&["arm", "latch"][..], &["arm", "two-links", "--json"]] {
        let folder = tempfile::tempdir().expect("folder");
        let output = sim().current_dir(folder.path()).args(args).output().expect("program");
        let text = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(
            text.contains("must be an arm of one [link]") && text.contains("compare"),
            "{text}"
        );
        assert_eq!(fs::read_dir(folder.path()).expect("folder").count(), 0);
    }
}

#[test]
fn plans_that_no_chain_can_follow_are_refused() {
    for (args, words) in [
        (&["plan", "two-links", "--to", "1"][..], "--to = [1.0]: must be 2 angles"),
        (&["plan", "two-links", "--to", "1,1.3", "--robust", "0.1"], "--robust: must be absent"),
        (&["plan", "two-links", "--to", "1,1.3", "--duration", "0.1"], "must be"),
        (&["plan", "four-bar", "--to", "1,1,1"], "must be"),
        (&["plan", "two-links", "--to", "1,1.3", "--max-rate", "1,2,3"], "--max-rate = [1.0, 2.0"),
        (
            &["plan", "two-links", "--to", "1,1.3", "--max-torque", "1,0.01"],
            "joints[1].limits.torque",
        ),
        (&["plan", "two-links", "--to", "1,1.3", "--max-rate", "9,0.5"], "joints[1].limits.rate"),
        (&["plan", "a-tip30", "--to", "1", "--max-rate", "1,2"], "--max-rate = [1.0, 2.0]"),
        (&["plan", "a-tip30", "--to", "1,2"], "--to = [1.0, 2.0]: must be one value"),
    ] {
        let folder = tempfile::tempdir().expect("folder");
        let output = sim().current_dir(folder.path()).args(args).output().expect("program");
        let text = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(2), "{args:?}: {text}");
        assert_eq!(text.lines().count(), 1, "{text}");
        assert!(text.contains(words), "{text}");
        assert_eq!(fs::read_dir(folder.path()).expect("folder").count(), 0);
    }
}

/// The reference rod confirms that both joints arrive still.
#[test]
fn a_move_of_two_joints_arrives_still() {
    let folder = tempfile::tempdir().expect("folder");
    let args = ["plan", "two-links", "--to", "1.0,1.3", "--out", "plan"];
    let output = sim().current_dir(folder.path()).args(args).output().expect("program");
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(output.status.success(), "{text}");
    let figure = |line: &str| -> f64 {
        let found = text.lines().find(|text| text.trim().starts_with(line)).expect("a line");
        found.split_whitespace().nth(1).and_then(|word| word.parse().ok()).expect("a number")
    };
    // At two first periods, in % of the length.
    assert!(figure("residual") <= 0.02, "{text}");
    assert!(figure("quintics") > 1.0, "{text}");
    assert!(folder.path().join("plan/index.html").exists());
    assert!(folder.path().join("plan/plan.csv").exists());
}

/// The columns are those of the truth files, the page draws the mechanism, and the two tables can
/// be compared.
#[test]
fn a_loop_is_run_solved_compared_and_drawn() {
    let folder = tempfile::tempdir().expect("folder");
    let run = ["run", "scene.toml", "--csv", "run.csv", "--page", "run.html"];
    let output = execute(folder.path(), LOOP, &run);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let reference = ["reference", "scene.toml", "--csv", "rod.csv"];
    let output = execute(folder.path(), LOOP, &reference);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let truth = include_str!("../truth/mechanisms/four-bar.csv");
    for file in ["run.csv", "rod.csv"] {
        let text = fs::read_to_string(folder.path().join(file)).expect("table");
        assert_eq!(text.lines().next(), truth.lines().next());
        assert_eq!(text.lines().count(), 42);
    }
    let page = fs::read_to_string(folder.path().join("run.html")).expect("page");
    assert_eq!(page.matches("<svg").count(), 5);
    assert!(page.contains("unpauseAnimations"), "nothing moves");
    let compare =
        ["compare", "run.csv", "rod.csv", "--scene", "scene.toml", "--tolerance", "0.002"];
    let output = execute(folder.path(), LOOP, &compare);
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(output.status.success(), "{text}");
    assert!(text.contains("41 common times"), "{text}");
    let strict = ["compare", "run.csv", "rod.csv", "--scene", "scene.toml", "--tolerance", "0"];
    assert_eq!(execute(folder.path(), LOOP, &strict).status.code(), Some(1));
}

/// Without a file nothing is written, and a program reads the same figures.
#[test]
fn figures_are_for_people_and_for_programs() {
    let folder = tempfile::tempdir().expect("folder");
    let said = |args: &[&str]| {
        let output = execute(folder.path(), LOOP, args);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("text")
    };
    let plain = said(&["run", "scene.toml"]);
    let json = said(&["run", "scene.toml", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["rows"], 41);
    let joints = json["joints"].as_array().expect("joints");
    assert_eq!(joints.len(), 3);
    let torque = joints[0]["peak_torque_nm"].as_f64().expect("a torque");
    assert!(torque > 0.0 && plain.contains(&format!("peak torque {torque:.4} N m")), "{plain}");
    let args = ["plan", "two-links", "--to", "1.0,1.3", "--out", "plan", "--json"];
    let output = sim().current_dir(folder.path()).args(args).output().expect("program");
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert!(json["residual"].as_f64().expect("a residual") <= 2e-4, "{json}");
    assert_eq!(json["peak_torque_nm"].as_array().expect("torques").len(), 2);
    let output = execute(folder.path(), LOOP, &["run", "scene.toml", "--page", "out.html"]);
    let text = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(text.contains("must be beside --csv"), "{text}");
    let names = fs::read_dir(folder.path()).expect("folder").count();
    assert_eq!(names, 2, "the scene and the plan");
}

/// Requests that the core's tick does not serve are refused before anything is written.
#[test]
fn runs_beyond_a_limit_or_the_tick_are_refused() {
    let limited =
        |limits: &str| with("[[joints]]", &format!("[[joints]]\n[joints.limits]\n{limits}"));
    let rigid = LATCH.replace("bending_stiffness = 0.46", "rigid = true");
    for (scene, words) in [
        (limited("rate = 1.0"), "moves[0]: limits.rate"),
        (limited("torque = 0.001"), "joints[0].limits.torque"),
        (ARM.replace("tick = 0.01", "tick = 0.1"), "solver.tick = 0.1"),
        (rigid, "closure: "),
    ] {
        let folder = tempfile::tempdir().expect("folder");
        let output = execute(folder.path(), &scene, &["run", "scene.toml", "--csv", "out.csv"]);
        let text = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(2), "{words}: {text}");
        assert_eq!(text.lines().count(), 1, "{text}");
        assert!(text.contains(words) && text.contains("must "), "{text}");
        assert_eq!(fs::read_dir(folder.path()).expect("folder").count(), 1, "{text}");
    }
}

const ARM: &str = include_str!("../truth/mechanisms/arm-dd.toml");
const LATCH: &str = include_str!("../truth/mechanisms/latch.toml");
