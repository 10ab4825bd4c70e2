//! Text that cannot be parsed is refused in one line with file, line, column and key; and no text,
//! however mangled, ends in anything else.

use std::fs;

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam_sim::error::Error;
use stillbeam_sim::scene_file::SceneFile;

use crate::sim;

const GOOD: &str = "[link]
length = 0.4
mass = 0.0224
bending_stiffness = 0.46

[payload]
mass = 0.03

[[moves]]
profile = \"cubic\"
duration = 0.5
to = 1.0
settle = 0.5

[[moves]]
profile = \"quintic\"
duration = 0.5
to = 0.0

[solver]
elements = 1
";

fn refusal(text: &str) -> String {
    SceneFile::parse("arm.toml", text).expect_err(text).to_string()
}

#[test]
fn errors_have_a_line_a_column_and_a_key() {
    let cases = [
        (
            "mass = 0.03",
            "mass = 0,03",
            "7:8: payload.mass = 0,03: must be a number with a decimal point, e.g. 0.03",
        ),
        (
            "duration = 0.5\nto = 1.0",
            "duration = 0.5 s\nto = 1.0",
            "11:12: moves[0].duration = 0.5 s: must be a number without its unit, in SI units, e.g. 0.5",
        ),
        (
            "to = 1.0",
            "to = 90deg",
            "12:6: moves[0].to = 90deg: must be a number in rad: 90 deg are 1.5708",
        ),
        (
            "length = 0.4",
            "length = 400 mm # long",
            "2:10: link.length = 400 mm: must be a number without its unit, in SI units, e.g. 0.4",
        ),
        ("to = 1.0\n", "to = 1.0\nto = 2.0\n", "13:1: moves[0].to: given twice, first in line 12"),
        (
            "\"cubic\"",
            "cubic",
            "10:11: moves[0].profile = cubic: must be in quotes if it is a name, \"cubic\"",
        ),
        ("[[moves]]\nprofile = \"cubic\"", "[moves]\nprofile = \"cubic\"", ""),
        (
            "mass = 0.0224",
            "mas = 0.0224",
            "3:1: link.mas: unknown key; must be one of length, mass, ",
        ),
        ("mass = 0.0224", "mas = 0.0224", "is it mass?"),
        (
            "[payload]",
            "[paylod]",
            "6:2: paylod: unknown key; must be one of unit, link, axis, hub, payload, ",
        ),
        (
            "mass = 0.03",
            "mass = \"0.03\"",
            "7:8: payload.mass = \"0.03\": must be a number without quotes, e.g. 0.03",
        ),
        ("mass = 0.03", "mass = true", "7:8: payload.mass = true: must be a number"),
        ("elements = 1", "elements = 1.5", "21:12: solver.elements = 1.5: must be a whole number"),
        (
            "elements = 1",
            "method = \"newmrk\"",
            "21:10: solver.method = \"newmrk\": must be one of rigid, newmark, ",
        ),
        ("length = 0.4", "length = -0.4", "2:10: link.length = -0.4: must be"),
        ("to = 0.0", "to = 0.0\nsettle = -1.0", "19:10: moves[1]: move.settle = -1: must be"),
        ("\"quintic\"", "\"quintc\"", "16:11: moves[1]: move.profile = \"quintc\": must be"),
        ("elements = 1", "tick = 0.0", "21:8: solver.tick = 0: must be"),
        ("[link]", "[link", "1:"),
        ("mass = 0.03", "mass =", "7:7: payload.mass = : must be a value behind the ="),
    ];
    for (good, bad, words) in cases {
        assert!(GOOD.contains(good), "{good}");
        let error = refusal(&GOOD.replacen(good, bad, 1));
        assert!(error.starts_with("arm.toml:"), "{error}");
        assert!(error.contains(words), "{words} is not in: {error}");
        assert!(error.contains("must be") && !error.contains('\n'), "{error}");
    }
}

#[test]
fn single_brackets_of_moves_are_told() {
    let text = GOOD.split("\n[[moves]]").next().expect("a head").to_owned()
        + "\n[moves]\nprofile = \"cubic\"\nduration = 0.5\nto = 1.0\n";
    let error = refusal(&text);
    assert!(error.contains(":9:1: moves: must be [[moves]] in double brackets"), "{error}");
}

