//! The table of random mechanisms.

use super::random::{End, Outcome, Trial};
use crate::markers::Block;

/// Name of the block.
pub const NAME: &str = "mechanisms-random";

/// Kinds of refusal, in the order of the columns.
const REFUSALS: [&str; 6] = ["move", "tick", "pin out of reach", "loop", "no stable rest", "other"];

/// Writes the table: a row a number of links and end.
pub fn block(trials: &[Trial]) -> Block {
    let mut text = "| links | end | tried |".to_owned();
    for kind in REFUSALS {
        text += &format!(" refused: {kind} |");
    }
    text +=
        " not finite | judged | median error | largest, deflections to 0.2 L | to 0.5 L | all |\n";
    text += &format!("| --: | --- |{}", " --: |".repeat(REFUSALS.len() + 7));
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
    let mut ran: Vec<(f64, f64)> = trials
        .iter()
        .filter_map(|trial| match trial.outcome {
            Outcome::Ran { place, deflection } => Some((place, deflection)),
            _ => None,
        })
        .collect();
    ran.sort_by(|a, b| a.0.total_cmp(&b.0));
    let worst = |most: f64| {
        let within = ran.iter().rfind(|(_, deflection)| *deflection <= most);
        within.map_or("–".to_owned(), |(place, _)| format!("{place:.1e}"))
    };
    let median =
        ran.get(ran.len() / 2).map_or("–".to_owned(), |(place, _)| format!("{place:.1e}"));
    text += &format!(
        " {} | {} | {median} | {} | {} | {} |",
        count(&|outcome| *outcome == Outcome::NotFinite),
        ran.len(),
        worst(0.2),
        worst(0.5),
        worst(f64::INFINITY)
    );
    text
}
