//! Joints, sections, masses, measurements, axes and carriers that a scene says wrongly are refused
//! in one line that names the key, its value and what it must be.

use std::fs;

use stillbeam_sim::scene_file::SceneFile;

use crate::sim;

const LINK: &str = "[link]\nlength = 0.5\nmass = 0.1\nbending_stiffness = 2.0\n";
const UNKNOWN: &str = "[link]\nlength = 0.5\nmass = 0.1\n";

/// The keys of a file of its own kind, before the link's table.
fn refusal(head: &str, link: &str) -> String {
    let text = format!("{head}\n{link}");
    SceneFile::parse_arm("arm.toml", &text).expect_err(&text).to_string()
}

fn said(error: &str, words: &[&str]) {
    for word in words {
        assert!(error.contains(word), "{word} is not in: {error}");
    }
    assert!(error.contains("must ") && !error.contains('\n'), "{error}");
}

/// Values that no number may have, each with what an error calls it.
const NO_NUMBERS: [(&str, &str); 6] = [
    ("nan", "NaN"),
    ("-inf", "-inf"),
    ("\"x\"", "\"x\""),
    ("true", "true"),
    ("{}", "{}"),
    ("1e400", "1e400"),
];

#[test]
fn a_number_is_a_number_in_every_feature() {
    for (key, beside) in [
        ("hub.stiffness", ""),
        ("hub.mass", "axis = \"linear\""),
        ("payload.offset", ""),
        ("damping.joint", "hub.stiffness = 10.0"),
        ("damping.joint_ratio", "hub.stiffness = 10.0"),
        ("damping.ratio", "damping.from = \"beta\""),
        ("gravity.tilt", "gravity.acceleration = 9.81"),
        ("gravity.direction", "gravity.acceleration = 9.81"),
        ("carrier.rate", ""),
    ] {
        for (value, name) in NO_NUMBERS {
            let error = refusal(&format!("{beside}\n{key} = {value}"), LINK);
            said(&error, &[&format!("{key} = {name}: must be")]);
        }
        if !matches!(key, "gravity.direction" | "carrier.rate") {
            said(&refusal(&format!("{beside}\n{key} = -1.0"), LINK), &[&format!("{key} = -1: ")]);
        }
    }
    for (value, name) in NO_NUMBERS {
        let error = refusal("", &format!("{UNKNOWN}frequency = {value}\n"));
        said(&error, &[&format!("link.frequency = {name}: must be")]);
        let error = refusal("", &format!("{LINK}[[link.masses]]\nat = {value}\nmass = 0.1\n"));
        said(&error, &[&format!("link.masses[0].at = {name}: must be")]);
    }
}

/// serde would take a list for a table, its numbers in the order of the keys.
#[test]
fn a_list_is_no_table() {
    for table in ["hub", "payload", "damping", "gravity", "carrier", "limits", "shaper", "solver"] {
        for list in ["[]", "[1.0]", "[9.81, 0.0, 0.0, 1.0]"] {
            let error = refusal(&format!("{table} = {list}"), LINK);
            said(
                &error,
                &[&format!("arm.toml:1:{}: {table} = {list}: must be a table", table.len() + 4)],
            );
        }
    }
    let error = refusal("", &format!("{LINK}masses = [[0.1, 0.01]]"));
    said(&error, &["link.masses[0] = [0.1, 0.01]: must be a table"]);
    let error = refusal("", &format!("{UNKNOWN}sections = [[0.5, 0.02, 0.002]]"));
    said(&error, &["link.sections[0] = [0.5, 0.02, 0.002]: must be a table"]);
}

/// A key that takes a name lists the names, whatever it is given.
#[test]
fn a_name_is_one_of_its_names() {
    for value in ["5", "{}", "[]", "true", "nan"] {
        let error = refusal(&format!("damping = {{ ratio = 0.01, from = {value} }}"), LINK);
        said(&error, &[&format!("damping.from = {value}: must be"), "alpha, beta, joint"]);
        let error = refusal(&format!("solver.method = {value}"), LINK);
        said(&error, &[&format!("solver.method = {value}: must be"), "newmark, modal, elastica"]);
    }
}

#[test]
fn keys_that_contradict_each_other_are_refused() {
    let carrier = |damping: &str| format!("carrier.rate = 8.0\ndamping = {{ {damping} }}");
    for (head, link, words) in [
        ("", format!("{LINK}frequency = 5.0"), ["link.bending_stiffness", "link.frequency = 5"]),
        (
            "",
            format!("{UNKNOWN}frequency = [6.0, 1.0]"),
            ["link.frequency = [6.0, 1.0]", "ascending"],
        ),
        ("hub.stiffness = \"deduced\"", LINK.to_owned(), ["hub.stiffness", "link.frequency"]),
        ("damping.joint = 0.1", LINK.to_owned(), ["damping.joint = 0.1", "hub.stiffness"]),
        ("damping.ratio = 0.01", LINK.to_owned(), ["damping.ratio = 0.01", "damping.from"]),
        ("gravity.tilt = 0.2", LINK.to_owned(), ["gravity.tilt = 0.2", "gravity.acceleration"]),
        ("axis = \"linear\"\ncarrier.rate = 1.0", LINK.to_owned(), ["carrier.rate = 1", "linear"]),
        (
            &carrier("ratio = 0.01, from = \"alpha\""),
            LINK.to_owned(),
            ["damping.ratio = 0.01", "damping.from = \"beta\""],
        ),
        (&carrier("alpha = 0.1"), LINK.to_owned(), ["damping.alpha = 0.1", "carrier"]),
        (
            "",
            format!("{LINK}{}", "[[link.masses]]\nat = 0.3\nmass = 0.01\n".repeat(40)),
            ["link.masses = 40", "0 to 4"],
        ),
    ] {
        said(&refusal(head, &link), &words);
    }
}

/// The program itself: one line, exit code 2, nothing else.
#[test]
fn arm_refuses_in_one_line() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("scene.toml"), format!("carrier = [1.0]\n{LINK}")).expect("scene");
    let run = sim().current_dir(folder.path()).args(["arm", "scene.toml", "--json"]).output();
    let run = run.expect("the program");
    let text = String::from_utf8(run.stderr).expect("text");
    assert_eq!((run.status.code(), run.stdout.len()), (Some(2), 0), "{text}");
    assert_eq!(
        text,
        "error: scene.toml:1:11: carrier = [1.0]: must be a table of keys and values\n"
    );
}
