//! Traces of a command that writes and finds no room, or no way to write: nothing, and one line.
//! Shared by the simulation's commands and the lab's.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

/// The word of a command line in whose place the output's path stands.
pub const OUT: &str = "OUT";

/// A line of shell behind which no file takes more than 512 bytes.
pub const FULL: &str = "trap '' XFSZ; ulimit -f 1";

/// A command that writes.
pub struct Writer {
    /// Its words, with [`OUT`] among them.
    pub words: &'static [&'static str],
    /// True if `OUT` is a folder.
    pub is_folder: bool,
}

/// A program and a folder in which it runs.
pub struct Bench {
    pub folder: TempDir,
    program: &'static str,
}

impl Bench {
    /// An empty folder but for `notes.txt`, below which there can be no folder.
    pub fn new(program: &'static str) -> Self {
        let bench = Self { folder: tempfile::tempdir().unwrap(), program };
        bench.put("notes.txt", "notes");
        bench
    }

    /// Writes a file in the folder.
    pub fn put(&self, name: &str, text: &str) {
        fs::write(self.folder.path().join(name), text).unwrap();
    }

    /// Runs the program behind a line of shell.
    pub fn run(&self, before: &str, arguments: &[&str]) -> Output {
        let script = format!("{before}\nexec \"$@\"");
        let mut command = Command::new("sh");
        command.args(["-c", &script, "sh", self.program]).args(arguments);
        command.current_dir(&self.folder).output().unwrap()
    }

    /// Runs what must be refused in one line with exit code 2, every file and folder as it was.
    /// Returns the line.
    pub fn refuse(&self, before: &str, words: &[&str], out: &str) -> String {
        let arguments: Vec<&str> =
            words.iter().map(|&word| if word == OUT { out } else { word }).collect();
        let there = contents(self.folder.path());
        let output = self.run(before, &arguments);
        let line = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {line}");
        assert_eq!(line.lines().count(), 1, "{arguments:?}: {line}");
        assert!(line.starts_with("error: ") && line.contains("must be"), "{arguments:?}: {line}");
        let left = contents(self.folder.path());
        let names = |all: &BTreeMap<PathBuf, Vec<u8>>| all.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(&left), names(&there), "{arguments:?}");
        assert_eq!(left, there, "{arguments:?}");
        line
    }

    /// Lets each command write where the file system takes no more in the middle of the output.
    pub fn without_room(&self, writers: &[Writer]) {
        for Writer { words, is_folder } in writers {
            self.refuse(FULL, words, "new/out");
            // A file that is there already stays as it was.
            if !is_folder {
                self.put("old", "old");
                self.refuse(FULL, words, "old");
            }
        }
    }

    /// Lets each command write below a file, where there is no folder, and onto a folder.
    pub fn without_a_way(&self, writers: &[Writer]) {
        fs::create_dir(self.folder.path().join("folder")).unwrap();
        for Writer { words, is_folder } in writers {
            self.refuse("", words, "notes.txt/out");
            if !is_folder {
                self.refuse("", words, "folder");
            }
        }
    }
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
