//! `export`: a scene's stepper as constants for Rust, for C, and as bytes.

use std::fs;
use std::path::Path;

use stillbeam::Stepper;
use stillbeam::planner::Planner;
use stillbeam::prepared::Prepared;
use stillbeam::stepper::{Elastica, Modal};

use crate::sim;

/// Runs `export` in a folder; returns exit code, output and errors.
fn export(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let output = sim().current_dir(folder).arg("export").args(args).output().expect("program");
    (
        output.status.code().expect("an exit code"),
        String::from_utf8(output.stdout).expect("text"),
        String::from_utf8(output.stderr).expect("text"),
    )
}

/// Every word that is written in hexadecimal, in order.
fn words(text: &str) -> Vec<u32> {
    let numbers = text.split("0x").skip(1).map(|rest| &rest[..8]);
    numbers.map(|digits| u32::from_str_radix(digits, 16).expect("eight digits")).collect()
}

#[test]
fn every_format_holds_the_words_that_a_program_loads() {
    let folder = tempfile::tempdir().expect("folder");
    let args = ["d-fast", "--method", "elastica", "--modes", "2", "--quality", "fast"];
    let files = ["--rust", "arm.rs", "--c", "arm.h", "--bin", "arm.bin"];
    let (code, out, err) = export(folder.path(), &[&args[..], &files[..]].concat());
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(out.contains("Elastica<f32, 2>"), "{out}");
    let read = |name: &str| fs::read(folder.path().join(name)).expect(name);
    let text = |name: &str| String::from_utf8(read(name)).expect("text");
    let bytes = read("arm.bin");
    let chunks = bytes.chunks_exact(4).map(|word| u32::from_le_bytes(word.try_into().expect("4")));
    let all: Vec<u32> = chunks.collect();
    assert_eq!(words(&text("arm.rs")), all);
    assert_eq!(words(&text("arm.h")), all);
    assert!(text("arm.rs").contains(&format!("pub static ARM: [u32; {}] = [", all.len())));
    assert!(text("arm.h").contains(&format!("#define STILLBEAM_ARM_WORDS {}\n", all.len())));
    let stepper = Elastica::<f32, 2>::load_bytes(&bytes, 0.01).expect("a prepared arm");
    assert_eq!(stepper.tick(), 0.01);
    assert!(Modal::<f32, 2>::load(&all, 0.01).is_err(), "it is of another method");
}

/// The planner stands behind the stepper, and is loaded from where it stands.
#[test]
fn a_planner_is_written_where_it_is_asked_for() {
    let folder = tempfile::tempdir().expect("folder");
    let args = ["d-fast", "--method", "modal", "--rust", "arm.rs", "--c", "arm.h", "--bin", "arm"];
    let (code, out, err) = export(folder.path(), &[&args[..], &["--still"]].concat());
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    let read = |name: &str| fs::read(folder.path().join(name)).expect(name);
    let text = |name: &str| String::from_utf8(read(name)).expect("text");
    let all = words(&text("arm.rs"));
    assert_eq!(words(&text("arm.h")), all);
    let rows = text("arm.rs");
    let length = rows.split("PLANNER: [u32; ").nth(1).and_then(|rest| rest.split(']').next());
    let length: usize = length.and_then(|n| n.parse().ok()).expect("its length");
    let (arm, planner) = all.split_at(all.len() - length);
    Modal::<f32, 2>::load(arm, 0.01).expect("a prepared stepper");
    Planner::<f32, 2>::load(planner, 0.01).expect("a prepared planner");
    let behind = &read("arm")[4 * arm.len()..];
    Planner::<f32, 2>::load_bytes(behind, 0.01).expect("the same in bytes");
}

