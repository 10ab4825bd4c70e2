//! The campaign as a table.

use super::Outcome;
use crate::table::{aligned, grouped};

/// Formats a line for each fault, in Markdown.
pub fn markdown(rows: &[(&str, Outcome)]) -> String {
    let header = [
        "injected",
        "runs",
        "times",
        "setpoints",
        "moves refused",
        "torques cut",
        "stops",
        "way of a stop, of its bound",
        "hub behind, rad",
        "hub turns at the end, rad",
        "tip swings at the end, % of L",
        "energy error",
        "broken",
    ];
    let mut lines = vec![header.map(str::to_owned).to_vec()];
    for (name, outcome) in rows {
        let Outcome { runs, injected, setpoints, refused, cut, stops, .. } = *outcome;
        let counts = [runs, injected, setpoints, refused, cut, stops];
        let mut line = vec![(*name).to_owned()];
        line.extend(counts.map(grouped));
        line.push(format!("{:.3}", outcome.way));
        line.push(format!("{:.3}", outcome.behind));
        line.push(format!("{:.1e}", outcome.turn));
        line.push(format!("{:.3}", 1e2 * outcome.swing));
        line.push(format!("{:.1e}", outcome.energy));
        line.push(grouped(outcome.broken.len() as u64));
        lines.push(line);
    }
    aligned(&lines)
}