#[test]
fn the_program_says_it_in_one_line() {
    let folder = tempfile::tempdir().expect("folder");
    fs::write(folder.path().join("arm.toml"), GOOD.replace("0.03", "0,03")).expect("scene");
    for args in [
        &["run", "arm.toml", "--csv", "out.csv"][..],
        &["reference", "arm.toml", "--csv", "out.csv"],
        &["plan", "arm.toml", "--to", "1.0", "--out", "out.csv"],
        &["compare", "a.csv", "b.csv", "--scene", "arm.toml"],
    ] {
        let output = sim().current_dir(folder.path()).args(args).output().expect("program");
        let text = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert_eq!(text.lines().count(), 1, "{text}");
        assert!(text.starts_with("error: arm.toml:7:8: payload.mass = 0,03: must be"), "{text}");
        assert!(!folder.path().join("out.csv").exists());
    }
}

/// An arm of every kind of table.
const ARM: &str = "[link]
material = \"aluminium\"
frequency = [9.0, 60.0]

[[link.sections]]
length = 0.2
width = [0.03, 0.02]
thickness = 0.01

[[link.sections]]
length = 0.3
diameter = 0.012
wall = 0.001

[[link.masses]]
at = 0.25
mass = 0.015

[hub]
stiffness = 230

[payload]
mass = 0.05
offset = 0.02

[damping]
ratio = 0.02
from = \"joint\"
";

/// Bytes struck out, doubled, swapped, put in and cut off at random: a scene, or one line.
#[test]
fn mangled_scenes_are_read_or_refused_in_a_line() {
    let refused = mangled(GOOD, 1000, SceneFile::parse);
    assert!((170..997).contains(&refused), "{refused}");
}

#[test]
fn mangled_arms_are_read_or_refused_in_a_line() {
    SceneFile::parse_arm("arm.toml", ARM).expect("an arm");
    let refused = mangled(ARM, 150, SceneFile::parse_arm);
    assert!((40..148).contains(&refused), "{refused}");
}

/// Reads a text `count` times with other mistakes and returns how often it is refused.
fn mangled(good: &str, count: usize, read: fn(&str, &str) -> Result<SceneFile, Error>) -> u32 {
    let mut rng = StdRng::seed_from_u64(13);
    let inserted = ["=", "\"", "[", "]", ",", "\n", ".", "-", "e", "1", " ", "#", "\u{b0}", "nan"];
    let mut refused = 0;
    for _ in 0..count {
        let mut text: Vec<char> = good.chars().collect();
        for _ in 0..rng.random_range(1..4) {
            let at = rng.random_range(0..text.len());
            match rng.random_range(0..5) {
                0 => drop(text.remove(at)),
                1 => text.insert(at, text[at]),
                2 => {
                    let other = rng.random_range(0..text.len());
                    text.swap(at, other);
                }
                3 => {
                    let word = inserted[rng.random_range(0..inserted.len())];
                    text.splice(at..at, word.chars());
                }
                _ if text.len() > 20 && rng.random_range(0..10) == 0 => text.truncate(at.max(1)),
                _ => {}
            }
        }
        let text: String = text.into_iter().collect();
        if let Err(error) = read("arm.toml", &text) {
            let error = error.to_string();
            assert!(error.starts_with("arm.toml"), "{error}");
            assert!(!error.contains(['\n', '\r']) && error.len() < 600, "{error}");
            assert!(error.contains("must be") || error.contains("moves["), "{error}: {text}");
            refused += 1;
        }
    }
    refused
}

#[test]
fn tables_say_where_too() {
    let folder = tempfile::tempdir().expect("folder");
    let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("file");
    let refuse = |args: &[&str]| {
        let output = sim().current_dir(folder.path()).args(args).output().expect("program");
        let text = String::from_utf8(output.stderr).expect("text");
        assert_eq!((output.status.code(), text.lines().count()), (Some(2), 1), "{text}");
        text
    };
    let header = "t_s,hub_angle_rad,hub_rate_rad_s,hub_accel_rad_s2,tip_x_m,tip_y_m,deflection_m,\
                  torque_nm\n";
    let row = "0.0,0,0,0,0.4,0,0,0\n";
    put("good.csv", &format!("{header}{row}"));
    for (rows, words) in [
        ("0.01,0,fast,0,0.4,0,0,0\n", "bad.csv: line 3: hub_rate_rad_s: "),
        ("0.01,0,0,0,0.4,0,0\n", "bad.csv: line 3: 7 columns; must be 8"),
        ("0.0,0,0,0,0.4,0,0,0\n", "bad.csv: line 3: t_s = 0: must be later"),
    ] {
        put("bad.csv", &format!("{header}{row}{rows}"));
        let text = refuse(&["compare", "good.csv", "bad.csv", "--scene", "d-fast"]);
        assert!(text.contains(words), "{words} is not in: {text}");
    }
}