/// A build script gets the constants that the command writes.
#[test]
fn a_build_script_writes_what_the_command_writes() {
    let folder = tempfile::tempdir().expect("folder");
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/b-tip30.toml");
    let (code, out, err) = export(folder.path(), &[scene, "--still", "--rust", "command.rs"]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    let script = folder.path().join("script.rs");
    stillbeam_sim::export::write_rust(scene, &script, true).expect("a prepared arm");
    let command = fs::read_to_string(folder.path().join("command.rs")).expect("command.rs");
    assert_eq!(fs::read_to_string(script).expect("script.rs"), command);
    let error = stillbeam_sim::export::write_rust("none.toml", &folder.path().join("x"), false);
    assert!(error.is_err_and(|error| error.to_string().contains("none.toml")));
}

/// The constants of the examples in C are those of their scene file.
#[test]
fn the_arm_of_the_examples_in_c_is_up_to_date() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../bindings/c/examples");
    let folder = tempfile::tempdir().expect("folder");
    fs::copy(examples.join("arm.toml"), folder.path().join("arm.toml")).expect("arm.toml");
    let (code, out, err) = export(folder.path(), &["arm.toml", "--c", "arm.h"]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    let written = fs::read_to_string(folder.path().join("arm.h")).expect("arm.h");
    assert_eq!(written, fs::read_to_string(examples.join("arm.h")).expect("arm.h"));
}

/// The choice of `auto` is written as the stepper that it is.
#[test]
fn an_automatic_choice_is_loaded_by_its_own_type() {
    let folder = tempfile::tempdir().expect("folder");
    let (code, out, err) =
        export(folder.path(), &["b-tip30", "--method", "auto", "--rust", "a.rs"]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    let text = fs::read_to_string(folder.path().join("a.rs")).expect("a.rs");
    let stepper = out.split([':', ',']).nth(1).expect("a type").trim();
    let family = stepper.split('<').next().expect("a family");
    assert!(["Rigid", "Modal", "Elastica"].contains(&family), "{out}");
    assert!(text.contains(&format!("`{family}::<f32")), "{text}");
}

#[test]
fn payloads_are_the_rows_of_a_table() {
    let folder = tempfile::tempdir().expect("folder");
    let one = ["b-tip30", "--method", "modal", "--bin", "one.bin", "--payload", "0.05"];
    let two = [
        "b-tip30",
        "--method",
        "modal",
        "--rust",
        "two.rs",
        "--bin",
        "two.bin",
        "--payload",
        "0",
        "--payload",
        "0.05",
    ];
    for args in [&one[..], &two[..]] {
        let (code, _, err) = export(folder.path(), args);
        assert_eq!((code, err.as_str()), (0, ""));
    }
    let read = |name: &str| fs::read(folder.path().join(name)).expect(name);
    let (one, two) = (read("one.bin"), read("two.bin"));
    assert_eq!(two.len(), 2 * one.len());
    assert_eq!(two[one.len()..], one, "the second row is that of 50 g");
    assert_ne!(two[..one.len()], one);
    let text = String::from_utf8(read("two.rs")).expect("text");
    assert!(text.contains("PAYLOADS: [f64; 2] = [0.0, 0.05];"), "{text}");
    assert!(text.contains(&format!("ARMS: [[u32; {}]; 2]", one.len() / 4)), "{text}");
}

#[test]
fn what_is_refused_writes_nothing() {
    let folder = tempfile::tempdir().expect("folder");
    let refused: [(&[&str], &str); 4] = [
        (&["b-tip30"], "--rust"),
        (&["b-tip30", "--bin", "arm", "--payload", "-1"], "payload.mass = -1: must be 0 to"),
        (&["b-tip30", "--bin", "arm", "--method", "modal", "--quality", "fine"], "solver.quality"),
        (&["no-such-scene", "--bin", "arm"], "no-such-scene"),
    ];
    for (args, words) in refused {
        let (code, out, err) = export(folder.path(), args);
        assert_eq!((code, out.as_str()), (2, ""), "{args:?}: {err}");
        assert!(err.contains(words) && err.lines().count() == 1, "{args:?}: {err}");
        assert_eq!(fs::read_dir(folder.path()).expect("folder").count(), 0, "{args:?}");
    }
}
