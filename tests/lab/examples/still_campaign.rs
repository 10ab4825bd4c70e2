//! `cargo run --release --example still_campaign -- docs/still.md [RESTS] [INTERRUPTIONS]`: random
//! still moves and random interruptions by the thousand; fills the campaign's part of the text.

use std::path::PathBuf;

use stillbeam_lab::markers;
use stillbeam_lab::still::campaign::{self, Interruption, Refusals, Rest};
use stillbeam_sim::error::Error;
use stillbeam_sim::{output, progress};

const SEED: u64 = 20_260_101;
/// Of the rest-to-rest moves, one in so many is judged by the reference rod.
const ROD_EACH: usize = 2;
/// Interruptions of one arm.
const EACH: usize = 100;

fn main() -> Result<(), Error> {
    let mut args = std::env::args().skip(1);
    let path = PathBuf::from(args.next().unwrap_or_else(|| "docs/still.md".into()));
    let mut count = |default| args.next().and_then(|n| n.parse().ok()).unwrap_or(default);
    let (rests, interruptions): (usize, usize) = (count(10_000), count(100_000));
    let bar = progress::bar("rest to rest", rests);
    let rested = campaign::rests(SEED, rests, ROD_EACH, &|| bar.inc(1))?;
    bar.finish_and_clear();
    let arms = interruptions / EACH;
    let bar = progress::bar("interruptions", arms);
    let interrupted = campaign::interruptions(SEED, arms, EACH, &|| bar.inc(1))?;
    bar.finish_and_clear();
    let text = std::fs::read_to_string(&path).map_err(|cause| Error::file(&path, cause))?;
    let campaigns = [
        ("campaign-rests".to_owned(), of_rests(&rested)),
        ("campaign-interruptions".to_owned(), of_interruptions(&interrupted)),
    ];
    let filled = markers::fill(&text, "still", &campaigns)?;
    output::write_whole(&path, |file| file.write_all(filled.as_bytes()))?;
    for (_, block) in &campaigns {
        println!("{block}");
    }
    Ok(())
}

fn percentile(sorted: &[f64], share: f64) -> f64 {
    if sorted.is_empty() { f64::NAN } else { sorted[((sorted.len() - 1) as f64 * share) as usize] }
}

fn refusals<'a>(kinds: impl Iterator<Item = &'a &'static str>) -> String {
    let mut counts = Refusals::new();
    for kind in kinds {
        *counts.entry(kind).or_default() += 1;
    }
    let words: Vec<String> = counts.iter().map(|(kind, n)| format!("{kind} {n}")).collect();
    if words.is_empty() { "none".into() } else { words.join(", ") }
}

fn of_rests(all: &[Rest]) -> String {
    let mut text = format!(
        "{} moves, seed {SEED}, one in {ROD_EACH} judged by the reference rod, the others by three modes in \
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
            percentile(&left, 0.5),
            percentile(&left, 0.99),
            percentile(&left, 1.0),
        );
    }
    let by_rod = all.iter().filter(|rest| rest.by_rod && rest.residual.is_ok()).count();
    text += &format!(
        "\nRefused: {}. Judged by the reference rod: {by_rod}.\n",
        refusals(all.iter().filter_map(|rest| rest.residual.as_ref().err()))
    );
    text
}

fn of_interruptions(all: &[Interruption]) -> String {
    let outcomes: Vec<_> = all.iter().filter_map(|one| one.outcome.ok()).collect();
    let most = |of: &dyn Fn(&campaign::Outcome) -> f64| {
        outcomes.iter().map(of).fold(f64::NEG_INFINITY, f64::max)
    };
    let mut left: Vec<f64> = outcomes.iter().map(|one| 100.0 * one.residual).collect();
    left.sort_by(f64::total_cmp);
    let mut beyond: Vec<f64> =
        outcomes.iter().map(|one| 100.0 * (one.residual - one.stated)).collect();
    beyond.sort_by(f64::total_cmp);
    format!(
        "{} interruptions, seed {SEED}, {EACH} an arm: a new target, a stop, another payload.\n\n\
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
        percentile(&left, 0.5),
        percentile(&left, 0.99),
        percentile(&left, 1.0),
        percentile(&beyond, 0.999),
        percentile(&beyond, 1.0),
    )
}
