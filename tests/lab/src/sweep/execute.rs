//! Runs a sweep: errors on all cores, then costs on one.

use rayon::prelude::*;

use super::plan::Plan;
use super::row::Row;
use super::{cost, measure};
use stillbeam_sim::error::Error;
use stillbeam_sim::progress;

/// Computes the rows of a plan with errors and costs, in the order of its cases.
///
/// Costs are measured one case at a time. Nothing else should run meanwhile.
///
/// # Errors
/// An error is returned if a reference solution or a case fails. It names the case's number and
/// scene.
pub fn rows(plan: &Plan) -> Result<Vec<Row>, Error> {
    let mut rows = errors(plan)?;
    let bar = progress::bar("time, one case at a time", rows.len());
    for (case, row) in plan.cases.iter().zip(&mut rows) {
        row.cost = Some(cost::cost(plan.scene(case), case.keys)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(rows)
}

/// Computes the rows of a plan with errors and without costs, in the order of its cases.
///
/// # Errors
/// Errors are those of [`rows`].
pub fn errors(plan: &Plan) -> Result<Vec<Row>, Error> {
    solve_references(plan)?;
    let bar = progress::bar("errors", plan.cases.len());
    let rows = (0..plan.cases.len())
        .into_par_iter()
        .map(|index| errors_of(plan, index).inspect(|_| bar.inc(1)))
        .collect();
    bar.finish_and_clear();
    rows
}

/// Computes the row of a case, without its cost.
fn errors_of(plan: &Plan, index: usize) -> Result<Row, Error> {
    let case = &plan.cases[index];
    let scene = plan.scene(case);
    let reference = plan.reference(case.motion)?;
    let errors = measure::errors(scene, case.keys, reference)
        .map_err(|error| error.within(format_args!("case {}, {}", index + 1, scene.name)))?;
    Ok(Row { id: plan.id(index), keys: case.keys, errors, cost: None })
}

/// Solves the reference solutions ahead on all cores, so that the cases do not wait for each of
/// them.
fn solve_references(plan: &Plan) -> Result<(), Error> {
    let bar = progress::bar("reference rod", plan.references());
    (0..plan.references()).into_par_iter().try_for_each(|index| {
        plan.reference(index)?;
        bar.inc(1);
        Ok::<(), Error>(())
    })?;
    bar.finish_and_clear();
    Ok(())
}
