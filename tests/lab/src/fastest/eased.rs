//! The cost to a fastest move of a begin and an end without acceleration.

use std::f64::consts::PI;

use rayon::prelude::*;
use stillbeam::math::Scalar;
use stillbeam::planner::{FastestMove, Planner, Request};
use stillbeam_sim::error::Error;
use stillbeam_sim::plan::judge::Motion;
use stillbeam_sim::plan::shortest::{self, INTERVALS};

use super::cases::{self, Case};
use super::motions::ON_TARGET;
use crate::markers::Block;
use crate::table::aligned;

/// Name of the block.
pub const NAME: &str = "fastest-eased";

/// Measures and writes the table: the cases without a limit of the jerk and without a cruise.
pub fn block() -> Result<Block, Error> {
    let jumps = |case: &Case| case.limits.jerk.is_none() && case.limits.acceleration.is_some();
    let cases: Vec<Case> = cases::all()?.into_iter().filter(jumps).collect();
    let rows = cases.par_iter().map(line).collect::<Result<Vec<_>, _>>()?;
    let header = ["arm", "limits", "jumps", "eased", "longer", "jerk", "longer, on a target"];
    let header = header.map(str::to_owned).to_vec();
    Ok(Block::new(NAME, aligned(&std::iter::once(header).chain(rows).collect::<Vec<_>>())))
}

fn line(case: &Case) -> Result<Vec<String>, Error> {
    let [jumps, eased] = plans::<f64, INTERVALS>(case)?;
    let [on_target, eased_there] = plans::<f32, ON_TARGET>(case)?;
    let show = |plan: &Option<FastestMove<INTERVALS>>| match plan {
        Some(plan) => {
            let judged = Motion::of(0.0, shortest::path(plan), case.tick).judge(&case.arm, 0.0)?;
            let periods = plan.duration() / case.period;
            Ok(format!("{periods:.3} ({:.3})", 100.0 * judged.residual))
        }
        None => Ok::<_, Error>(DASH.to_owned()),
    };
    let jerk = eased.map(|plan| plan.peaks.jerk * plan.duration().powi(3) / PI);
    Ok(vec![
        case.arm_name.to_owned(),
        case.limits_name.clone(),
        show(&jumps)?,
        show(&eased)?,
        longer(&jumps, &eased),
        jerk.map_or(DASH.to_owned(), |jerk| format!("{jerk:.0}")),
        longer(&on_target, &eased_there),
    ])
}

/// Stands where nothing was found.
const DASH: &str = "\u{2013}";

/// The fastest move that may jump at its ends, and the eased one.
fn plans<T: Scalar, const N: usize>(case: &Case) -> Result<[Option<FastestMove<N>>; 2], Error> {
    let planner = Planner::<T, 2>::new(&case.arm, case.tick)?;
    let request = Request::from_rest(0.0, PI).limits(case.limits).any_deflection();
    Ok([planner.fastest(&request)?, planner.fastest(&request.eased())?])
}

/// Duration of the second over the first, less one.
fn longer<const N: usize>(
    first: &Option<FastestMove<N>>,
    second: &Option<FastestMove<N>>,
) -> String {
    match (first, second) {
        (Some(first), Some(second)) => {
            format!("{:.1} %", 100.0 * (second.duration() / first.duration() - 1.0))
        }
        _ => DASH.to_owned(),
    }
}
