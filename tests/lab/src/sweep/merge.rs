//! Joins the shards of a sweep. One row of each file is in memory at a time.

use std::path::{Path, PathBuf};

use super::row::{CaseId, Rows, header};
use stillbeam_sim::error::Error;
use stillbeam_sim::output;

/// Writes the rows of all `shards` to `out` in the order of their cases and returns how many there
/// are. Refuses rows of different sweeps, a case that two shards have and one that none has.
pub fn merge(out: &Path, shards: &[PathBuf]) -> Result<u64, Error> {
    let mut heads = Vec::with_capacity(shards.len());
    for path in shards {
        heads.push(Head::open(path)?);
    }
    let mut next = 1;
    let mut fault = None;
    output::write_whole(out, |file| {
        let mut csv = csv::Writer::from_writer(file);
        csv.write_record(header())?;
        let first = heads.iter().find_map(|head| head.id.clone());
        let result = loop {
            let Some(least) = (0..heads.len())
                .filter(|&i| heads[i].id.is_some())
                .min_by_key(|&i| heads[i].id.as_ref().map(|id| id.case))
            else {
                break complete(first.as_ref(), next);
            };
            if let Err(error) = heads[least].check(first.as_ref(), next) {
                break Err(error);
            }
            csv.write_record(heads[least].rows.record())?;
            next += 1;
            if let Err(error) = heads[least].advance() {
                break Err(error);
            }
        };
        fault = result.err();
        // Anything but success keeps the file from being made.
        if fault.is_some() { Err(std::io::Error::other("refused")) } else { csv.flush() }
    })
    .map_err(|error| fault.take().unwrap_or(error))?;
    Ok(next - 1)
}

/// A file and the case of the row that it stands at.
struct Head {
    rows: Rows,
    id: Option<CaseId>,
}

impl Head {
    fn open(path: &Path) -> Result<Self, Error> {
        let mut head = Self { rows: Rows::open(path)?, id: None };
        head.advance()?;
        Ok(head)
    }

    fn advance(&mut self) -> Result<(), Error> {
        let before = self.id.take();
        self.id = self.rows.next().transpose()?.map(|row| row.id);
        match (&before, &self.id) {
            (Some(before), Some(now)) if now.case <= before.case => Err(Error::file(
                self.rows.path(),
                format_args!(
                    "case {} after case {}: cases must be in rising order",
                    now.case, before.case
                ),
            )),
            _ => Ok(()),
        }
    }

    /// Whether this row is the next of the sweep that `first` belongs to.
    fn check(&self, first: Option<&CaseId>, next: u64) -> Result<(), Error> {
        let (Some(id), Some(first)) = (&self.id, first) else { return Ok(()) };
        let path = self.rows.path();
        if (&id.sweep, id.cases) != (&first.sweep, first.cases) {
            return Err(Error::file(
                path,
                format_args!(
                    "sweep = {} of {} cases: all shards must be of one sweep, the first is of {} with {} cases",
                    id.sweep, id.cases, first.sweep, first.cases
                ),
            ));
        }
        if id.case < next {
            return Err(Error::file(
                path,
                format_args!(
                    "case {}: another shard has it too; each case must be in one shard only",
                    id.case
                ),
            ));
        }
        if id.case > next {
            return Err(missing(next, first.cases));
        }
        Ok(())
    }
}

fn missing(case: u64, cases: u64) -> Error {
    Error::new(format_args!(
        "case {case} of {cases} is in no shard; all shards of the sweep must be named"
    ))
}

/// Whether the cases before `next` are all.
fn complete(first: Option<&CaseId>, next: u64) -> Result<(), Error> {
    match first {
        None => Err(Error::new("no rows; the files must be shards of a sweep")),
        Some(first) if next <= first.cases => Err(missing(next, first.cases)),
        Some(_) => Ok(()),
    }
}
