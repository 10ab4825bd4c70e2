//! Notes: which move they are of, each once; and values that are probably in another unit.

use std::fs;

use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::scenes;

use crate::sim;

const LINK: &str = "[link]\nlength = 0.4\nmass = 0.0224\nbending_stiffness = 0.46\n";
const MOVE: &str = "[move]\nprofile = \"cubic\"\nduration = 5.0\nto = 1.0\n";

fn remarks(text: &str) -> Vec<String> {
    SceneFile::parse("test", text).expect(text).remarks
}

#[test]
fn rounded_moves_share_a_line() {
    let moves: String = (0..40)
        .map(|k| {
            let to = f64::from((k + 1) % 2);
            format!("[[moves]]\nprofile = \"cubic\"\nduration = 0.333\nto = {to}\nsettle = 0.2\n")
        })
        .collect();
    let scene = SceneFile::parse("test", &format!("{LINK}{moves}")).expect("scene");
    let notes = scene.roundings(0.01).expect("notes");
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert!(
        notes[0].starts_with("moves[0], moves[1] and 38 more: duration = 0.333 s"),
        "{notes:?}"
    );
}

#[test]
fn values_in_other_units_are_remarked_on() {
    let cases = [
        (
            "to = 1.0",
            "to = 90",
            "move.to = 90: 90 rad are 14.3 turns; angles are in rad (90 deg = 1.5708 rad)",
        ),
        ("mass = 0.0224", "mass = 22.4", "link.mass = 22.4"),
        ("length = 0.4", "length = 400.0", "link.length = 400"),
        (
            "bending_stiffness = 0.46",
            "bending_stiffness = 460000.0",
            "link.bending_stiffness = 460000",
        ),
        (
            "bending_stiffness = 0.46",
            "material = \"aluminium\"\nwidth = 0.01\nthickness = 0.2",
            "link.thickness = 0.2",
        ),
        ("[move]", "[payload]\nmass = 30.0\n[move]", "payload.mass = 30"),
        ("[move]", "[damping]\nbeta = 0.5\n[move]", "damping.beta = 0.5"),
        ("[move]", "[limits]\nrate = 180.0\n[move]", "limits.rate = 180"),
        ("[move]", "[gravity]\nacceleration = 1.0\n[move]", "gravity.acceleration = 1"),
        ("[move]", "[hub]\nradius = 40.0\n[move]", "hub.radius = 40"),
        ("duration = 5.0", "duration = 500", "move.duration = 500"),
        ("[move]", "[solver]\ntick = 0.2\n[move]", "solver.tick = 0.2"),
    ];
    for (good, bad, words) in cases {
        let text = format!("{LINK}{MOVE}").replacen(good, bad, 1);
        let lines = remarks(&text);
        assert_eq!(lines.len(), 1, "{bad}: {lines:?}");
        assert!(lines[0].starts_with(words), "{words} does not begin: {}", lines[0]);
    }
}

/// A refusal that a wrong unit leads to comes with the remark.
#[test]
fn a_refusal_takes_the_remark_along() {
    let text = format!("{LINK}{MOVE}").replace("5.0", "0.5").replace("to = 1.0", "to = 90");
    let error = SceneFile::parse("arm.toml", &text).expect_err("too fast").to_string();
    assert!(error.starts_with("arm.toml:") && error.contains("90 rad are 14.3 turns"), "{error}");
}

#[test]
fn what_is_meant_is_not_remarked_on() {
    for (name, _) in scenes::list() {
        let scene = scenes::open(name).expect("embedded scene");
        assert_eq!(scene.remarks, Vec::<String>::new(), "{name}");
    }
    // Ten turns, asked for in turns; a hub that turns on and on; a rubber strip, a tape, a tube.
    let turns = MOVE.replace("to = 1.0", "to = 62.83185307");
    let spun = "[[moves]]\nprofile = \"spin-up\"\nduration = 5.0\nrate = 20.0\n[[moves]]\nprofile = \
                \"spin-up\"\nduration = 5.0\nrate = 0.0\n[[moves]]\nprofile = \"cubic\"\nduration = \
                2.0\nto = 101.0\n";
    let rubber = "[link]\nlength = 0.2\nmass = 0.0048\nyoungs_modulus = 5e6\nwidth = 0.01\nthickness \
                  = 0.002\n";
    let tape = "[link]\nlength = 1.0\nmaterial = \"steel\"\nwidth = 0.025\nthickness = 0.0005\n";
    let tube = "[link]\nlength = 2.0\nmass = 0.8\nbending_stiffness = 900.0\n";
    let all = [(LINK, turns.as_str()), (LINK, spun), (rubber, MOVE), (tape, MOVE), (tube, MOVE)];
    for (link, moves) in all {
        assert_eq!(remarks(&format!("{link}{moves}")), Vec::<String>::new(), "{link}{moves}");
    }
}

#[test]
fn a_remark_is_a_note_and_no_refusal() {
    let folder = tempfile::tempdir().expect("folder");
    let text = format!("{LINK}{MOVE}").replace("to = 1.0", "to = 90\nsettle = 0.2");
    fs::write(folder.path().join("arm.toml"), text).expect("scene");
    let args = ["run", "arm.toml", "--csv", "out.csv"];
    let output = sim().current_dir(folder.path()).args(args).output().expect("program");
    let words = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(0), "{words}");
    assert!(words.starts_with("note: move.to = 90: 90 rad are 14.3 turns"), "{words}");
    assert!(words.lines().all(|line| line.starts_with("note: ")), "{words}");
    assert_eq!(words.matches("14.3 turns").count(), 1, "{words}");
}
