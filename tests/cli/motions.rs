//! Motions from files and from waypoints: what is taken, and what is refused in one line.

use std::fs;
use std::path::Path;

use crate::sim;

const SCENE: &str = "[link]\nlength = 0.4\nmass = 0.019\nbending_stiffness = 0.0427\n\
                     [payload]\nmass = 0.03\n[limits]\nrate = 2.0\n\
                     [move]\nprofile = \"cubic\"\nduration = 1.0\nto = 0.5\n";

const HEADER: &str = "t_s,hub_angle_rad,hub_rate_rad_s\n";

/// Runs the program; returns its exit code, its notes or its error.
fn run(folder: &Path, args: &[&str]) -> (i32, String) {
    let output = sim().current_dir(folder).args(args).output().expect("program");
    let text = String::from_utf8(output.stderr).expect("text");
    (output.status.code().expect("an exit code"), text)
}

/// An arm that has no moves of its own takes a motion from a file, and a move of `plan`.
#[test]
fn an_arm_without_moves_takes_a_motion() {
    let folder = tempfile::tempdir().expect("folder");
    let arm = SCENE.split("[move]").next().expect("an arm");
    fs::write(folder.path().join("arm.toml"), arm).expect("arm");
    fs::write(folder.path().join("m.csv"), format!("{HEADER}0,0,0\n0.5,0.1,0\n")).expect("motion");
    let run = |args: &[&str]| run(folder.path(), args);
    let motion = ["--motion", "m.csv"];
    for command in ["run", "reference"] {
        let csv = format!("{command}.csv");
        let (code, error) = run(&[&[command, "arm.toml", "--csv", &csv], &motion[..]].concat());
        assert_eq!(code, 0, "{command}: {error}");
        let (code, error) = run(&[command, "arm.toml", "--csv", "none.csv"]);
        assert!(code == 2 && error.contains("move"), "{command}: {error}");
    }
    let (code, error) = run(&["plan", "arm.toml", "--to", "0.5", "--duration", "1.0"]);
    assert_eq!(code, 0, "plan: {error}");
}

/// Runs a motion file that is refused in one line, with nothing written.
fn refused(file: &str, text: &str, args: &[&str], words: &[&str]) {
    let folder = tempfile::tempdir().expect("folder");
    fs::write(folder.path().join("scene.toml"), SCENE).expect("scene");
    fs::write(folder.path().join(file), text).expect("motion");
    let mut all = vec!["run", "scene.toml", "--csv", "out.csv", "--motion", file];
    all.extend(args);
    let (code, error) = run(folder.path(), &all);
    assert_eq!((code, error.lines().count()), (2, 1), "{text}: {error}");
    for word in words {
        assert!(error.contains(word), "{word} is not in: {error}");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("folder").count(), 2, "nothing is written");
}

#[test]
fn a_bad_csv_is_refused_with_line_and_column() {
    let cases: [(&str, &[&str]); 11] = [
        ("0,0,0\n0.5,nan,0\n", &["line 3: hub_angle_rad = NaN", "finite"]),
        ("0,0,0\n0.5,far,0\n", &["line 3: hub_angle_rad = \"far\"", "a number"]),
        ("0,0,0\n0.5,0.1,inf\n", &["line 3: hub_rate_rad_s = inf", "finite"]),
        ("0,0,0\n0.5,0.1,0\n0.4,0.2,0\n", &["line 4: t_s = 0.4", "later than 0.5"]),
        ("0,0,0\n0.5,0.1,0\n0.5,0.2,0\n", &["line 4: t_s = 0.5", "two have one time"]),
        ("0,0,0\n0.5,0.1\n", &["line 3: 2 columns", "must be 3"]),
        ("", &["no rows"]),
        ("0,0,0\n", &["one row", "two at least"]),
        ("0,0,0.3\n0.5,0.1,0\n", &["line 2: hub_rate_rad_s = 0.3", "must be 0"]),
        ("0,0,0\n0.5,0.1,0\n0.6,3,0\n", &["line 4", "limits.rate = 2", "a duration of"]),
        ("0,0,0\n0.5,0.1,0\n0.51,30,0\n", &["line 4", "radian"]),
    ];
    for (rows, words) in cases {
        refused("motion.csv", &format!("{HEADER}{rows}"), &[], words);
    }
    let words = ["line 1: no column t_s among \"time, hub_angle_rad\""];
    refused("motion.csv", "time,hub_angle_rad\n0,0\n", &[], &words);
    let good = format!("{HEADER}0,0,0\n1,0.1,0\n");
    refused("motion.csv", &good, &["--joint", "elbow"], &["--joint = elbow", "absent"]);
    refused("motion.csv", &good, &["--noise", "0.1"], &["--noise = 0.1", "absent"]);
    refused("motion.csv", &good, &["--as", "samples"], &["2 rows", "at least 8"]);
    refused("motion.csv", &good, &["--as", "points"], &["points", "samples"]);
    let turning: String =
        (0..40).map(|k| format!("{},{}\n", 0.01 * f64::from(k), 0.02 * f64::from(k))).collect();
    let turning = format!("t_s,hub_angle_rad\n{turning}");
    refused("motion.csv", &turning, &["--as", "samples"], &["turning at 2.0000 rad/s", "rest"]);
    refused("motion.csv", &turning, &["--as", "samples", "--noise", "-1"], &["--noise = -1"]);
}

