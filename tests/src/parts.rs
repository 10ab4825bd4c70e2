//! Which part takes which method: a table of `docs/instructions.md`.

use std::fmt::Write;

use crate::instructions::{Bench, Minimal};
use crate::page::Soft;

/// Cycles that an instruction takes at most on average: loads, taken branches and a flash that lags
/// behind the core are in it.
const CYCLES: f64 = 2.0;

/// Tick that the shares are of, s.
const TICK: f64 = 0.010;

/// A processor, by what its ticks are counted on.
#[derive(Clone, Copy)]
enum Core {
    WithFpu,
    CortexM3,
    CortexM0,
    RiscV,
}

/// A microcontroller: name, processor, flash and RAM in KiB, clock in MHz, as its data sheet says.
/// Flash of more than 1,024 KiB is a chip beside it.
const PARTS: [(&str, &str, Core, u32, u32, f64); 6] = [
    ("STM32F103C8", "Cortex-M3", Core::CortexM3, 64, 20, 72.0),
    ("STM32G431KB", "Cortex-M4F", Core::WithFpu, 128, 32, 170.0),
    ("STM32F446RE", "Cortex-M4F", Core::WithFpu, 512, 128, 180.0),
    ("STM32G474RE", "Cortex-M4F", Core::WithFpu, 512, 128, 170.0),
    ("RP2040", "Cortex-M0+", Core::CortexM0, 2048, 264, 133.0),
    ("ESP32-C3", "RV32IMC", Core::RiscV, 4096, 400, 160.0),
];

/// Methods of the table: heading, name in the list of methods.
pub const METHODS: [(&str, &str); 2] =
    [("newmark, 1 element", "Newmark1Nodal"), ("elastica, 2 modes, fast", "Elastica2")];

/// Returns the table, with the sizes of the programs that load a prepared arm, one of each of
/// [`METHODS`].
pub fn table(bench: &Bench, soft: &Soft, prepared: &[Minimal]) -> String {
    let mut text = "### Which part takes which method\n\n".to_owned();
    for ((name, _), size) in METHODS.iter().zip(prepared) {
        let Minimal { flash, ram, stack } = size;
        writeln!(
            text,
            "- A program with one prepared arm of {name} takes {flash} bytes of flash and {} of RAM.",
            u64::from(*stack) + ram
        )
        .expect("a string");
    }
    text += "\nA cell is the share of 10 ms that a tick of one axis takes, every term in it, at two cycles an instruction.\n\n\
             | part | processor | flash, KiB | RAM, KiB | MHz |";
    for (name, _) in METHODS {
        write!(text, " {name} |").expect("a string");
    }
    text += "\n|---|---|---|---|---|---|---|\n";
    for (name, processor, core, flash, ram, clock) in PARTS {
        write!(text, "| {name} | {processor} | {flash} | {ram} | {clock} |").expect("a string");
        for ((_, id), size) in METHODS.iter().zip(prepared) {
            let fits = size.flash <= u64::from(flash) * 1024
                && size.ram + u64::from(size.stack) <= u64::from(ram) * 1024;
            let counts = match core {
                Core::WithFpu => bench,
                Core::CortexM3 => &soft.cortex_m3,
                Core::CortexM0 => &soft.cortex_m0,
                Core::RiscV => &soft.riscv,
            };
            let share = |count: u32| 100.0 * CYCLES * f64::from(count) / (clock * 1e6 * TICK);
            let cell = if fits {
                format!("{:.2} %", share(worst(counts, id)))
            } else {
                "does not fit".to_owned()
            };
            write!(text, " {cell} |").expect("a string");
        }
        text.push('\n');
    }
    text
}

/// Instructions of the worst tick inside of a move, with every term.
fn worst(bench: &Bench, id: &str) -> u32 {
    let counts = bench.counts.iter();
    let all_terms = counts.filter(|count| count.id == id && count.key[3].is_empty());
    all_terms.map(|count| count.worst).max().unwrap_or_else(|| panic!("{id}: not counted"))
}
