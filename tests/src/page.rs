//! The tables in `docs/instructions.md`.

use std::collections::BTreeMap;
use std::fmt::Write;

use stillbeam_lab::markers::{self, Block};

use crate::cycles::{self, Estimate};
use crate::instructions::{Bench, Count, Minimal};
use crate::parts;

/// Method of the rows that count plans.
const PLAN: &str = "plan";

/// Method of the rows that count changes of the motion.
const CHANGE: &str = "change";

/// Columns of the large table: heading, and the words that are skipped.
const COLUMNS: [(&str, &[&str]); 8] = [
    ("all terms", &[]),
    ("no gravity", &["no-gravity"]),
    ("no damping", &["no-damping"]),
    ("neither", &["no-damping", "no-gravity"]),
    ("neither, at rest", &["no-damping", "no-gravity", "at-rest"]),
    ("neither, asleep", &["no-damping", "no-gravity", "at-rest", "asleep"]),
    ("neither, next segment", &["no-damping", "no-gravity", "next-segment"]),
    ("neither, landing", &["no-damping", "no-gravity", "landing", "still"]),
];

/// Counts on processors without floating-point unit.
#[derive(Debug)]
pub struct Soft {
    /// On a Cortex-M3.
    pub cortex_m3: Bench,
    /// Of Armv6-M's instructions.
    pub cortex_m0: Bench,
    /// On RV32IMAC.
    pub riscv: Bench,
}

/// Returns the page with its tables replaced.
///
/// # Errors
/// An error is returned if the markers are missing.
pub fn replace(page: &str, tables: &str) -> Result<String, String> {
    let block = Block::new("instructions", tables.to_owned());
    markers::fill(page, &[block]).map_err(|error| format!("docs/instructions.md: {error}"))
}

/// Returns the tables of the processor with an FPU and of those without.
pub fn tables(
    bench: &Bench,
    soft: &Soft,
    minimal: &BTreeMap<String, Minimal>,
    prepared: &[Minimal],
    estimates: &[Estimate],
) -> String {
    let sections = [
        methods(bench, minimal),
        cycles::table(bench, estimates),
        motions(bench),
        plans(bench, minimal),
        changes(bench),
        functions(bench),
        without_fpu(CORTEX_M3, &soft.cortex_m3),
        without_fpu(CORTEX_M0, &soft.cortex_m0),
        without_fpu(RISCV, &soft.riscv),
        parts::table(bench, soft, prepared),
    ];
    format!("\n{}", sections.join("\n"))
}

fn methods(bench: &Bench, minimal: &BTreeMap<String, Minimal>) -> String {
    let mut text = "### A tick, worst, in instructions (not cycles)\n\n\
                    | method | elements |"
        .to_owned();
    for (heading, _) in COLUMNS {
        write!(text, " {heading} |").expect("a string");
    }
    text += " set-up | flash | RAM | stack |\n|---|---|";
    text += &"---|".repeat(COLUMNS.len() + 4);
    text.push('\n');
    let mut seen = Vec::new();
    for count in &bench.counts {
        let [method, size, quality, _] = &count.key;
        let own: &[&str] = if skips(count).contains(&"no-spin") { &["no-spin"] } else { &[] };
        if seen.contains(&(&count.id, quality)) || motion(count) || is_beside_tick(method) {
            continue;
        }
        seen.push((&count.id, quality));
        write!(
            text,
            "| {} | {size} |",
            [&[method.as_str(), quality], own].concat().join(" ").trim()
        )
        .expect("a string");
        for (_, words) in COLUMNS {
            let worst = bench
                .counts
                .iter()
                .find(|other| {
                    other.key[..3] == count.key[..3] && skips(other) == [own, words].concat()
                })
                .map_or("".to_owned(), |other| other.worst.to_string());
            write!(text, " {worst} |").expect("a string");
        }
        let Minimal { flash, ram, stack } = minimal[&count.id];
        writeln!(text, " {} | {flash} | {ram} | {stack} |", count.setup).expect("a string");
    }
    text
}

