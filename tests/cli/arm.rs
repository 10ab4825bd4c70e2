//! `arm`: what a scene is, in words and as JSON.

use std::fs;

use serde_json::Value;

use crate::sim;

/// Runs `arm` on the text of a scene file; returns exit code, output and errors.
fn arm(scene: &str, args: &[&str]) -> (i32, String, String) {
    let folder = tempfile::tempdir().expect("folder");
    fs::write(folder.path().join("arm.toml"), scene).expect("scene");
    let output = sim()
        .current_dir(folder.path())
        .args(["arm", "arm.toml"])
        .args(args)
        .output()
        .expect("program");
    assert_eq!(fs::read_dir(folder.path()).expect("folder").count(), 1, "nothing is written");
    (
        output.status.code().expect("an exit code"),
        String::from_utf8(output.stdout).expect("text"),
        String::from_utf8(output.stderr).expect("text"),
    )
}

fn json(scene: &str) -> Value {
    let (code, out, err) = arm(scene, &["--json"]);
    assert_eq!((code, err.as_str()), (0, ""), "{scene}");
    serde_json::from_str(&out).expect("one JSON object")
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} of {value}"))
}

fn numbers(value: &Value, key: &str) -> Vec<f64> {
    let list = value[key].as_array().unwrap_or_else(|| panic!("{key} of {value}"));
    list.iter().map(|number| number.as_f64().expect("a number")).collect()
}

#[track_caller]
fn near(what: &str, value: f64, expected: f64, relative: f64) {
    let error = value / expected - 1.0;
    assert!(error.abs() <= relative, "{what}: {value} is not {expected}, off by {error:.2e}");
}

const BAR: &str = "[link]\nlength = 0.44\nmass = 0.27646\nbending_stiffness = 94.74\n[payload]\nmass = \
                   0.95\n";
const STRIP: &str = "[link]\nlength = 0.5\nmaterial = \"aluminium\"\nwidth = 0.04\nthickness = \
                     0.004\n[payload]\nmass = 0.5\ninertia = 4e-4\n";

/// First two periods, s, of arms of every kind, by finite elements of another program.
#[test]
fn periods_of_arms_as_people_have_them() {
    let behind = |stiffness: &str| format!("{BAR}[hub]\nstiffness = {stiffness}\n");
    let aluminium = |keys: &str| {
        format!("[link]\nlength = 0.5\nmaterial = \"aluminium\"\n{keys}\n[payload]\nmass = 0.03\n")
    };
    let rod = "[link]\nlength = 0.5\nyoungs_modulus = 200e9\ndensity = 7850\ndiameter = 0.006\n\
               [payload]\nmass = 0.05\n";
    let tube = "[link]\nlength = 0.8\nmaterial = \"aluminium\"\ndiameter = 0.012\nwall = 0.001\n\
                [payload]\nmass = 0.2\n";
    let sensor = "[link]\nlength = 0.3\nyoungs_modulus = 70e9\ndensity = 2700\nwidth = 0.05\n\
                  thickness = 0.002\n[[link.masses]]\nat = 0.24\nmass = 0.005\n";
    let cases = [
        (BAR.to_owned(), 0.109604, 0.0063166),
        (behind("7.1e3"), 0.114586, 0.0066599),
        (behind("230"), 0.215873, 0.0089854),
        (STRIP.to_owned(), 0.249375, 0.0198181),
        (format!("{STRIP}offset = 0.05\n"), 0.283742, 0.0227017),
        (aluminium("width = [0.03, 0.015]\nthickness = 0.002"), 0.238909, 0.0315086),
        (aluminium("width = 0.02\nthickness = [0.003, 0.002]"), 0.175648, 0.0248348),
        (rod.to_owned(), 0.099399, 0.0121855),
        (tube.to_owned(), 0.201113, 0.0131571),
        (sensor.to_owned(), 1.0 / 17.195, 1.0 / 114.49),
    ];
    for (scene, first, second) in cases {
        let report = json(&scene);
        let period = numbers(&report, "period_s");
        near(&scene, period[0], first, 5e-4);
        near(&scene, period[1], second, 2e-3);
        let frequency = numbers(&report, "frequency_hz");
        assert!(frequency.iter().zip(&period).all(|(f, t)| (f * t - 1.0).abs() < 1e-12));
    }
}

#[test]
fn the_figures_are_those_of_the_closed_forms() {
    let scene = format!(
        "{STRIP}[hub]\nradius = 0.1\ninertia = 0.002\n[damping]\nalpha = 0.2\nbeta = 1e-4\n\
         [gravity]\nacceleration = 9.81\n[solver]\ntick = 0.02\n"
    );
    let report = json(&scene);
    let link = 2800.0 * 0.04 * 0.004 * 0.5;
    near("mass", number(&report, "mass_kg"), link + 0.5, 1e-12);
    near("mass of the link", number(&report, "link_mass_kg"), link, 1e-12);
    let stiffness = 69e9 * 0.04 * 0.004f64.powi(3) / 12.0;
    near("stiffness", number(&report, "bending_stiffness_nm2"), stiffness, 1e-12);
    let inertia = link * (0.01 + 0.05 + 0.25 / 3.0) + 0.5 * 0.36 + 4e-4 + 0.002;
    near("inertia", number(&report, "inertia_kgm2"), inertia, 1e-12);
    // Small deflections: q L^4 / 8 EI + F L^3 / 3 EI, 4 % of L.
    let sag = 9.81 * 0.125 * (link / 8.0 + 0.5 / 3.0) / stiffness;
    near("sag", number(&report, "sag_m"), sag, 5e-3);
    let omega = std::f64::consts::TAU * numbers(&report, "frequency_hz")[1];
    near(
        "damping",
        numbers(&report, "damping_ratio")[1],
        0.5 * (0.2 / omega + 1e-4 * omega),
        1e-12,
    );
    near("ticks", numbers(&report, "ticks_per_period")[0], 0.249375 / 0.02, 5e-4);
    assert_eq!(number(&report, "resolved_modes"), 1.0);
    assert!(report["method"].is_null() && report["deduced"] == serde_json::json!({}));
}

