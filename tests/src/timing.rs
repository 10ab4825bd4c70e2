//! Cycles of a Cortex-M4F by its published timings, for memory without wait states.
//!
//! Source: Arm DDI 0439, Cortex-M4 Technical Reference Manual, "Instruction set summary" and "FPU
//! instruction set". Where it gives a range, the most is taken: three cycles to fill the pipeline
//! behind a branch that is taken, and twelve to divide integers. An instruction whose condition
//! does not hold is taken to be executed.

use crate::trace::{Executed, Instruction};

/// Cycles to fill the pipeline again.
const REFILL: u32 = 3;

/// The use that an instruction makes of the pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Integer arithmetic and moves.
    Data,
    /// Instructions that write no register: comparisons, conditions of the next instructions.
    Compare,
    Divide,
    Branch,
    Load,
    Store,
    /// Two registers or more.
    LoadMany,
    StoreMany,
    /// Float arithmetic: its result is there a cycle late.
    Float,
    FloatMultiplyAdd,
    FloatDivide,
    /// Moves, comparisons, signs.
    FloatMove,
    FloatLoad,
    FloatStore,
    FloatLoadMany,
    FloatStoreMany,
}

/// Mnemonics without condition and types. Those of `Data` may set flags, with an `s` behind them.
const KINDS: &[(Kind, &[&str])] = &[
    (
        Kind::Data,
        &[
            "adc", "add", "addw", "adr", "and", "asr", "bfc", "bfi", "bic", "clz", "eor", "lsl",
            "lsr", "mla", "mls", "mov", "movt", "movw", "mul", "mvn", "orn", "orr", "rbit", "rev",
            "ror", "rsb", "sbc", "sbfx", "smlal", "smull", "ssat", "sub", "subw", "sxtb", "sxth",
            "ubfx", "umlal", "umull", "usat", "uxtb", "uxth",
        ],
    ),
    (Kind::Compare, &["cmn", "cmp", "nop", "teq", "tst"]),
    (Kind::Divide, &["sdiv", "udiv"]),
    (Kind::Branch, &["b", "bl", "blx", "bx", "cbnz", "cbz"]),
    (Kind::Load, &["ldr", "ldrb", "ldrh", "ldrsb", "ldrsh"]),
    (Kind::Store, &["str", "strb", "strh"]),
    (Kind::LoadMany, &["ldm", "ldmdb", "ldrd", "pop"]),
    (Kind::StoreMany, &["push", "stm", "stmdb", "strd"]),
    (Kind::Float, &["vadd", "vcvt", "vcvtr", "vmul", "vnmul", "vsub"]),
    (Kind::FloatMultiplyAdd, &["vfma", "vfms", "vfnma", "vfnms", "vmla", "vmls", "vnmla", "vnmls"]),
    (Kind::FloatDivide, &["vdiv", "vsqrt"]),
    (Kind::FloatMove, &["vabs", "vcmp", "vcmpe", "vmov", "vmrs", "vneg"]),
    (Kind::FloatLoad, &["vldr"]),
    (Kind::FloatStore, &["vstr"]),
    (Kind::FloatLoadMany, &["vldmia", "vpop"]),
    (Kind::FloatStoreMany, &["vpush", "vstmdb", "vstmia"]),
];

const CONDITIONS: [&str; 16] = [
    "eq", "ne", "hs", "lo", "mi", "pl", "vs", "vc", "hi", "ls", "ge", "lt", "gt", "le", "cs", "cc",
];

