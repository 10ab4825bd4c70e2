//! Traces of a command that was killed, or that found no room or no way to write.

#[path = "../../cli/untouched.rs"]
mod untouched;

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use untouched::{Bench, FULL, OUT, Writer};

const LAB: &str = env!("CARGO_BIN_EXE_stillbeam-lab");

/// The commands that write files of their own.
const WRITERS: [Writer; 2] = [
    Writer { words: &["sweep", "spec.toml", "--csv", OUT], is_folder: false },
    Writer { words: &["pareto", "sweep.csv", "--out", OUT], is_folder: true },
];

/// The commands that fill a page, which they read first.
const FILLERS: [&[&str]; 3] = [
    &["faults", OUT, "--count", "1"],
    &["still", OUT, "--count", "1"],
    &["docs", "README.md", "--root", OUT],
];

/// Keeps what is done in a file, and goes on from it.
const STRESS: [&str; 5] = ["stress", "--count", "20", "--part", OUT];

/// Pages of two blocks or one, longer than what is full takes.
fn page(blocks: &[&str]) -> String {
    let block = |name: &&str| format!("<!-- lab:{name} -->\nold\n<!-- /lab -->\n");
    "word ".repeat(200) + "\n" + &blocks.iter().map(block).collect::<String>()
}

/// Sixteen cases of some milliseconds.
const SPEC: &str = "scenes = [\"d-fast\"]\n[[grid]]\nmethod = [\"newmark\"]\nelements = [1, 2]\n\
                    mass = [\"lumped\", \"consistent\"]\ntick = [0.01, 0.005, 0.004, 0.0025]\n";

/// A folder with all that the commands read.
fn bench() -> Bench {
    let bench = Bench::new(LAB);
    bench.put("spec.toml", SPEC);
    let swept = bench.run("", &["sweep", "spec.toml", "--csv", "sweep.csv"]);
    assert!(swept.status.success());
    bench
}

#[test]
fn without_room_there_is_one_line_and_no_half_file() {
    let bench = bench();
    bench.without_room(&WRITERS);
    bench.refuse(FULL, &STRESS, "new/out");
    bench.put("page.md", &page(&["faults", "campaign-rests", "campaign-interruptions"]));
    bench.put("README.md", &page(&["accuracy"]));
    for words in FILLERS {
        bench.refuse(FULL, words, if words[0] == "docs" { "." } else { "page.md" });
    }
}

#[test]
fn a_path_that_cannot_be_written_is_one_line_and_changes_nothing() {
    let bench = bench();
    bench.without_a_way(&WRITERS);
    for words in FILLERS.into_iter().chain([&STRESS[..]]) {
        bench.refuse("", words, "notes.txt/page.md");
        bench.refuse("", words, "folder");
    }
    // A page without a place for what it is to be filled with.
    for words in FILLERS {
        bench.refuse("", words, if words[0] == "docs" { "." } else { "spec.toml" });
    }
}

/// SIGKILL: no handler, no destructor, no flush. Under its name a file is there whole or not at
/// all.
#[test]
fn a_killed_sweep_leaves_no_half_table() {
    let bench = bench();
    let out = bench.folder.path().join("out.csv");
    let mut child = Command::new(LAB)
        .args(["sweep", "spec.toml", "--csv", "out.csv"])
        .current_dir(&bench.folder)
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    // The file grows beside its place as soon as the cases begin to run.
    let begun = Instant::now();
    let growing = || {
        let files = std::fs::read_dir(&bench.folder).unwrap().flatten();
        files.filter(|file| file.file_name().to_string_lossy().starts_with(".out.csv.")).count()
    };
    while growing() == 0 {
        assert!(!out.exists() && begun.elapsed() < Duration::from_secs(600), "never begins");
        std::thread::sleep(Duration::from_micros(200));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!out.exists());
    // What the killed one has left is in nobody's way.
    assert!(bench.run("", &["sweep", "spec.toml", "--csv", "out.csv"]).status.success());
    assert_eq!(std::fs::read_to_string(&out).unwrap().lines().count(), 17);
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_device_is_one_line() {
    let bench = bench();
    let line = bench.refuse("", &["sweep", "spec.toml", "--csv", OUT], "/dev/full");
    assert!(line.contains("/dev/full"), "{line}");
    let line = bench.refuse("exec >/dev/full", &["--help"], "");
    assert!(line.contains("standard output"), "{line}");
}
