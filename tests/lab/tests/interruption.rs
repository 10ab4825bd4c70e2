//! What is left of a command that was killed, or that found no room or no way to write.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use stillbeam_lab::sweep::row::{Row, Rows};
use tempfile::TempDir;

const LAB: &str = env!("CARGO_BIN_EXE_stillbeam-lab");

/// The commands of the lab; the others are the simulation's.
const OF_THE_LAB: [&str; 6] = ["sweep", "merge", "pareto", "tables", "faults", "stress"];

/// The program that has a command. The simulation's stands beside the lab's.
fn program(command: &str) -> PathBuf {
    let lab = PathBuf::from(LAB);
    if OF_THE_LAB.contains(&command) { lab } else { lab.with_file_name("stillbeam-sim") }
}

/// Every case some milliseconds.
const SPEC: &str = "scenes = [\"d-fast\"]\n[[grid]]\nmethod = [\"newmark\", \"modal\"]\n\
                    elements = [4, 8]\nmass = [\"consistent\", \"lumped\"]\n\
                    tick = [0.001, 0.0008, 0.0005, 0.0004, 0.00025]\n";
const CASES: usize = 40;

fn complete_rows(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap_or_default();
    let whole = text.rfind('\n').map_or("", |end| &text[..end]);
    whole.lines().skip(1).map(str::to_owned).collect()
}

fn without_cost(path: &Path) -> Vec<Row> {
    let rows = Rows::open(path).unwrap().map(Result::unwrap);
    rows.map(|row| Row { cost: None, ..row }).collect()
}

#[test]
fn a_killed_sweep_loses_no_finished_row() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("spec.toml"), SPEC).unwrap();
    let sweep = |csv: &str| {
        let mut command = Command::new(LAB);
        command.args(["sweep", "spec.toml", "--csv", csv, "--resume"]).current_dir(&folder);
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        command
    };
    let files = [path("out.csv.errors.part"), path("out.csv.part")];
    let rows = || files.each_ref().map(|file| complete_rows(file));
    let [mut errors, mut timed] = [const { Vec::<String>::new() }; 2];
    // Killed again and again, each time as soon as there is a new row or two in either file: the first
    // kills fall into the errors, the later ones into the times.
    let mut kills = [0; 2];
    let mut whole = false;
    for more in (1..=3).cycle() {
        let mut child = sweep("out.csv").spawn().unwrap();
        let begun = Instant::now();
        let status = loop {
            let [e, t] = rows();
            if e.len() >= errors.len() + 4 * more || t.len() >= timed.len() + 4 * more {
                // SIGKILL: no handler, no destructor, no flush.
                child.kill().unwrap();
                break child.wait().unwrap();
            }
            if let Some(status) = child.try_wait().unwrap() {
                break status;
            }
            assert!(begun.elapsed() < Duration::from_secs(120), "hangs");
            std::thread::sleep(Duration::from_micros(200));
        };
        whole = status.success();
        // A kill on a busy machine may fall behind the last row.
        if whole || path("out.csv").exists() {
            break;
        }
        assert_eq!(status.code(), None, "ended by itself");
        let [e, t] = rows();
        assert!(errors.iter().all(|row| e.contains(row)), "a row of errors is lost");
        assert!(t.starts_with(&timed), "a row with its cost is lost");
        assert!(e.len() > errors.len() || t.len() > timed.len(), "no progress");
        kills[usize::from(!t.is_empty())] += 1;
        (errors, timed) = (e, t);
    }
    assert!(kills[0] >= 2 && kills[1] >= 2, "kills among errors, among times: {kills:?}");
    let finished = complete_rows(&path("out.csv"));
    assert!(finished.starts_with(&timed));
    assert!(sweep("again.csv").status().unwrap().success());
    let [out, again] = ["out.csv", "again.csv"].map(|name| without_cost(&path(name)));
    assert_eq!(out.len(), CASES);
    assert_eq!(out, again);
    assert!(!whole || files.iter().all(|file| !file.exists()));
}

/// Everything in a folder and what it holds.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().flatten() {
        if entry.file_type().unwrap().is_dir() {
            found.insert(entry.path(), Vec::new());
            found.extend(contents(&entry.path()));
        } else {
            found.insert(entry.path(), fs::read(entry.path()).unwrap());
        }
    }
    found
}

/// What stands in the place of a path that is written to.
const OUT: &str = "OUT";

/// Every command that writes, the output in the place of `OUT`; what it fills is there already.
const COMMANDS: [&[&str]; 10] = [
    &["study", "--out", OUT],
    &["run", "d-fast", "--csv", OUT],
    &["plan", "d-fast", "--to", "1.5", "--duration", "0.5", "--out", OUT],
    &["reference", "d-fast", "--solver", "rod", "--csv", OUT],
    &["sweep", "spec.toml", "--csv", OUT],
    &["merge", OUT, "sweep.csv"],
    &["pareto", "sweep.csv", "--out", OUT],
    &["tables", OUT],
    &["faults", OUT, "--count", "1"],
    &["stress", "--scenes", "20", "--part", OUT],
];

/// What `tables` and `faults` fill.
const TEXT: &str = "<!-- stability:faults -->\n<!-- /stability -->\n\
                    <!-- table:accuracy -->\n| solver | d-fast |\n<!-- /table -->\n";

fn is_folder(command: &[&str]) -> bool {
    matches!(command[0], "study" | "plan" | "pareto")
}

fn is_filled(command: &[&str]) -> bool {
    matches!(command[0], "tables" | "faults")
}

