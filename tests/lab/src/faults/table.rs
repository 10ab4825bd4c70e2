//! The campaign as a table.

use super::Outcome;
use crate::table::{aligned, grouped};

/// Formats a line for each fault, in Markdown: the fault, its number, and the result.
pub fn markdown(rows: &[(&str, Outcome)]) -> String {
    let header = [
        "injected",
        "runs",
        "times",
        "setpoints",
        "frames dropped",
        "accepted",
        "refused",
        "stops: asked",
        "link lost",
        "ticks missed",
        "rate step, of Ah",
        "rate, of V",
        "acceleration, of A",
        "broken",
    ];
    let mut lines = vec![header.map(str::to_owned).to_vec()];
    for (name, outcome) in rows {
        let refused: u64 = outcome.refused.values().sum();
        let counts = [
            outcome.runs,
            outcome.injected,
            outcome.setpoints,
            outcome.dropped,
            outcome.accepted,
            refused,
            outcome.stops[0],
            outcome.stops[1],
            outcome.stops[2],
        ];
        let worst = outcome.worst;
        let mut line = vec![(*name).to_owned()];
        line.extend(counts.map(grouped));
        line.extend([worst.change, worst.rate, worst.acceleration].map(|x| format!("{x:.3}")));
        line.push(grouped(outcome.broken.len() as u64));
        lines.push(line);
    }
    aligned(&lines)
}

/// Lists the refusals, in words.
pub fn refusals(rows: &[(&str, Outcome)]) -> String {
    let mut all = Outcome::default();
    for (_, outcome) in rows {
        all.add(outcome.clone());
    }
    let counts: Vec<String> =
        all.refused.iter().map(|(kind, count)| format!("{kind} {}", grouped(*count))).collect();
    format!("Refused: {}.\n", counts.join(", "))
}
