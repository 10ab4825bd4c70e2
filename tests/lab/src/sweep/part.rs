//! Rows on their way to a file: appended chunk by chunk beside it, and given its name once all are
//! there.

use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::plan::Plan;
use super::row::{Row, Rows, header};
use stillbeam_sim::error::Error;
use stillbeam_sim::output;

/// A file that holds rows of some cases. It grows row by row, so that no finished row is lost
/// whatever ends the program.
pub struct Part {
    path: PathBuf,
    file: File,
    /// Bytes of whole lines.
    length: u64,
    /// The cases it holds, as indices of the plan, in the order of the file.
    has: Vec<usize>,
}

impl Part {
    /// Path of the part of `out` with that suffix.
    pub fn path_of(out: &Path, suffix: &str) -> PathBuf {
        let mut name = out.file_name().unwrap_or_default().to_owned();
        name.push(suffix);
        out.with_file_name(name)
    }

    /// Opens a part of the rows of `cases`, rising, each at most once, in any order. Without `resume`
    /// there must be none yet.
    pub fn open(path: &Path, plan: &Plan, cases: &[usize], resume: bool) -> Result<Self, Error> {
        let refuse = |cause: std::io::Error| unwritten(path, cause);
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
                    "left by an interrupted sweep; use --resume, or remove it",
                ));
            }
            whole_lines = 0;
        }
        // An interruption may have cut the last line.
        file.set_len(whole_lines).map_err(refuse)?;
        let mut has = Vec::new();
        if whole_lines > 0 {
            for row in Rows::open(path)? {
                let index = plan.index_of(&row?).map_err(|e| e.within(path.display()))?;
                if cases.binary_search(&index).is_err() {
                    return Err(strange(path, index));
                }
                has.push(index);
            }
            let mut sorted = has.clone();
            sorted.sort_unstable();
            if let Some(twice) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
                return Err(strange(path, twice[0]));
            }
        }
        file.seek(SeekFrom::End(0)).map_err(refuse)?;
        let mut part = Self { path: path.to_owned(), file, length: whole_lines, has };
        if whole_lines == 0 {
            part.line(|csv| csv.write_record(header()))?;
        }
        Ok(part)
    }

    /// The cases it holds, in the order in which they were finished.
    pub fn has(&self) -> &[usize] {
        &self.has
    }

    /// Appends the row of a case of the plan; it survives whatever comes after.
    pub fn append(&mut self, index: usize, row: &Row) -> Result<(), Error> {
        self.line(|csv| row.write(csv))?;
        self.has.push(index);
        Ok(())
    }

    /// Appends a line, whole or not at all: what a full disk took of it is cut off again.
    fn line(
        &mut self,
        write: impl FnOnce(&mut csv::Writer<Vec<u8>>) -> csv::Result<()>,
    ) -> Result<(), Error> {
        let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
        let line = write(&mut csv)
            .map_err(std::io::Error::from)
            .and_then(|()| csv.into_inner().map_err(|error| error.into_error()))
            .map_err(|error| unwritten(&self.path, error))?;
        if let Err(error) = self.file.write_all(&line) {
            // Whoever reads it would cut it off as well.
            let _ = self.file.set_len(self.length);
            let _ = self.file.seek(SeekFrom::Start(self.length));
            return Err(unwritten(&self.path, error));
        }
        self.length += line.len() as u64;
        Ok(())
    }

    /// Puts the rows in the order of their cases, for one who reads them so. One line is in memory
    /// at a time, and where each begins.
    pub fn sort(self, plan: &Plan) -> Result<Self, Error> {
        let Self { path, file, has, .. } = self;
        drop(file);
        if has.is_sorted() {
            return Self::open(&path, plan, &has, true);
        }
        let mut order: Vec<usize> = (0..has.len()).collect();
        order.sort_unstable_by_key(|&place| has[place]);
        let starts = starts(&path).map_err(|error| unwritten(&path, error))?;
        let mut file = File::open(&path).map_err(|error| unwritten(&path, error))?;
        output::write_whole(&path, |sorted| {
            let header = starts.first().copied().unwrap_or(0);
            copy(&mut file, 0..header, sorted)?;
            order
                .iter()
                .try_for_each(|&place| copy(&mut file, starts[place]..starts[place + 1], sorted))
        })?;
        let mut cases = has;
        cases.sort_unstable();
        Self::open(&path, plan, &cases, true)
    }

    /// Gives the file its final name.
    pub fn finish(self, out: &Path) -> Result<(), Error> {
        self.file.sync_data().map_err(|error| unwritten(&self.path, error))?;
        drop(self.file);
        std::fs::rename(&self.path, out).map_err(|error| unwritten(out, error))
    }
}

fn strange(path: &Path, index: usize) -> Error {
    Error::file(
        path,
        format_args!("case {}: each case of this shard must be there once", index + 1),
    )
}

/// What there is of the sweep stays where it is.
fn unwritten(path: &Path, error: std::io::Error) -> Error {
    output::refusal(path, &error)
}

/// Where each line after the header begins, and where the last one ends.
fn starts(path: &Path) -> std::io::Result<Vec<u64>> {
    let mut file = BufReader::new(File::open(path)?);
    let (mut starts, mut at, mut line) = (Vec::new(), 0, Vec::new());
    loop {
        line.clear();
        match file.read_until(b'\n', &mut line)? {
            0 => return Ok(starts),
            length => at += length as u64,
        }
        starts.push(at);
    }
}

fn copy(from: &mut File, range: Range<u64>, to: &mut dyn Write) -> std::io::Result<()> {
    from.seek(SeekFrom::Start(range.start))?;
    std::io::copy(&mut from.take(range.end - range.start), to).map(drop)
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
