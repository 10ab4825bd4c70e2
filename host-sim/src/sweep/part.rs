//! Rows on their way to a file: appended chunk by chunk beside it, and given its name once all are
//! there.

use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use super::plan::Plan;
use super::row::{Row, Rows, header};
use crate::error::Error;

/// A file that holds the first rows of a list of cases.
pub struct Part {
    path: PathBuf,
    csv: csv::Writer<File>,
    rows: usize,
}

impl Part {
    /// Path of the part of `out` with that suffix.
    pub fn path_of(out: &Path, suffix: &str) -> PathBuf {
        let mut name = out.file_name().unwrap_or_default().to_owned();
        name.push(suffix);
        out.with_file_name(name)
    }

    /// Opens a part of the rows of `cases`, which it must hold from the first on. Without `resume`
    /// there must be none yet.
    pub fn open(path: &Path, plan: &Plan, cases: &[usize], resume: bool) -> Result<Self, Error> {
        let refuse = |cause: std::io::Error| {
            Error::file(path, format_args!("{cause}; accepted is a path that can be written"))
        };
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(refuse)?;
        }
        let mut options = OpenOptions::new();
        let options = options.read(true).write(true).create(true).truncate(false);
        let mut file = options.open(path).map_err(refuse)?;
        let mut whole_lines = length_of_whole_lines(&mut file).map_err(refuse)?;
        if !resume {
            // A header alone is nothing lost.
            if whole_lines > header().join(",").len() as u64 + 1 {
                return Err(Error::file(
                    path,
                    "left by an interrupted sweep; accepted is --resume, or no such file",
                ));
            }
            whole_lines = 0;
        }
        // An interruption may have cut the last line.
        file.set_len(whole_lines).map_err(refuse)?;
        let mut rows = 0;
        if whole_lines > 0 {
            for row in Rows::open(path)? {
                let index = plan.index_of(&row?).map_err(|e| e.within(path.display()))?;
                if cases.get(rows) != Some(&index) {
                    return Err(Error::file(
                        path,
                        format_args!(
                            "case {}: accepted are the cases of this shard in order",
                            index + 1
                        ),
                    ));
                }
                rows += 1;
            }
        }
        file.seek(SeekFrom::End(0)).map_err(refuse)?;
        let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(file);
        if whole_lines == 0 {
            csv.write_record(header()).map_err(|error| Error::file(path, error))?;
        }
        Ok(Self { path: path.to_owned(), csv, rows })
    }

    /// How many rows it holds.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Appends rows; they survive whatever comes after.
    pub fn append(&mut self, rows: &[Row]) -> Result<(), Error> {
        for row in rows {
            row.write(&mut self.csv).map_err(|error| Error::file(&self.path, error))?;
        }
        self.csv.flush().map_err(|error| Error::file(&self.path, error))?;
        self.rows += rows.len();
        Ok(())
    }

    /// Gives the file its final name.
    pub fn finish(mut self, out: &Path) -> Result<(), Error> {
        self.csv.flush().map_err(|error| Error::file(&self.path, error))?;
        drop(self.csv);
        std::fs::rename(&self.path, out).map_err(|error| Error::file(out, error))
    }
}

/// Bytes up to and including the last line break.
fn length_of_whole_lines(file: &mut File) -> std::io::Result<u64> {
    const BLOCK: u64 = 4096;
    let mut end = file.seek(SeekFrom::End(0))?;
    while end > 0 {
        let begin = end.saturating_sub(BLOCK);
        file.seek(SeekFrom::Start(begin))?;
        let mut block = Vec::new();
        file.take(end - begin).read_to_end(&mut block)?;
        if let Some(at) = block.iter().rposition(|&byte| byte == b'\n') {
            return Ok(begin + at as u64 + 1);
        }
        end = begin;
    }
    Ok(0)
}
