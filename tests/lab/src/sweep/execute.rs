//! Runs a sweep: errors on all cores, then costs on one, into a file that survives interruptions.

use std::path::Path;
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::part::Part;
use super::plan::{Plan, Shard};
use super::row::{Row, Rows};
use super::{cost, measure};
use stillbeam_sim::error::Error;
use stillbeam_sim::progress;

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

/// Runs a shard of the plan and writes `out`.
///
/// While it runs, the rows stand in `out.errors.part`, without their costs and in the order in which
/// they are finished, and in `out.part`; each is there as soon as it is known.
/// With `resume` the rows in these files, and in `out` itself, are taken over.
pub fn execute(plan: &Plan, shard: Shard, out: &Path, resume: bool) -> Result<Done, Error> {
    if out.is_dir() || out.file_name().is_none() {
        return Err(Error::file(out, "is a folder; must be a file's path"));
    }
    let cases = plan.shard(shard);
    let earlier = resume && out.exists();
    let mut known = Earlier::open(plan, earlier.then_some(out))?;
    let have = known.indices()?;
    let errors_path = Part::path_of(out, ".errors.part");
    let mut errors = Part::open(&errors_path, plan, &cases, resume)?;
    let mut whole = Part::open(&Part::path_of(out, ".part"), plan, &cases, resume)?;

    let mut finished = errors.has().to_vec();
    finished.sort_unstable();
    let mut missing = Vec::new();
    for &index in cases.iter().filter(|index| finished.binary_search(index).is_err()) {
        match have.binary_search(&index).ok().map(|_| known.take_one(index)).transpose()?.flatten()
        {
            Some(row) => errors.append(index, &row)?,
            None => missing.push(index),
        }
    }
    solve_references(plan, &missing)?;
    let bar = progress::bar("errors", missing.len());
    let errors = Mutex::new(errors);
    missing.par_iter().try_for_each(|&index| {
        let row = errors_of(plan, index)?;
        bar.inc(1);
        errors.lock().unwrap_or_else(PoisonError::into_inner).append(index, &row)
    })?;
    bar.finish_and_clear();
    let errors = errors.into_inner().unwrap_or_else(PoisonError::into_inner).sort(plan)?;

    let done = whole.has().len();
    if whole.has() != &cases[..done] {
        let path = Part::path_of(out, ".part");
        return Err(Error::file(&path, "its cases must be those of this shard, in order"));
    }
    let mut known = Earlier::open(plan, earlier.then_some(out))?;
    let mut rows = Rows::open(&errors_path)?.skip(done);
    let bar = progress::bar("time, one case at a time", cases.len() - done);
    let mut timed = 0;
    for (&index, row) in cases[done..].iter().zip(rows.by_ref()) {
        let row = match known.take_one(index)? {
            Some(row) if row.cost.is_some() => row,
            _ => {
                timed += 1;
                with_cost(plan, index, row?)?
            }
        };
        whole.append(index, &row)?;
        bar.inc(1);
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
fn with_cost(plan: &Plan, index: usize, row: Row) -> Result<Row, Error> {
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
                    format_args!("case {}: cases must be in rising order", index + 1),
                ));
            }
            indices.push(index);
        }
        Ok(indices)
    }

    /// The row it has of a case; ask for rising cases.
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
