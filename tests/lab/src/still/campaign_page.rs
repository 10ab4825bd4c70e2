//! The blocks of `docs/still.md` that the campaign writes.

use super::campaign::{Interruption, Outcome, Rest};
use super::interruption::refusals;
use crate::markers::Block;
use crate::table::quantile;

/// Interval at which the reference rod judges the rest-to-rest moves.
pub const ROD_EACH: usize = 2;

/// Number of interruptions of one arm.
pub const EACH: usize = 100;

/// Names of the blocks.
pub const NAMES: [&str; 2] = ["campaign-rests", "campaign-interruptions"];

/// Writes the results of random moves and of interruptions, drawn with that seed.
pub fn blocks(seed: u64, rests: &[Rest], interruptions: &[Interruption]) -> [Block; 2] {
    let [of_moves, of_others] = NAMES;
    [
        Block::new(of_moves, of_rests(seed, rests)),
        Block::new(of_others, of_interruptions(seed, interruptions)),
    ]
}

/// Returns a quantile for a table; not a number if there is none.
fn figure(sorted: &[f64], share: f64) -> f64 {
    quantile(sorted, share).unwrap_or(f64::NAN)
}

fn of_rests(seed: u64, all: &[Rest]) -> String {
    let mut text = format!(
        "{} moves, seed {seed}, one in {ROD_EACH} judged by the reference rod, the others by three modes in \
         f64. Residual in % of L.\n\n\
         | T/T\u{2081} | moves | refused | median | 99 % | largest | largest of the linear move | worse than the linear move by more than 0.01 % |\n\
         | --- | --: | --: | --: | --: | --: | --: | --: |\n",
        all.len()
    );
    for (low, high) in [(0.9, 1.2), (1.2, 1.6), (1.6, 2.5), (2.5, 4.0)] {
        let within: Vec<&Rest> =
            all.iter().filter(|rest| (low..high).contains(&rest.ratio)).collect();
        let pairs: Vec<(f64, f64)> = within.iter().filter_map(|rest| rest.residual.ok()).collect();
        let mut left: Vec<f64> = pairs.iter().map(|pair| 100.0 * pair.0).collect();
        left.sort_by(f64::total_cmp);
        let linear = pairs.iter().map(|pair| 100.0 * pair.1).fold(0.0, f64::max);
        let worse = pairs.iter().filter(|(still, linear)| *still > linear + 1e-4).count();
        text += &format!(
            "| {low} to {high} | {} | {} | {:.4} | {:.3} | {:.3} | {linear:.1} | {worse} |\n",
            within.len(),
            within.len() - pairs.len(),
            figure(&left, 0.5),
            figure(&left, 0.99),
            figure(&left, 1.0),
        );
    }
    let by_rod = all.iter().filter(|rest| rest.by_rod && rest.residual.is_ok()).count();
    text += &format!(
        "\nRefused: {}. Judged by the reference rod: {by_rod}.\n",
        refusals(all.iter().filter_map(|rest| rest.residual.as_ref().err()))
    );
    text
}

fn of_interruptions(seed: u64, all: &[Interruption]) -> String {
    let outcomes: Vec<_> = all.iter().filter_map(|one| one.outcome.ok()).collect();
    let most =
        |of: &dyn Fn(&Outcome) -> f64| outcomes.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let mut left: Vec<f64> = outcomes.iter().map(|one| 100.0 * one.residual).collect();
    left.sort_by(f64::total_cmp);
    let mut beyond: Vec<f64> =
        outcomes.iter().map(|one| 100.0 * (one.residual - one.stated)).collect();
    beyond.sort_by(f64::total_cmp);
    format!(
        "{} interruptions, seed {seed}, {EACH} an arm: a new target, a stop, another payload.\n\n\
         | | |\n| --- | --: |\n\
         | planned | {} |\n| of them with a stop on the way | {} |\n| refused | {} |\n\
         | largest excess over a limit at any tick, of the limit | {:.1e} |\n\
         | residual, median, % of L | {:.4} |\n| residual, 99 % | {:.3} |\n\
         | residual, largest | {:.3} |\n\
         | residual beyond what the planner states, 99.9 % | {:.3} |\n\
         | residual beyond what the planner states, largest | {:.3} |\n",
        all.len(),
        outcomes.len(),
        outcomes.iter().filter(|one| one.by_way_of_rest).count(),
        refusals(all.iter().filter_map(|one| one.outcome.as_ref().err())),
        most(&|one| one.excess),
        figure(&left, 0.5),
        figure(&left, 0.99),
        figure(&left, 1.0),
        figure(&beyond, 0.999),
        figure(&beyond, 1.0),
    )
}