const POINTS: &str = r#"{"joint_names": ["shoulder", "elbow"], "points": [
  {"positions": [0, 0], "velocities": [0, 0], "time_from_start": {"sec": 0, "nanosec": 0}},
  {"positions": [1, 0.5], "velocities": [0, 0], "time_from_start": {"sec": 1, "nanosec": 0}}]}"#;

#[test]
fn a_bad_trajectory_is_refused_with_its_point() {
    let elbow = ["--joint", "elbow"];
    refused("t.json", POINTS, &[], &["2 joints", "shoulder, elbow"]);
    refused("t.json", POINTS, &["--joint", "knee"], &["--joint = knee", "shoulder, elbow"]);
    let with = |good: &str, bad: &str| {
        assert!(POINTS.contains(good), "{good}");
        POINTS.replacen(good, bad, 1)
    };
    let cases = [
        (with("[1, 0.5]", "[1]"), "points[1]: positions: 1 numbers"),
        (with("[1, 0.5]", "[1, null]"), "points[1].positions[1]"),
        (with("{\"sec\": 1", "{\"sec\": 0"), "points[1]: time_from_start = 0"),
        (with("{\"sec\": 1", "{\"sec\": -1"), "points[1]: time_from_start = -1"),
        (with("\"points\"", "\"pints\""), "points: missing"),
        (with("[1, 0.5]", "[1, 5.0]"), "points[1]: limits.rate = 2"),
        (with("]}", ""), "must be a trajectory_msgs/JointTrajectory"),
    ];
    for (text, words) in cases {
        refused("t.json", &text, &elbow, &[words]);
    }
    let yaml = "joint_names: [elbow]\npoints:\n- positions: [.nan]\n  time_from_start: {sec: 1}\n";
    refused("t.yaml", yaml, &[], &["points[0]: positions = NaN"]);
    let yaml = "joint_names: [elbow]\npoints:\n- positions: [far]\n  time_from_start: {sec: 1}\n";
    refused("t.yaml", yaml, &[], &["line 3, column"]);
}

#[test]
fn bad_waypoints_are_refused_with_line_and_row() {
    let cases = [
        ("[[0.5, 0.1], [0.5, 0.2]]", "move.waypoints[1][0]: t = 0.5 s", "two rows"),
        ("[[0.5, 0.1], [0.4, 0.2]]", "move.waypoints[1][0]: t = 0.4 s", "later than 0.5"),
        ("[[0.5, nan]]", "move.waypoints[0] = [0.5, NaN]", "finite"),
        ("[[0.5]]", "move.waypoints[0] = [0.5]", "[t, angle, rate]"),
        ("[]", "move.waypoints", "one row at least"),
        ("[[0, 0, 0.5], [1, 1]]", "move.waypoints[0]: 0.5 rad/s", "must be 0"),
        ("[[0.5, 0.1], [0.6, 2.0]]", "move.waypoints[1]: limits.rate", "a duration of"),
        ("[[0.5, 0.1]]\nrepeat = 0", "move.repeat = 0", "1 to"),
        ("[[0.5, 0.1]]\nto = 1.0", "move.to = 1", "absent beside"),
        ("[[0.5, 0.1]]\nprofile = \"cycloid\"", "move.profile = \"cycloid\"", "cubic or quintic"),
    ];
    let head = SCENE.split("[move]").next().expect("a head");
    for (rows, words, advice) in cases {
        let folder = tempfile::tempdir().expect("folder");
        fs::write(folder.path().join("scene.toml"), format!("{head}[move]\nwaypoints = {rows}\n"))
            .expect("scene");
        let (code, error) = run(folder.path(), &["run", "scene.toml", "--csv", "out.csv"]);
        assert_eq!((code, error.lines().count()), (2, 1), "{rows}: {error}");
        assert!(error.contains(words) && error.contains(advice), "{rows}: {error}");
        assert!(error.starts_with("error: scene.toml:"), "{rows}: {error}");
        assert_eq!(fs::read_dir(folder.path()).expect("folder").count(), 1);
    }
}