/// The words are there for a newcomer, the method and its reason among them.
#[test]
fn the_words_name_every_figure() {
    let (code, out, err) = arm(STRIP, &[]);
    assert_eq!((code, err.as_str()), (0, ""));
    for words in [
        "0.5 m, 224 g, EI 14.72 N m\u{b2}",
        "payload    500 g at the tip",
        "no gravity acts",
        "10 ms resolves vibrations up to 25 Hz, four ticks a period: mode 1",
        "the scene has no moves",
    ] {
        assert!(out.contains(words), "{words} is not in: {out}");
    }
    assert!(
        out.lines().count() <= 12 && out.lines().all(|line| line.chars().count() <= 110),
        "{out}"
    );

    let output = sim().args(["arm", "b-tip30-damped-hub"]).output().expect("program");
    let out = String::from_utf8(output.stdout).expect("text");
    assert_eq!(output.status.code(), Some(0), "{out}");
    for words in [
        "method     elastica, 1 mode, fast: expected to err by ",
        "the cheapest that keeps 0.1 % of L and 1 % of",
        "would err by",
    ] {
        assert!(out.contains(words), "{words} is not in: {out}");
    }
}

/// `auto` takes what `arm` says it takes.
#[test]
fn the_method_is_the_one_that_a_run_takes() {
    let folder = tempfile::tempdir().expect("folder");
    let output = sim()
        .current_dir(folder.path())
        .args(["run", "a-tip30", "--csv", "a.csv"])
        .output()
        .expect("program");
    let ran = String::from_utf8(output.stdout).expect("text");
    let output = sim().args(["arm", "a-tip30", "--json"]).output().expect("program");
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let name = report["method"]["name"].as_str().expect("a name");
    assert!(ran.contains(&format!("chose            {name} (")), "{name} is not in: {ran}");
    assert!(number(&report["method"], "tip_error") <= 1e-3);
    assert!(number(&report["method"], "torque_error") <= 1e-2);
}

#[test]
fn what_is_no_arm_is_refused_in_a_line() {
    for (scene, words) in [
        ("[link]\nlength = 0.5\n", "1:1: link.mass: missing; must be"),
        ("[payload]\nmass = 0.5\n", "link: missing; must be given in the file"),
        (
            "[link]\nlength = -1\nmass = 1\nbending_stiffness = 1\n",
            "2:10: link.length = -1: must be",
        ),
    ] {
        let (code, out, err) = arm(scene, &["--json"]);
        assert_eq!((code, out.as_str(), err.lines().count()), (2, "", 1), "{err}");
        assert!(err.contains(words), "{words} is not in: {err}");
    }
    let output = sim().args(["arm", "no-such-arm"]).output().expect("program");
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("must be a scene file or one of"));
}

/// Deduced values are noted by a run, and the payload's centre has its columns.
#[test]
fn a_run_notes_what_was_deduced() {
    let folder = tempfile::tempdir().expect("folder");
    let scene = "[link]\nlength = 0.4\nmass = 0.0224\nfrequency = 4.0\n[hub]\nstiffness = \
                 20\n[payload]\nmass = 0.03\noffset = 0.02\n[damping]\nratio = 0.01\nfrom = \
                 \"beta\"\n[move]\nprofile = \"quintic\"\nduration = 0.5\nto = 0.5\nsettle = 0.5\n";
    fs::write(folder.path().join("arm.toml"), scene).expect("scene");
    let output = sim()
        .current_dir(folder.path())
        .args(["run", "arm.toml", "--csv", "a.csv", "--method", "elastica"])
        .output()
        .expect("program");
    let notes = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(0), "{notes}");
    let lines: Vec<&str> = notes.lines().collect();
    assert_eq!(lines.len(), 2, "{notes}");
    assert!(lines[0].starts_with("note: bending_stiffness = "), "{notes}");
    assert!(lines[0].ends_with("N m^2, from link.frequency = 4 Hz"), "{notes}");
    assert!(lines[1].starts_with("note: damping.beta = 7.9577e-4 s, from a damping"), "{notes}");
    let table = fs::read_to_string(folder.path().join("a.csv")).expect("table");
    let header: Vec<&str> = table.lines().next().expect("header").split(',').collect();
    assert_eq!(header[8..], ["payload_x_m", "payload_y_m"]);
    let rows = table.lines().skip(1).map(|line| -> Vec<f64> {
        line.split(',').map(|cell| cell.parse().expect("a number")).collect()
    });
    let mut bent: f64 = 0.0;
    for row in rows {
        let [x, y] = [row[8] - row[4], row[9] - row[5]];
        assert!((x.hypot(y) - 0.02).abs() < 1e-6, "{row:?}");
        bent = bent.max((y.atan2(x) - row[1]).abs());
    }
    assert!(bent > 0.01, "the tip turns against the hub: {bent}");
}
