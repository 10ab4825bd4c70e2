//! `identify`: from logs that are sums of decaying sines, in words, as JSON, as a scene.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::sim;

const ARM: &str = "[link]\nlength = 0.4\nmass = 0.0224\nbending_stiffness = 0.46\n[payload]\nmass = \
                   0.03\n";

/// Runs the program in a folder; returns exit code, output and errors.
fn identify(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let output = sim().current_dir(folder).arg("identify").args(args).output().expect("program");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (output.status.code().expect("an exit code"), text(output.stdout), text(output.stderr))
}

fn json(folder: &Path, args: &[&str]) -> Value {
    let (code, out, err) = identify(folder, &[args, &["--json"]].concat());
    assert_eq!((code, err.as_str()), (0, ""), "{args:?}");
    serde_json::from_str(&out).expect("one JSON object")
}

fn refusal(folder: &Path, args: &[&str]) -> String {
    let before = fs::read_dir(folder).expect("folder").count();
    let (code, out, err) = identify(folder, args);
    assert_eq!((code, out.as_str()), (2, ""), "{args:?}");
    assert_eq!(fs::read_dir(folder).expect("folder").count(), before, "nothing is written");
    assert_eq!(err.lines().count(), 1, "{err}");
    err
}

/// Noise in −1 to 1 that is the same on every machine.
fn noise(k: u32) -> f64 {
    let mixed = (u64::from(k) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (mixed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

fn decaying(t: f64, hz: f64, ratio: f64) -> f64 {
    (-ratio * TAU * hz * t).exp() * (TAU * hz * (1.0 - ratio * ratio).sqrt() * t).cos()
}

/// A deflection of two modes, at 200 Hz for 6 s, in mm.
fn ringdown(sample: impl Fn(u32, f64, f64) -> Option<(f64, f64)>) -> String {
    let mut text = "t_s,tip_deflection_mm\n".to_owned();
    for k in 0..1200 {
        let t = 0.005 * f64::from(k);
        let y = 8.0 * decaying(t, 3.8, 0.004) + 0.4 * decaying(t, 31.0, 0.006) + 0.02 * noise(k);
        if let Some((t, y)) = sample(k, t, y) {
            writeln!(text, "{t:.6},{y:.6}").expect("text");
        }
    }
    text
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} of {value}"))
}

fn warned(report: &Value, words: &str) -> bool {
    let warnings = report["warnings"].as_array().expect("warnings");
    warnings.iter().any(|warning| warning.as_str().is_some_and(|text| text.contains(words)))
}

#[test]
fn a_ringdown_becomes_a_scene_that_runs() {
    let folder = tempfile::tempdir().expect("folder");
    let folder = folder.path();
    fs::write(folder.join("log.csv"), ringdown(|_, t, y| Some((t, y)))).expect("log");
    fs::write(folder.join("arm.toml"), ARM).expect("arm");
    let report =
        json(folder, &["log.csv", "--modes", "2", "--scene", "arm.toml", "--out", "fitted.toml"]);
    let modes = report["modes"].as_array().expect("modes");
    for (mode, (hz, ratio)) in modes.iter().zip([(3.8, 0.004), (31.0, 0.006)]) {
        assert!((number(mode, "frequency_hz") / hz - 1.0).abs() < 2e-4, "{mode}");
        assert!((number(mode, "damping_ratio") / ratio - 1.0).abs() < 0.05, "{mode}");
        for (key, truth) in [("frequency_interval_hz", hz), ("damping_interval", ratio)] {
            let ends = mode[key].as_array().expect("two ends");
            let [low, high] = [0, 1].map(|k| ends[k].as_f64().expect("a number"));
            assert!(low < truth && truth < high, "{key}: {low} {high}");
        }
    }
    assert_eq!(modes.len(), 2);
    assert!(number(&report, "fit_percent") > 99.0 && number(&report, "validation_percent") > 97.0);
    assert!(report["delay_s"].is_null() && report["scale"].is_null());
    assert!(number(&report, "offset").abs() < 1e-5);

    let page = fs::read_to_string(folder.join("fitted.html")).expect("a page");
    assert!(page.contains("What to trust") && page.matches("<svg").count() == 5);
    let described = sim().current_dir(folder).args(["arm", "fitted.toml", "--json"]).output();
    let described: Value =
        serde_json::from_slice(&described.expect("program").stdout).expect("JSON");
    assert!((described["frequency_hz"][0].as_f64().expect("Hz") - 3.8).abs() < 1e-3);
    let ratio = described["damping_ratio"][0].as_f64().expect("a ratio");
    assert!((ratio / 0.004 - 1.0).abs() < 0.05, "{ratio}");
    for command in
        [&["run", "fitted.toml", "--csv", "run.csv"][..], &["plan", "fitted.toml", "--to", "0.5"]]
    {
        let output = sim().current_dir(folder).args(command).output().expect("program");
        assert!(
            output.status.success(),
            "{command:?}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
    }

    let (code, words, _) = identify(folder, &["log.csv", "--scene", "arm.toml"]);
    assert!(code == 0 && words.contains("fitted      link.bending_stiffness"), "{words}");
}

#[test]
fn what_is_wrong_with_a_log_is_said() {
    let folder = tempfile::tempdir().expect("folder");
    let folder = folder.path();
    let log = |name: &str, sample: &dyn Fn(u32, f64, f64) -> Option<(f64, f64)>| {
        fs::write(folder.join(name), ringdown(sample)).expect("log");
    };
    log("clipped.csv", &|_, t, y| Some((t, y.clamp(-7.0, 7.0))));
    log("gaps.csv", &|k, t, y| (k % 97 > 6).then_some((t, y)));
    log("jitter.csv", &|k, t, y| {
        let late = 0.0019 * noise(k + 7777);
        Some((t + late, y + 8.0 * (decaying(t + late, 3.8, 0.004) - decaying(t, 3.8, 0.004))))
    });
    log("twice.csv", &|k, t, y| Some((if k % 9 == 4 { t - 0.005 } else { t }, y)));
    log("unix.csv", &|_, t, y| Some((t + 1_764_000_000.0, y)));
    for (name, words) in [
        ("clipped.csv", "clipped samples were dropped"),
        ("gaps.csv", "12 gaps in the times"),
        ("jitter.csv", "intervals between rows vary by"),
        ("twice.csv", "133 rows with the time of the row before"),
        ("unix.csv", ""),
    ] {
        let report = json(folder, &[name]);
        assert!(warned(&report, words) || words.is_empty(), "{name}: {report}");
        let hz = number(&report["modes"][0], "frequency_hz");
        assert!((hz / 3.8 - 1.0).abs() < 1e-3, "{name}: {hz}");
        let ratio = number(&report["modes"][0], "damping_ratio");
        assert!((ratio / 0.004 - 1.0).abs() < 0.1, "{name}: {ratio}");
    }
    // A sample that is held for four rows.
    let held = ringdown(|k, t, _| {
        let t0 = 0.005 * f64::from(k - k % 4);
        Some((t, 8.0 * decaying(t0, 3.8, 0.004) + 0.02 * noise(k - k % 4)))
    });
    fs::write(folder.join("held.csv"), held).expect("log");
    let report = json(folder, &["held.csv"]);
    assert!(warned(&report, "repeat the one before") && report["modes"][0].is_object());
}

#[test]
fn refusals_are_one_line_and_write_nothing() {
    let folder = tempfile::tempdir().expect("folder");
    let folder = folder.path();
    let write = |name: &str, text: String| fs::write(folder.join(name), text).expect("a file");
    write("log.csv", ringdown(|_, t, y| Some((t, y))));
    write("arm.toml", ARM.to_owned());
    write("short.csv", ringdown(|k, t, y| (k < 90).then_some((t, y))));
    write("noise.csv", ringdown(|k, t, _| Some((t, noise(k)))));
    write("back.csv", ringdown(|k, t, y| Some((if k == 500 { 0.1 } else { t }, y))));
    write("slow.csv", ringdown(|k, t, _| (k % 19 == 0).then_some((t, decaying(t, 3.8, 0.002)))));
    write("nameless.csv", "x,y\n1,2\n".to_owned());
    let scene = ["--scene", "arm.toml"];
    let with_scene = |args: &[&'static str]| [args, &scene].concat();
    let cases: Vec<(Vec<&str>, &str)> = vec![
        (vec!["none.csv"], "must be a log as CSV"),
        (vec!["nameless.csv"], "no time column"),
        (vec!["back.csv"], "runs back"),
        (vec!["short.csv"], "must be at least 2"),
        (vec!["noise.csv"], "stands out of the noise"),
        (vec!["slow.csv"], "Nyquist"),
        (vec!["log.csv", "--modes", "4"], "--modes = 4: must be 1 to 3"),
        (vec!["log.csv", "--from", "5", "--to", "4"], "--from = 5: must be less than --to = 4"),
        (vec!["log.csv", "--sensor", "tip"], "--sensor = tip: no such column"),
        (vec!["log.csv", "--sensor-lowpass", "2"], "must be two"),
        (vec!["log.csv", "--free", "clamp"], "must be beside --scene"),
        (with_scene(&["log.csv", "--sensor-mass", "0.01"]), "must be given together"),
        (
            with_scene(&["log.csv", "--sensor-mass", "0.01", "--sensor-at", "0.5"]),
            "--sensor-at = 0.5",
        ),
        (
            with_scene(&["log.csv", "--modes", "1", "--free", "stiffness,clamp"]),
            "2 things are free but the log shows 1 mode",
        ),
    ];
    for (args, words) in cases {
        let error = refusal(folder, &args);
        assert!(error.contains(words), "{args:?}: {error}");
    }
}

/// A mode driven by a hub: `ẍ + 2ζωẋ + ω²x = −θ̈`, the sensor late by 8 ms and of the other sign.
fn forced(turns: &[(f64, f64, f64)]) -> String {
    let (omega, ratio, late, fine) = (TAU * 2.5, 0.02, 0.008, 1e-4);
    let hub = |t: f64| {
        turns.iter().fold(0.0, |angle, &(begin, length, turn)| {
            let s = ((t - begin) / length).clamp(0.0, 1.0);
            angle + turn * s * s * (3.0 - 2.0 * s)
        })
    };
    let push = |t: f64| {
        turns.iter().fold(0.0, |push, &(begin, length, turn)| {
            let s = (t - begin) / length;
            let inside = (0.0..1.0).contains(&s);
            push + if inside { turn * (6.0 - 12.0 * s) / (length * length) } else { 0.0 }
        })
    };
    let (mut x, mut v, mut xs) = (0.0, 0.0, Vec::new());
    for k in 0..60_000 {
        xs.push(x);
        // Half a step of the rate before and after, as leapfrog does.
        let a = |x: f64, v: f64, t: f64| -push(t) - 2.0 * ratio * omega * v - omega * omega * x;
        let middle = v + 0.5 * fine * a(x, v, fine * f64::from(k));
        x += fine * middle;
        v = middle + 0.5 * fine * a(x, middle, fine * (f64::from(k) + 0.999));
    }
    let mut text = "t_s,hub_angle_rad,tip_deflection_m\n".to_owned();
    for k in 0..600 {
        let t = 0.01 * f64::from(k);
        let at = ((t - late).max(0.0) / fine).round() as usize;
        let sensor = -0.4 * xs[at] + 0.003 + 2e-4 * noise(k);
        let encoder = (hub(t) / 5e-4).round() * 5e-4;
        writeln!(text, "{t:.4},{encoder:.5},{sensor:.7}").expect("text");
    }
    text
}

#[test]
fn a_driven_arm_gives_gain_offset_and_delay() {
    let folder = tempfile::tempdir().expect("folder");
    let folder = folder.path();
    let turns = [(0.3, 0.25, 0.4), (1.2, 0.3, -0.6), (2.4, 0.2, 0.5)];
    fs::write(folder.join("a.csv"), forced(&turns)).expect("log");
    let others = [(0.5, 0.3, -0.5), (2.1, 0.2, 0.4), (3.6, 0.25, 0.3)];
    fs::write(folder.join("b.csv"), forced(&others)).expect("log");
    let report = json(folder, &["a.csv", "b.csv", "--sign", "-"]);
    assert_eq!(report["case"], "forced");
    assert_eq!(report["validation_log"], "b.csv");
    let mode = &report["modes"][0];
    assert!((number(mode, "frequency_hz") / 2.5 - 1.0).abs() < 3e-3, "{mode}");
    assert!((number(mode, "damping_ratio") / 0.02 - 1.0).abs() < 0.1, "{mode}");
    assert!((number(&report, "delay_s") - 0.008).abs() < 1e-3, "{report}");
    assert!((number(&report, "scale") / 0.4 - 1.0).abs() < 0.02, "{report}");
    assert!((number(&report, "offset") + 0.003).abs() < 2e-4, "{report}");
    assert!(number(&report, "validation_percent") > 95.0, "{report}");
    assert!(number(&report, "fit_percent") > 97.0, "{report}");

    // A hub that never moves.
    let rest: String = ringdown(|_, t, y| Some((t, y)))
        .replace("t_s,tip_deflection_mm", "t_s,tip_deflection_mm,hub_angle_rad")
        .lines()
        .map(
            |line| {
                if line.starts_with('t') { format!("{line}\n") } else { format!("{line},0.5\n") }
            },
        )
        .collect();
    fs::write(folder.join("rest.csv"), rest).expect("log");
    let report = json(folder, &["rest.csv"]);
    assert!(report["case"] == "ring-down" && warned(&report, "the hub never moved"));
}
