//! The table of `docs/mechanisms.md`.

use stillbeam_sim::error::Error;
use stillbeam_sim::number::{self, Digits};
use stillbeam_sim::truth::Reference;

use super::{NAMES, SOLVERS, Solver, Truth};
use crate::markers::Block;

/// Name of the block.
pub const NAME: &str = "mechanisms-truth";

/// Measures every solver on every scene. `done` is called after each.
///
/// # Errors
/// An error is returned if a solver has no solution.
pub fn block(done: &dyn Fn()) -> Result<Block, Error> {
    let mut text = "| scene |".to_owned();
    for solver in SOLVERS {
        text += &format!(" {} |", header(solver));
    }
    text += "\n| --- |";
    text += &" --: |".repeat(SOLVERS.len());
    for name in NAMES {
        let truth = Truth::read(name)?;
        text += &format!("\n| {name} |");
        for solver in SOLVERS {
            let error = truth.error(solver)?;
            text += &format!(" {:.1e} / {} |", error.place, percent(error.torque));
            done();
        }
    }
    Ok(Block::new(NAME, text))
}

fn header(solver: Solver) -> String {
    match solver {
        Solver::Reference(Reference::Rod) => "rod".to_owned(),
        Solver::Reference(Reference::Fem) => "elements".to_owned(),
        Solver::Core(n, tick) => format!("core, n = {n}, {} ms", 1e3 * tick),
    }
}

/// Returns a fraction in %, to three decimals.
fn percent(fraction: f64) -> String {
    if fraction < 1e-5 {
        return "< 0.001 %".to_owned();
    }
    number::percent(fraction, 1.0, Digits::Decimals(3))
}
