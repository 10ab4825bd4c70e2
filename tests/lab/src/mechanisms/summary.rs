//! The table of random mechanisms.

use super::random::{End, Judged, Outcome, Trial};
use crate::markers::Block;

/// Name of the block.
pub const NAME: &str = "mechanisms-random";

/// Kinds of refusal, in the order of the columns.
const REFUSALS: [&str; 6] = ["move", "tick", "pin out of reach", "loop", "no stable rest", "other"];

/// Writes how the trials were made, and the table: a row a number of links and end.
pub fn block(trials: &[Trial], seed: u64, judged: u64) -> Block {
    let count = trials.len();
    let mut text = format!(
        "`cargo lab mechanisms --count {count} --seed {seed} --judge {judged}`\n\n\
         | links | end | tried |"
    );
    for kind in REFUSALS {
        text += &format!(" refused: {kind} |");
    }
    text += " ran | largest deflection, of L | not finite | judged | median error \
         | largest, deflections to 0.2 L | to 0.5 L | all |\n";
    text += &format!("| --: | --- |{}", " --: |".repeat(REFUSALS.len() + 9));
    for links in 1..=3 {
        for (end, name) in [(End::Open, "open"), (End::Closes, "closes"), (End::Loop, "loop")] {
            let own: Vec<&Trial> =
                trials.iter().filter(|trial| trial.links == links && trial.end == end).collect();
            text += &row(links, name, &own);
        }
    }
    Block::new(NAME, text)
}

fn row(links: usize, end: &str, trials: &[&Trial]) -> String {
    let count = |wanted: &dyn Fn(&Outcome) -> bool| {
        trials.iter().filter(|trial| wanted(&trial.outcome)).count()
    };
    let mut text = format!("\n| {links} | {end} | {} |", trials.len());
    for kind in REFUSALS {
        text += &format!(" {} |", count(&|outcome| *outcome == Outcome::Refused(kind)));
    }
    let ran: Vec<(f64, Option<Judged>)> = trials
        .iter()
        .filter_map(|trial| match trial.outcome {
            Outcome::Ran { deflection, judged } => Some((deflection, judged)),
            _ => None,
        })
        .collect();
    let bent = ran.iter().map(|(deflection, _)| *deflection).fold(0.0, f64::max);
    let mut judged: Vec<Judged> = ran.iter().filter_map(|(_, judged)| *judged).collect();
    judged.sort_by(|a, b| a.place.total_cmp(&b.place));
    let shown = |judged: Option<&Judged>| {
        judged.map_or("–".to_owned(), |judged| format!("{:.1e}", judged.place))
    };
    let worst = |most: f64| shown(judged.iter().rfind(|judged| judged.deflection <= most));
    text += &format!(
        " {} | {bent:.2} | {} | {} | {} | {} | {} | {} |",
        ran.len(),
        count(&|outcome| *outcome == Outcome::NotFinite),
        judged.len(),
        shown(judged.get(judged.len() / 2)),
        worst(0.2),
        worst(0.5),
        worst(f64::INFINITY)
    );
    text
}
