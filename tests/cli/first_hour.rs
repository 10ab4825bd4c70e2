//! Commands for someone who has a strip, a motor and an hour: a scene to start from, the page that
//! moves, plots in the terminal, words for the shell.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use stillbeam_sim::scene_file::SceneFile;

use crate::sim;

/// Flags of a whole scene.
const STRIP: [&str; 10] = [
    "--length",
    "0.5",
    "--material",
    "aluminium",
    "--width",
    "0.02",
    "--thickness",
    "0.002",
    "--payload",
    "0.05",
];

fn run(folder: &Path, args: &[&str]) -> Output {
    sim().current_dir(folder).args(args).output().expect("program")
}

/// Runs what must succeed silently on standard error. Returns standard output.
fn said(folder: &Path, args: &[&str]) -> String {
    let output = run(folder, args);
    let (out, err) = (String::from_utf8(output.stdout), String::from_utf8(output.stderr));
    assert_eq!((output.status.code(), err.as_deref()), (Some(0), Ok("")), "{args:?}");
    out.expect("text")
}

/// Runs what must be refused in one line, and leave the folder as it was. Returns the line.
fn refused(folder: &Path, args: &[&str]) -> String {
    let files = |folder: &Path| fs::read_dir(folder).expect("folder").count();
    let before = files(folder);
    let output = run(folder, args);
    let line = String::from_utf8(output.stderr).expect("text");
    assert_eq!((output.status.code(), line.lines().count()), (Some(2), 1), "{args:?}: {line}");
    assert_eq!(files(folder), before, "{args:?}");
    line
}

#[test]
fn a_new_scene_runs_and_says_what_it_is() {
    let folder = tempfile::tempdir().expect("folder");
    let out = said(folder.path(), &[&["new"], &STRIP[..]].concat());
    for words in [
        "2.973", // Hz
        "10 ms resolves vibrations up to 25 Hz",
        "in doubt   a thickness off by 0.05 mm moves the first frequency by 3.5 %",
        "the modulus of aluminium off by 5 % moves the first frequency by 2.5 %",
        "method",
        "stillbeam-sim run arm.toml",
    ] {
        assert!(out.contains(words), "{words} is not in:\n{out}");
    }
    let scene = SceneFile::read(&folder.path().join("arm.toml")).expect("a scene");
    assert_eq!((scene.arm.link.length, scene.arm.payload.mass), (0.5, 0.05));
    assert!(said(folder.path(), &["run", "arm.toml"]).contains("setpoints; --csv OUT.csv"));
    // It is the user's now.
    let line = refused(folder.path(), &[&["new"], &STRIP[..]].concat());
    assert!(line.contains("arm.toml: exists; must be"), "{line}");
}

#[test]
fn without_a_terminal_what_is_missing_is_named() {
    let folder = tempfile::tempdir().expect("folder");
    let line = refused(folder.path(), &["new", "--length", "0.5", "--width", "0.02"]);
    assert!(line.contains("--material, --thickness, --payload: missing; must be given"), "{line}");
    let mut strip = STRIP;
    strip[3] = "cheese";
    let line = refused(folder.path(), &[&["new"], &strip[..]].concat());
    assert!(line.contains("link.material = \"cheese\": must be one of"), "{line}");
    strip = STRIP;
    strip[1] = "-1";
    let line = refused(folder.path(), &[&["new"], &strip[..]].concat());
    assert!(line.contains("link.length = -1: must be"), "{line}");
}

/// Runs the program in a terminal of its own, which is fed with `keys`.
fn in_terminal(folder: &Path, args: &str, keys: &str) -> String {
    let script = format!(
        "printf '{keys}' | TERM=xterm script --quiet --return --command '{} {args}' /dev/null",
        env!("CARGO_BIN_EXE_stillbeam-sim")
    );
    let output = Command::new("sh").args(["-c", &script]).current_dir(folder).output();
    let output = output.expect("a terminal");
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{args}: {said}");
    said
}

#[test]
fn on_a_terminal_what_is_missing_is_asked_for() {
    let folder = tempfile::tempdir().expect("folder");
    // The length is typed, the material is the one that is marked.
    let args = "new own.toml --width 0.02 --thickness 0.002 --payload 0.05";
    let said = in_terminal(folder.path(), args, "0.4\\r\\r");
    assert!(said.contains("Length of the link") && said.contains("Material"), "{said}");
    let scene = SceneFile::read(&folder.path().join("own.toml")).expect("a scene");
    assert_eq!(scene.arm.link.length, 0.4);
    assert!((scene.arm.link.bending_stiffness - 0.92).abs() < 1e-12, "aluminium");
}

