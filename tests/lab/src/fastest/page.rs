//! Writes the comparison as tables.

use super::cases::Case;
use super::motions::Entry;
use crate::markers::Block;
use crate::table::aligned;

/// Names of the blocks, one an arm.
pub const NAMES: [&str; 2] = ["fastest-a", "fastest-d"];

/// Returns a block for each arm: a row for each motion, a column for each set of limits.
pub fn blocks(judged: &[(Case, Vec<Entry>)]) -> Vec<Block> {
    let mut arms: Vec<&str> = judged.iter().map(|(case, _)| case.arm_name).collect();
    arms.dedup();
    arms.iter()
        .zip(NAMES)
        .map(|(&arm, name)| {
            let of_arm: Vec<_> = judged.iter().filter(|(case, _)| case.arm_name == arm).collect();
            Block::new(name, format!("{arm}:\n\n{}", table(&of_arm)))
        })
        .collect()
}

fn table(judged: &[&(Case, Vec<Entry>)]) -> String {
    let mut header = vec!["motion".to_owned()];
    header.extend(judged.iter().map(|(case, _)| case.limits_name.clone()));
    header.push("planned in".to_owned());
    let rows = judged.first().map_or(0, |(_, entries)| entries.len());
    let mut lines = vec![header];
    for row in 0..rows {
        let entries: Vec<&Entry> = judged.iter().map(|(_, entries)| &entries[row]).collect();
        let mut line = vec![entries[0].name.clone()];
        line.extend(entries.iter().map(|entry| match entry.found {
            Some([duration, residual]) if entry.name != "rigid bound" => {
                format!("{duration:.3} ({:.3})", 100.0 * residual)
            }
            Some([duration, _]) => format!("{duration:.3}"),
            None => "\u{2013}".to_owned(),
        }));
        let longest = entries.iter().filter_map(|entry| entry.planned_in).fold(0.0, f64::max);
        line.push(if longest > 0.0 { format!("{:.1} ms", 1e3 * longest) } else { String::new() });
        lines.push(line);
    }
    aligned(&lines)
}