/// Returns the cycles of instructions that are executed one after the other.
///
/// # Errors
/// An error is returned for an instruction whose timing is not known here.
pub fn cycles(executed: &[Executed<'_>]) -> Result<u32, String> {
    let mut sum = 0;
    let mut before: Option<(Kind, &Instruction)> = None;
    for Executed { instruction, branched } in executed {
        let kind = kind(instruction)?;
        sum += own(kind, instruction);
        if *branched {
            sum += REFILL;
        }
        if let Some((earlier, producer)) = before {
            sum += stall(earlier, producer, kind, instruction);
            sum -= overlap(earlier, producer, kind, instruction);
        }
        before = Some((kind, instruction));
    }
    Ok(sum)
}

fn kind(instruction: &Instruction) -> Result<Kind, String> {
    let name = instruction.mnemonic.split('.').next().unwrap_or_default();
    // An `it` alone, with up to three more conditions in its name.
    if name.starts_with("it") && name[1..].chars().all(|letter| "te".contains(letter)) {
        return Ok(Kind::Compare);
    }
    let known = |name: &str| KINDS.iter().find(|(_, names)| names.contains(&name)).map(|k| k.0);
    let plain = |name: &str| {
        let flags = || name.strip_suffix('s').and_then(known).filter(|kind| *kind == Kind::Data);
        known(name).or_else(flags)
    };
    let bare = || CONDITIONS.iter().find_map(|condition| name.strip_suffix(condition));
    plain(name)
        .or_else(|| bare().and_then(plain))
        .ok_or_else(|| format!("{} {}: no timing", instruction.mnemonic, instruction.operands))
}

/// Returns the cycles of an instruction that waits for nothing.
fn own(kind: Kind, instruction: &Instruction) -> u32 {
    let wide = |register: &str| register.starts_with('d');
    match kind {
        Kind::Data | Kind::Compare | Kind::Branch | Kind::Float => 1,
        // A double register or two are moved in two steps.
        Kind::FloatMove => {
            let operands = operands(instruction);
            let cores = operands.iter().filter(|operand| operand.starts_with('r')).count();
            if cores > 1 { 2 } else { 1 }
        }
        Kind::Divide => 12,
        Kind::Load => 2,
        // The store itself is made beside the next instruction, if no register is added first.
        Kind::Store => {
            if adds_register(instruction) {
                2
            } else {
                1
            }
        }
        Kind::LoadMany | Kind::StoreMany => 1 + listed(instruction),
        Kind::FloatMultiplyAdd => 3,
        Kind::FloatDivide => 14,
        Kind::FloatLoad | Kind::FloatStore => {
            if wide(&instruction.operands) {
                3
            } else {
                2
            }
        }
        Kind::FloatLoadMany | Kind::FloatStoreMany => {
            let registers = operands(instruction);
            let words = registers.iter().map(|register| match register.chars().next() {
                Some('d') => 2,
                Some('s') if *register != "sp" => 1,
                _ => 0,
            });
            1 + words.sum::<u32>()
        }
    }
}

/// Returns the cycles for which an instruction waits for the one before it.
fn stall(earlier: Kind, producer: &Instruction, kind: Kind, consumer: &Instruction) -> u32 {
    let result = operands(producer).into_iter().next().unwrap_or_default();
    if matches!(earlier, Kind::Float | Kind::FloatMultiplyAdd | Kind::FloatDivide) {
        return u32::from(reads(kind, consumer).contains(&result));
    }
    u32::from(
        earlier == Kind::Data && accesses_memory(kind) && addresses(consumer).contains(&result),
    )
}

/// Returns the cycles of a load or store that begins while the load before it ends.
fn overlap(earlier: Kind, producer: &Instruction, kind: Kind, consumer: &Instruction) -> u32 {
    let loaded = operands(producer).into_iter().next().unwrap_or_default();
    let follows = match kind {
        Kind::Load => true,
        Kind::Store => adds_register(consumer),
        _ => false,
    };
    u32::from(earlier == Kind::Load && follows && !addresses(consumer).contains(&loaded))
}

fn accesses_memory(kind: Kind) -> bool {
    matches!(kind, Kind::Load | Kind::Store | Kind::FloatLoad | Kind::FloatStore)
}

/// Returns the registers that an instruction of floats or of memory reads, by their names.
fn reads(kind: Kind, instruction: &Instruction) -> Vec<&str> {
    let all = operands(instruction);
    let first_is_read =
        matches!(kind, Kind::FloatMultiplyAdd | Kind::FloatStore | Kind::FloatStoreMany)
            || instruction.mnemonic.starts_with("vcmp");
    all.into_iter().skip(usize::from(!first_is_read)).collect()
}

/// Returns the names and numbers in the operands, one by one.
fn operands(instruction: &Instruction) -> Vec<&str> {
    words(&instruction.operands)
}

/// Returns the parts of the address: what stands between brackets.
fn addresses(instruction: &Instruction) -> Vec<&str> {
    words(instruction.operands.split_once('[').map_or("", |(_, inside)| inside))
}

fn words(text: &str) -> Vec<&str> {
    let separate = |letter: char| !letter.is_ascii_alphanumeric();
    text.split(separate).filter(|word| !word.is_empty()).collect()
}

/// True if a register is added to the address.
fn adds_register(instruction: &Instruction) -> bool {
    addresses(instruction).get(1).is_some_and(|part| part.starts_with('r'))
}

/// Returns the number of core registers that are moved.
fn listed(instruction: &Instruction) -> u32 {
    match instruction.operands.split_once('{') {
        Some((_, list)) => list.split(',').count() as u32,
        // `ldrd` and `strd` name two.
        None => 2,
    }
}
