//! Traces of the ticks that an image executes in QEMU, instruction by instruction.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use crate::emulator::{self, LIMIT};

/// An instruction as QEMU disassembles it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instruction {
    /// Size, bytes.
    pub size: u32,
    /// Mnemonic, with its condition and the types of its operands.
    pub mnemonic: String,
    /// Operands, the one that is written first.
    pub operands: String,
}

/// Ticks, each of which the image has put between two barriers.
#[derive(Debug)]
pub struct Trace {
    /// The text that the image printed.
    pub printed: String,
    /// Instructions by their addresses.
    instructions: HashMap<u32, Instruction>,
    /// Addresses of each tick in the order of execution, with that of the barrier behind it.
    ticks: Vec<Vec<u32>>,
}

/// An instruction that was executed.
#[derive(Clone, Copy, Debug)]
pub struct Executed<'a> {
    /// The instruction as it was translated.
    pub instruction: &'a Instruction,
    /// True if the next one executed is not the one behind it in memory.
    pub branched: bool,
}

impl Trace {
    /// Runs an image that puts each of its ticks between two barriers.
    ///
    /// # Errors
    /// An error is returned if the run fails, if its log cannot be read, or if a barrier has no
    /// counterpart.
    pub fn of(image: &Path) -> Result<Self, String> {
        let log = tempfile::NamedTempFile::new().map_err(|error| format!("trace: {error}"))?;
        let printed = emulator::trace(image, log.path(), LIMIT)?;
        let printed = String::from_utf8_lossy(&printed).into_owned();
        let file = File::open(log.path()).map_err(|error| format!("trace: {error}"))?;
        Self::read(BufReader::new(file), printed)
    }

    /// Reads QEMU's log: an instruction when it is translated, and its address whenever it is
    /// executed.
    fn read(log: impl BufRead, printed: String) -> Result<Self, String> {
        let mut trace = Self { printed, instructions: HashMap::new(), ticks: Vec::new() };
        let mut tick: Option<Vec<u32>> = None;
        for line in log.lines() {
            let line = line.map_err(|error| format!("trace: {error}"))?;
            if let Some((address, instruction)) = translated(&line) {
                trace.instructions.insert(address, instruction);
            }
            let Some(address) = executed(&line) else { continue };
            let barrier = trace.instructions.get(&address).is_some_and(Instruction::is_barrier);
            match (&mut tick, barrier) {
                (None, true) => tick = Some(Vec::new()),
                (Some(addresses), _) => addresses.push(address),
                (None, false) => {}
            }
            if barrier && tick.as_ref().is_some_and(|addresses| !addresses.is_empty()) {
                trace.ticks.extend(tick.take());
            }
        }
        match tick {
            None => Ok(trace),
            Some(_) => Err("trace: the last tick has no end".into()),
        }
    }

    /// Returns the ticks, each without its barriers.
    ///
    /// # Errors
    /// An error is returned for an address that QEMU has not disassembled.
    pub fn ticks(&self) -> Result<Vec<Vec<Executed<'_>>>, String> {
        self.ticks.iter().map(|addresses| self.tick(addresses)).collect()
    }

    fn tick(&self, addresses: &[u32]) -> Result<Vec<Executed<'_>>, String> {
        let one = |pair: &[u32]| {
            let instruction = self.instructions.get(&pair[0]);
            let instruction = instruction.ok_or(format!("trace: nothing at {:#x}", pair[0]))?;
            Ok(Executed { instruction, branched: pair[0] + instruction.size != pair[1] })
        };
        addresses.windows(2).map(one).collect()
    }
}

impl Instruction {
    fn is_barrier(&self) -> bool {
        self.mnemonic == "dmb"
    }
}

/// Reads `0x00003c24:  b580       push     {r7, lr}`.
fn translated(line: &str) -> Option<(u32, Instruction)> {
    let (address, rest) = line.strip_prefix("0x")?.split_once(':')?;
    let address = u32::from_str_radix(address, 16).ok()?;
    let (codes, text) = rest.trim_start().split_once("  ")?;
    let mut words = text.trim().splitn(2, char::is_whitespace);
    let mnemonic = words.next()?.to_owned();
    let operands = words.next().unwrap_or_default().trim().to_owned();
    let size = 2 * codes.split_whitespace().count() as u32;
    Some((address, Instruction { size, mnemonic, operands }))
}

/// Reads the address in `Trace 0: 0x7f5264000240 [00800408/00003c24/00000110/ff000201] main`.
fn executed(line: &str) -> Option<u32> {
    let (_, state) = line.strip_prefix("Trace ")?.split_once('[')?;
    u32::from_str_radix(state.split('/').nth(1)?, 16).ok()
}
