//! Traces of a command that found no room or no way to write.

use std::process::Command;

use crate::untouched::{Bench, OUT, Writer};

const SIM: &str = env!("CARGO_BIN_EXE_stillbeam-sim");

/// Every command that writes. The study comes first.
const WRITERS: [Writer; 4] = [
    Writer { words: &["study", "--out", OUT], is_folder: true },
    Writer { words: &["run", "d-fast", "--csv", OUT], is_folder: false },
    Writer {
        words: &["plan", "d-fast", "--to", "1.5", "--duration", "0.5", "--out", OUT],
        is_folder: true,
    },
    Writer { words: &["reference", "d-fast", "--solver", "rod", "--csv", OUT], is_folder: false },
];

#[test]
fn without_room_there_is_one_line_and_no_half_file() {
    // The study takes a minute to come to its writing, and writes its folder as `plan` does.
    Bench::new(SIM).without_room(&WRITERS[1..]);
}

#[test]
fn a_path_that_cannot_be_written_is_one_line_and_changes_nothing() {
    Bench::new(SIM).without_a_way(&WRITERS);
}

/// A device that is always full, as the output and as standard output.
#[test]
#[cfg(target_os = "linux")]
fn a_full_device_is_one_line() {
    let bench = Bench::new(SIM);
    for Writer { words, is_folder } in &WRITERS {
        if !is_folder {
            let line = bench.refuse("", words, "/dev/full");
            assert!(line.contains("/dev/full"), "{line}");
        }
    }
    for words in [&["scenes"][..], &["run", "d-fast", "--csv", "/dev/null"], &["--help"]] {
        let line = bench.refuse("exec >/dev/full", words, "");
        assert!(line.contains("standard output"), "{line}");
    }
    // Nowhere to say it: still an exit code and no panic.
    let output = bench.run("exec 2>/dev/full", &["run", "nowhere", "--csv", "no.csv"]);
    assert_eq!(output.status.code(), Some(2));
}

/// A reader that has read enough is no error.
#[test]
fn a_pipe_may_be_closed() {
    let bench = Bench::new(SIM);
    let script = format!("{SIM:?} scenes | :; {SIM:?} run d-fast --csv /dev/stdout | head -1");
    let mut command = Command::new("sh");
    let output = command.args(["-c", &script]).current_dir(&bench.folder).output().unwrap();
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert!(String::from_utf8(output.stdout).unwrap().starts_with("t_s,"));
}
