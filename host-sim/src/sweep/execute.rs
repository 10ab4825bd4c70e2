//! Runs a sweep: errors on all cores, then costs on one, into a file that survives interruptions.

use std::path::Path;

use rayon::prelude::*;

use super::part::Part;
use super::plan::{Plan, Shard};
use super::row::{Row, Rows};
use super::{cost, measure};
use crate::error::Error;
use crate::progress;

/// What was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Done {
    /// Cases of the shard.
    pub cases: usize,
    /// Cases whose errors were computed now.
    pub run: usize,
    /// Cases whose costs were measured now.
    pub timed: usize,
}

/// Cases between two writes.
const CHUNK: usize = 64;

/// Runs a shard of the plan and writes `out`.
///
/// While it runs, the rows stand in `out.errors.part`, without their costs, and in `out.part`.
/// With `resume` the rows in these files, and in `out` itself, are taken over.
pub fn execute(plan: &Plan, shard: Shard, out: &Path, resume: bool) -> Result<Done, Error> {
    if out.is_dir() || out.file_name().is_none() {
        return Err(Error::file(out, "is a folder; accepted is a file's path"));
    }
    let cases = plan.shard(shard);
    let earlier = resume && out.exists();
    let mut known = Earlier::open(plan, earlier.then_some(out))?;
    let have = known.indices()?;
    let errors_path = Part::path_of(out, ".errors.part");
    let mut errors = Part::open(&errors_path, plan, &cases, resume)?;
    let mut whole = Part::open(&Part::path_of(out, ".part"), plan, &cases, resume)?;

    let to_do = &cases[errors.rows()..];
    let missing: Vec<usize> =
        to_do.iter().copied().filter(|index| have.binary_search(index).is_err()).collect();
    solve_references(plan, &missing)?;
    let bar = progress::bar("errors", to_do.len());
    for chunk in to_do.chunks(CHUNK) {
        let taken = known.take(chunk)?;
        let rows = chunk
            .par_iter()
            .zip(taken)
            .map(|(&index, row)| row.map_or_else(|| errors_of(plan, index), Ok));
        errors.append(&rows.collect::<Result<Vec<_>, _>>()?)?;
        bar.inc(chunk.len() as u64);
    }
    bar.finish_and_clear();

    let done = whole.rows();
    let mut known = Earlier::open(plan, earlier.then_some(out))?;
    let mut rows = Rows::open(&errors_path)?.skip(done);
    let bar = progress::bar("time, one case at a time", cases.len() - done);
    let mut timed = 0;
    for chunk in cases[done..].chunks(CHUNK) {
        let mut finished = Vec::with_capacity(chunk.len());
        for ((&index, taken), row) in chunk.iter().zip(known.take(chunk)?).zip(rows.by_ref()) {
            finished.push(match taken {
                Some(row) if row.cost.is_some() => row,
                _ => {
                    timed += 1;
                    with_cost(plan, index, row?)?
                }
            });
            bar.inc(1);
        }
        whole.append(&finished)?;
    }
    bar.finish_and_clear();

    whole.finish(out)?;
    drop(errors);
    std::fs::remove_file(&errors_path).map_err(|error| Error::file(&errors_path, error))?;
    Ok(Done { cases: cases.len(), run: missing.len(), timed })
}

/// The rows of a whole plan in memory, for small ones.
pub fn rows(plan: &Plan) -> Result<Vec<Row>, Error> {
    let all: Vec<usize> = (0..plan.cases.len()).collect();
    solve_references(plan, &all)?;
    let bar = progress::bar("errors", all.len());
    let rows: Vec<Row> = all
        .par_iter()
        .map(|&index| errors_of(plan, index).inspect(|_| bar.inc(1)))
        .collect::<Result<_, _>>()?;
    bar.finish_and_clear();
    Ok(rows)
}

/// The row of a case with its cost. Nothing else should run meanwhile.
pub fn with_cost(plan: &Plan, index: usize, row: Row) -> Result<Row, Error> {
    let case = &plan.cases[index];
    let cost = cost::cost(plan.scene(case), case.keys)?;
    Ok(Row { cost: Some(cost), ..row })
}

/// The row of a case, without its cost.
fn errors_of(plan: &Plan, index: usize) -> Result<Row, Error> {
    let case = &plan.cases[index];
    let scene = plan.scene(case);
    let reference = plan.reference(case.motion)?;
    let errors = measure::errors(scene, case.keys, reference)
        .map_err(|error| error.within(format_args!("case {}, {}", index + 1, scene.name)))?;
    Ok(Row { id: plan.id(index), keys: case.keys, errors, cost: None })
}

/// Solves ahead, on all cores, what the cases would otherwise wait for one by one.
fn solve_references(plan: &Plan, cases: &[usize]) -> Result<(), Error> {
    let needed = plan.references(cases);
    let bar = progress::bar("reference rod", needed.len());
    needed.par_iter().try_for_each(|&index| {
        plan.reference(index)?;
        bar.inc(1);
        Ok::<(), Error>(())
    })?;
    bar.finish_and_clear();
    Ok(())
}

/// The rows of an earlier output, which may lack some: read in step with the cases.
struct Earlier<'a> {
    plan: &'a Plan,
    path: Option<&'a Path>,
    rows: Option<std::iter::Peekable<Rows>>,
}

impl<'a> Earlier<'a> {
    fn open(plan: &'a Plan, path: Option<&'a Path>) -> Result<Self, Error> {
        let rows = path.map(Rows::open).transpose()?.map(Iterator::peekable);
        Ok(Self { plan, path, rows })
    }

    /// Indices of all its cases; refuses rows of another sweep and rows out of order.
    fn indices(&self) -> Result<Vec<usize>, Error> {
        let Some(path) = self.path else { return Ok(Vec::new()) };
        let mut indices = Vec::new();
        for row in Rows::open(path)? {
            let index = self.plan.index_of(&row?).map_err(|e| e.within(path.display()))?;
            if indices.last().is_some_and(|&last| last >= index) {
                return Err(Error::file(
                    path,
                    format_args!("case {}: accepted are rising numbers", index + 1),
                ));
            }
            indices.push(index);
        }
        Ok(indices)
    }

    /// The rows it has of these cases.
    fn take(&mut self, cases: &[usize]) -> Result<Vec<Option<Row>>, Error> {
        cases.iter().map(|&index| self.take_one(index)).collect()
    }

    fn take_one(&mut self, index: usize) -> Result<Option<Row>, Error> {
        let Some(rows) = &mut self.rows else { return Ok(None) };
        let wanted = index as u64 + 1;
        while rows.next_if(|row| row.as_ref().is_ok_and(|row| row.id.case < wanted)).is_some() {}
        match rows.next_if(|row| row.as_ref().map_or(true, |row| row.id.case == wanted)) {
            Some(row) => Ok(Some(row?)),
            None => Ok(None),
        }
    }
}