#[test]
fn a_terminal_shows_a_plot_and_a_pipe_does_not() {
    let folder = tempfile::tempdir().expect("folder");
    let seen = in_terminal(folder.path(), "run d-fast --method elastica", "");
    for words in ["deflection, mm, over 0 to", "torque, N m, over 0 to", "\u{2524}"] {
        assert!(seen.contains(words), "{words} is not in:\n{seen}");
    }
    let piped = said(folder.path(), &["run", "d-fast", "--method", "elastica"]);
    assert!(!piped.contains("over 0 to"), "{piped}");
}

#[test]
fn programs_read_json() {
    let folder = tempfile::tempdir().expect("folder");
    let args = ["run", "b-tip30", "--method", "elastica", "--json", "--csv", "run.csv"];
    let run: Value = serde_json::from_str(&said(folder.path(), &args)).expect("JSON");
    let rows =
        fs::read_to_string(folder.path().join("run.csv")).expect("table").lines().count() - 1;
    assert_eq!(run["setpoints"], rows);
    assert!(run["peak_effort"].as_f64().is_some_and(|torque| torque > 0.0), "{run}");
    let args = ["plan", "b-tip30", "--to", "1.57", "--duration", "1", "--json"];
    let plan: Value = serde_json::from_str(&said(folder.path(), &args)).expect("JSON");
    assert_eq!(plan["duration_s"], 1.0);
    assert!(plan["residual"].as_f64().is_some_and(|left| left < 1e-3), "{plan}");
    assert_eq!(plan["page"], "plan/index.html");
}

#[test]
fn the_playground_is_written_whole() {
    let folder = tempfile::tempdir().expect("folder");
    assert_eq!(said(folder.path(), &["playground", "--out", "web/index.html"]), "web/index.html\n");
    let page = fs::read_to_string(folder.path().join("web/index.html")).expect("page");
    assert_eq!(page, stillbeam_sim::playground::PAGE);
    assert!(page.ends_with("</html>\n"));
}

/// The page is there, so that a browser which is not is no error.
#[test]
fn a_page_that_cannot_be_shown_is_a_note() {
    let folder = tempfile::tempdir().expect("folder");
    let mut sim = sim();
    sim.current_dir(folder.path()).env("PATH", "/nowhere").args(["playground", "--open"]);
    let output = sim.output().expect("program");
    let notes = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(0), "{notes}");
    assert!(notes.starts_with("note: --open: "), "{notes}");
    assert!(notes.contains("open playground.html yourself"), "{notes}");
}

#[test]
fn shells_and_man_know_every_command() {
    let folder = tempfile::tempdir().expect("folder");
    let help = said(folder.path(), &["--help"]);
    let names: Vec<&str> = help
        .lines()
        .skip_while(|line| !line.starts_with("Commands:"))
        .skip(1)
        .take_while(|line| !line.is_empty())
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(names.contains(&"run") && names.contains(&"new"), "{names:?}");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = said(folder.path(), &["completions", shell]);
        for name in &names {
            assert!(script.contains(name), "{shell} does not know {name}");
        }
    }
    said(folder.path(), &["man", "pages"]);
    for name in names.iter().filter(|name| **name != "help") {
        let page = fs::read_to_string(folder.path().join(format!("pages/stillbeam-sim-{name}.1")));
        let page = page.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(page.contains(".SH SYNOPSIS"), "{page}");
    }
    let line = refused(folder.path(), &["completions", "cmd"]);
    assert!(line.contains("bash") && line.contains("zsh"), "{line}");
}

/// A move too quick for a still one, so that half of the trials are left out.
const QUICK: &str = "link = { length = 0.25, mass = 0.02, bending_stiffness = 0.5 }\n\
    payload = { mass = 0.05 }\n\
    move = { profile = \"quintic\", duration = 0.06, to = 0.1, settle = 0.02 }\n";