/// A folder with all that the commands read.
fn bench() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let spec = "scenes = [\"d-fast\"]\n[[grid]]\nmethod = [\"newmark\"]\nelements = [1, 2]\nmass = [\"lumped\", \"consistent\"]\n\
                tick = [0.01, 0.005, 0.004, 0.0025]\n";
    fs::write(folder.path().join("spec.toml"), spec).unwrap();
    fs::write(folder.path().join("text.md"), TEXT).unwrap();
    let swept = in_folder(&folder, "", &["sweep", "spec.toml", "--csv", "sweep.csv"]);
    assert!(swept.status.success());
    folder
}

/// Runs the program behind a line of shell.
fn in_folder(folder: &TempDir, before: &str, arguments: &[&str]) -> Output {
    let script = format!("{before}\nexec \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, "sh"]).arg(program(arguments[0])).args(arguments);
    command.current_dir(folder);
    command.output().unwrap()
}

fn refused(folder: &TempDir, before: &str, command: &[&str], out: &str) -> String {
    let arguments: Vec<&str> =
        command.iter().map(|&word| if word == OUT { out } else { word }).collect();
    let there = contents(folder.path());
    let output = in_folder(folder, before, &arguments);
    let line = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {line}");
    assert_eq!(line.lines().count(), 1, "{arguments:?}: {line}");
    assert!(line.starts_with("error: ") && line.contains("must be"), "{arguments:?}: {line}");
    let left = contents(folder.path());
    let names = |all: &BTreeMap<PathBuf, Vec<u8>>| all.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&left), names(&there), "{arguments:?}");
    assert_eq!(left, there, "{arguments:?}");
    line
}

/// 512 bytes a file: the file system takes no more in the middle of every output.
#[test]
fn without_room_there_is_one_line_and_no_half_file() {
    let folder = bench();
    let full = "trap '' XFSZ; ulimit -f 1";
    for command in COMMANDS {
        match command[0] {
            // What it has is kept for `--resume`: `without_room_a_sweep_keeps_whole_rows`.
            "sweep" => continue,
            _ if is_filled(command) => {
                let long = format!("{}\n{TEXT}", "word ".repeat(200));
                fs::write(folder.path().join("text.md"), long).unwrap();
                refused(&folder, full, command, "text.md");
            }
            _ => {
                refused(&folder, full, command, "new/out");
                // One that is there already stays as it was.
                if !is_folder(command) && command[0] != "stress" {
                    fs::write(folder.path().join("old"), "old").unwrap();
                    refused(&folder, full, command, "old");
                }
            }
        }
    }
}

#[test]
fn without_room_a_sweep_keeps_whole_rows() {
    let folder = bench();
    let sweep = ["sweep", "spec.toml", "--csv", "out.csv", "--resume"];
    let mut sizes = Vec::new();
    // So many times 512 bytes, or 1024 in some shells, of which the header takes some 250.
    for blocks in 1..=2 {
        let output = in_folder(&folder, &format!("trap '' XFSZ; ulimit -f {blocks}"), &sweep);
        let line = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), line.lines().count()), (Some(2), 1), "{line}");
        assert!(line.contains("out.csv") && line.contains("must be"), "{line}");
        let text = fs::read_to_string(folder.path().join("out.csv.errors.part")).unwrap();
        assert!(text.ends_with('\n'), "{text}");
        sizes.push(text.lines().count());
    }
    assert!(sizes[0] > 1 && sizes[1] > sizes[0], "{sizes:?}");
    assert!(in_folder(&folder, "", &sweep).status.success());
    let [out, whole] = ["out.csv", "sweep.csv"].map(|csv| without_cost(&folder.path().join(csv)));
    assert_eq!(out, whole);
}

/// Below a file there is no folder.
#[test]
fn a_path_that_cannot_be_written_is_one_line_and_changes_nothing() {
    let folder = bench();
    for command in COMMANDS {
        if is_filled(command) {
            // It is read first; there it ends.
            refused(&folder, "", command, "spec.toml/text.md");
        } else {
            refused(&folder, "", command, "spec.toml/out");
        }
    }
    // A folder in the place of a file.
    fs::create_dir(folder.path().join("folder")).unwrap();
    for command in COMMANDS {
        if !is_folder(command) {
            refused(&folder, "", command, "folder");
        }
    }
}

/// A device that is always full, as the output and as standard output.
#[test]
#[cfg(target_os = "linux")]
fn a_full_device_is_one_line() {
    let folder = bench();
    for command in COMMANDS {
        if matches!(command[0], "run" | "reference" | "merge") {
            let line = refused(&folder, "", command, "/dev/full");
            assert!(line.contains("/dev/full"), "{line}");
        }
    }
    for command in [&["scenes"][..], &["run", "d-fast", "--csv", "/dev/null"], &["--help"]] {
        let line = refused(&folder, "exec >/dev/full", command, "");
        assert!(line.contains("standard output"), "{line}");
    }
    // Nowhere to say it: still an exit code and no panic.
    let output = in_folder(&folder, "exec 2>/dev/full", &["run", "nowhere", "--csv", "no.csv"]);
    assert_eq!(output.status.code(), Some(2));
}

/// A reader that has read enough is no error.
#[test]
fn a_pipe_may_be_closed() {
    let folder = bench();
    let program = program("run");
    let script =
        format!("{program:?} scenes | :; {program:?} run d-fast --csv /dev/stdout | head -1");
    let output = Command::new("sh").args(["-c", &script]).current_dir(&folder).output().unwrap();
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert!(String::from_utf8(output.stdout).unwrap().starts_with("t_s,"));
}