/// Returns the cost of a rigid arm's tick with each motion. The difference is the motion's.
fn motions(bench: &Bench) -> String {
    let mut text = "### The motion's share: a rigid arm, no damping, no gravity\n\n\
                    | motion | path | least | worst |\n|---|---|---|---|\n"
        .to_owned();
    for count in &bench.counts {
        let Some(path) = count.key[3].strip_prefix("no-damping no-gravity") else { continue };
        if count.key[0] == "rigid" {
            let profile = if motion(count) { &count.key[2] } else { "cubic" };
            let path = if path.is_empty() { "turning" } else { path.trim() };
            writeln!(text, "| {profile} | {path} | {} | {} |", count.least, count.worst)
                .expect("a string");
        }
    }
    text
}

/// Returns the cost of a plan of a still move, once a move, outside the tick.
fn plans(bench: &Bench, minimal: &BTreeMap<String, Minimal>) -> String {
    let mut text = "### A plan of a still move, once a move, outside the tick\n\n\
                    | move | instructions | set-up of the planner | flash | RAM | stack |\n\
                    |---|---|---|---|---|---|\n"
        .to_owned();
    for count in bench.counts.iter().filter(|count| count.key[0] == PLAN) {
        let Minimal { flash, ram, stack } = minimal[&count.id];
        let (name, worst, setup) = (&count.key[2], count.worst, count.setup);
        writeln!(text, "| {name} | {worst} | {setup} | {flash} | {ram} | {stack} |")
            .expect("a string");
    }
    text
}

/// Returns the cost of changes of the motion, with a rigid arm.
fn changes(bench: &Bench) -> String {
    let mut text = "### A change of the motion, a rigid arm\n\n\
                    | change | instructions |\n|---|---|\n"
        .to_owned();
    for count in bench.counts.iter().filter(|count| count.key[0] == CHANGE) {
        writeln!(text, "| {} | {} |", count.key[2], count.worst).expect("a string");
    }
    text
}

/// True if a row counts no tick of a method.
fn is_beside_tick(method: &str) -> bool {
    method == PLAN || method == CHANGE
}

fn functions(bench: &Bench) -> String {
    let mut text = "### Sine and cosine of one angle, call included\n\n\
                    | whose | least | worst | largest error |\n|---|---|---|---|\n"
        .to_owned();
    for f in &bench.functions {
        writeln!(text, "| {} | {} | {} | {} |", f.name, f.least, f.worst, f.error)
            .expect("a string");
    }
    text
}

/// Processors without floating-point unit whose ticks are counted.
pub const CORTEX_M3: &str = "Cortex-M3";
/// Armv6-M: 16-bit instructions, no division, no long multiplication.
pub const CORTEX_M0: &str = "Cortex-M0 and M0+";
/// RISC-V, 32 bits, with multiplication and division of integers.
pub const RISCV: &str = "RV32IMAC";

/// Returns the ticks inside of a move, with every term and with none, without an FPU. There
/// arithmetic is a call whose cost depends on its operands.
pub fn without_fpu(processor: &str, soft: &Bench) -> String {
    let mut text = format!(
        "### Without an FPU ({processor}): ticks inside of a move, one path\n\n\
         | method | size | terms | least | worst | spread |\n|---|---|---|---|---|---|\n"
    );
    for count in &soft.counts {
        let [method, size, _, skip] = &count.key;
        let terms = match skip.as_str() {
            "" => "all",
            "no-damping no-gravity" => "neither",
            _ => continue,
        };
        if is_beside_tick(method) || motion(count) {
            continue;
        }
        let Count { least, worst, .. } = count;
        let spread = 100.0 * (f64::from(*worst) / f64::from(*least) - 1.0);
        let name = name(count);
        writeln!(text, "| {name} | {size} | {terms} | {least} | {worst} | {spread:.0} % |")
            .expect("a string");
    }
    text
}

/// Returns the method of a row as the tables name it.
pub fn name(count: &Count) -> String {
    let [method, _, quality, _] = &count.key;
    [method.as_str(), quality].join(" ").trim().to_owned()
}

fn skips(count: &Count) -> Vec<&str> {
    count.key[3].split_whitespace().collect()
}

/// True if a rigid arm's row names a motion, that is, one other than the cubic.
fn motion(count: &Count) -> bool {
    count.key[0] == "rigid" && !count.key[2].is_empty()
}