#[test]
fn a_drive_is_drawn_in_the_terminal_and_moves_on_its_page() {
    let folder = tempfile::tempdir().expect("folder");
    fs::write(folder.path().join("quick.toml"), QUICK).expect("a scene");
    let seen = in_terminal(folder.path(), "drive quick.toml --out drive", "");
    for words in [
        "hub behind its command, mrad; sent: position, over 0 to",
        "hub behind its command, mrad; sent: position, velocity, torque, over 0 to",
    ] {
        assert!(seen.contains(words), "{words} is not in:\n{seen}");
    }
    let page = fs::read_to_string(folder.path().join("drive/index.html")).expect("page");
    assert_eq!(page.matches("<figure class=\"moving\"").count(), 1);
    assert!(page.contains("unpauseAnimations") && page.contains("href=\"moving.svg\""));
    let svg = fs::read_to_string(folder.path().join("drive/moving.svg")).expect("picture");
    let svg = roxmltree::Document::parse(&svg).expect("XML");
    let arms = svg.descendants().filter(|node| node.attribute("attributeName") == Some("d"));
    assert_eq!(arms.count(), 2);
}

#[test]
fn programs_read_json_of_drives_and_references() {
    let folder = tempfile::tempdir().expect("folder");
    fs::write(folder.path().join("quick.toml"), QUICK).expect("a scene");
    let output = run(folder.path(), &["drive", "quick.toml", "--json"]);
    let drive: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let trials = drive["trials"].as_array().expect("trials");
    let hub = |k: usize| trials[k]["hub_rad"].as_f64().expect("rad");
    assert_eq!((trials[0]["sent"].as_str(), trials.len()), (Some("position"), 6));
    assert!(hub(2) > 0.0 && hub(2) < 0.5 * hub(0), "{drive}");
    assert!(drive["no_still"].is_string() && drive["page"].is_null(), "{drive}");
    let args = ["reference", "d-fast", "--json", "--every", "0.01"];
    let solved: Value = serde_json::from_str(&said(folder.path(), &args)).expect("JSON");
    assert_eq!((&solved["rows"], &solved["every_s"]), (&41.into(), &0.01.into()));
    assert!(solved["peak_effort"].as_f64().is_some_and(|torque| torque > 0.0), "{solved}");
}

#[test]
fn a_page_that_is_not_written_is_not_shown() {
    let folder = tempfile::tempdir().expect("folder");
    for (args, words) in [
        (&["drive", "d-fast", "--open"][..], "no page is written; must be beside --out DIR"),
        (&["identify", "log.csv", "--open"], "no page is written; must be beside --page or --out"),
        (
            &["run", "four-bar", "--csv", "a.csv", "--open"],
            "no page is written; must be beside --page OUT.html",
        ),
        (
            &["reference", "four-bar", "--csv", "a.csv", "--open"],
            "no page is written; must be beside --page OUT.html",
        ),
        (&["run", "d-fast", "--open"], "must be absent with an arm"),
        (&["reference", "d-fast", "--open"], "must be absent with an arm"),
    ] {
        let line = refused(folder.path(), args);
        assert!(line.contains(&format!("--open: {words}")), "{args:?}: {line}");
    }
}

/// Every command that reads a scene takes a tick in place of the scene's, and means the same by it.
#[test]
fn a_typed_tick_takes_the_place_of_the_scenes() {
    let folder = tempfile::tempdir().expect("folder");
    let tick = ["--tick", "0.003"];
    let newmark = ["--method", "newmark", "--scalar", "f64"];
    let rows = |name: &str| fs::read_to_string(folder.path().join(name)).expect("table");
    for args in [
        &[&["run", "d-fast", "--csv", "run.csv"], &newmark[..], &tick].concat()[..],
        &[&["reference", "d-fast", "--csv", "rod.csv"][..], &tick].concat(),
    ] {
        let output = run(folder.path(), args);
        let notes = String::from_utf8(output.stderr).expect("text");
        assert!(notes.contains("move.duration = 0.2 s") && notes.contains("0.201 s"), "{notes}");
    }
    assert_eq!(rows("run.csv").lines().count(), rows("rod.csv").lines().count());
    let compared = ["compare", "run.csv", "rod.csv", "--scene", "d-fast"];
    let text = said(folder.path(), &[&compared[..], &tick].concat());
    assert!(text.starts_with("135 common times"), "{text}");
    let args = ["plan", "b-tip30", "--to", "1", "--duration", "1", "--json", "--tick", "0.004"];
    let plan: Value = serde_json::from_str(&said(folder.path(), &args)).expect("JSON");
    assert_eq!((&plan["ticks"], &plan["duration_s"]), (&250.into(), &1.0.into()));
    assert!(said(folder.path(), &["arm", "d-fast", "--tick", "0.004"]).contains("4 ms resolves"));
    for args in [&["reference", "d-fast"][..], &["arm", "d-fast"], &compared] {
        let line = refused(folder.path(), &[args, &["--tick", "-1"]].concat());
        assert!(line.contains("solver.tick = -1: must be"), "{line}");
    }
}
