//! Estimates of the cycles that a tick takes: a table of `docs/instructions.md`.

use std::fmt::Write;

use crate::instructions::{Bench, Count};
use crate::timing::cycles;
use crate::trace::Trace;
use crate::{firmware, page};

/// Clock of the table's times, MHz.
const CLOCK: f64 = 168.0;

/// The worst of the ticks that were traced.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Estimate {
    /// The method's name in the list of methods.
    pub id: String,
    /// The scene's terms: `all`, or `neither` damping nor gravity.
    pub terms: String,
    /// Instructions.
    pub instructions: u32,
    /// Cycles by published timings.
    pub cycles: u32,
}

/// Builds and traces the image with the arms.
///
/// # Errors
/// An error is returned if something is missing or fails: the build, the emulator, the trace, or
/// the timing of an instruction.
pub fn estimate() -> Result<Vec<Estimate>, String> {
    let trace = Trace::of(&firmware::build("traced")?)?;
    let ticks = trace.ticks()?;
    let arms: Vec<&str> = trace.printed.lines().collect();
    if arms.is_empty() || ticks.len() % arms.len() != 0 {
        return Err(format!("traced: {} ticks of {} arms", ticks.len(), arms.len()));
    }
    let each = ticks.len() / arms.len();
    arms.iter()
        .zip(ticks.chunks(each))
        .map(|(arm, ticks)| {
            let (id, terms) = arm.split_once(',').ok_or(format!("traced printed {arm}"))?;
            let cycles = ticks.iter().map(|tick| cycles(tick)).collect::<Result<Vec<_>, _>>()?;
            Ok(Estimate {
                id: id.to_owned(),
                terms: terms.to_owned(),
                instructions: ticks.iter().map(Vec::len).max().unwrap_or(0) as u32,
                cycles: cycles.into_iter().max().unwrap_or(0),
            })
        })
        .collect()
}

/// Returns the worst tick inside of a move that the bench counted for what was traced.
pub fn counted<'a>(bench: &'a Bench, estimate: &Estimate) -> Option<&'a Count> {
    let skip = if estimate.terms == "all" { "" } else { "no-damping no-gravity" };
    bench.counts.iter().find(|count| count.id == estimate.id && count.key[3] == skip)
}

/// Returns the table.
pub fn table(bench: &Bench, estimates: &[Estimate]) -> String {
    let mut text = format!(
        "### Cycles of a Cortex-M4F: an estimate\n\n\
         Ticks inside of a move, traced in QEMU. Each instruction takes the cycles of Arm's\n\
         Cortex-M4 Technical Reference Manual (DDI 0439): loads and stores, multiplications,\n\
         divisions, branches that are taken, and a cycle more where a float is used by the\n\
         instruction behind the one that computes it. **No board has measured this.** The memory\n\
         has no wait states; where the manual gives a range the most is taken, so three cycles\n\
         behind a branch.\n\n\
         | method | size | terms | instructions | cycles, estimated | µs at {CLOCK:.0} MHz |\n\
         |---|---|---|---|---|---|\n"
    );
    for estimate in estimates {
        let Some(count) = counted(bench, estimate) else { continue };
        let Estimate { terms, instructions, cycles, .. } = estimate;
        let name = page::name(count);
        let time = f64::from(*cycles) / CLOCK;
        let size = &count.key[1];
        writeln!(text, "| {name} | {size} | {terms} | {instructions} | {cycles} | {time:.1} |")
            .expect("a string");
    }
    text
}
