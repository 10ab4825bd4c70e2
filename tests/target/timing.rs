//! The published timings of the Cortex-M4F, on sequences whose cycles the manuals give.

use stillbeam_tests::timing::cycles;
use stillbeam_tests::trace::{Executed, Instruction};

/// Cycles of instructions without a branch that is taken.
fn of(lines: &[&str]) -> Result<u32, String> {
    let instructions: Vec<Instruction> = lines
        .iter()
        .map(|line| {
            let (mnemonic, operands) = line.split_once(' ').unwrap_or((line, ""));
            Instruction { size: 4, mnemonic: mnemonic.into(), operands: operands.into() }
        })
        .collect();
    let executed = |instruction| Executed { instruction, branched: false };
    cycles(&instructions.iter().map(executed).collect::<Vec<_>>())
}

/// The examples of "Load/store timings" in Arm's manuals of the Cortex-M3 and M4.
#[test]
fn loads_and_stores_overlap_as_the_manual_says() {
    for (lines, expected) in [
        (&["ldr r0, [r1]", "ldr r1, [r2]"][..], 3),
        (&["ldr r0, [r1, r2]", "str r0, [r3, #0x14]"], 3),
        (&["ldr r0, [r1, r2]", "str r1, [r3, r2]"], 3),
        (&["ldr r0, [r1, r5]", "ldr r1, [r2]", "ldr r2, [r3, #4]"], 4),
        // The address of the second is what the first loads.
        (&["ldr r0, [r1]", "ldr r1, [r0]"], 4),
        (&["add r1, r2", "ldr r0, [r1]"], 4),
        (&["add r4, r2", "ldr r0, [r1]"], 3),
        (&["pop {r4, r5, r6}", "ldrd r0, r1, [sp]", "push.w {r4, r8}"], 4 + 3 + 3),
    ] {
        assert_eq!(of(lines), Ok(expected), "{lines:?}");
    }
}

#[test]
fn floats_take_what_the_manual_says() {
    for (lines, expected) in [
        (&["vadd.f32 s0, s1, s2", "vmul.f32 s3, s4, s5"][..], 2),
        // The result of the first is used at once.
        (&["vadd.f32 s0, s1, s2", "vmul.f32 s3, s0, s5"], 3),
        (&["vmul.f32 s0, s1, s2", "vstr s0, [r0, #8]"], 1 + 1 + 2),
        (&["vfma.f32 s0, s1, s2", "vfma.f32 s0, s3, s4"], 3 + 1 + 3),
        (&["vdiv.f32 s0, s1, s2", "vsqrt.f32 s3, s4"], 28),
        (&["vldr s0, [r0]", "vldr d1, [r0, #8]"], 2 + 3),
        (&["vpush {d8, d9}", "vldmia r0, {s0, s1, s2}"], 5 + 4),
        (&["vcmp.f32 s0, s1", "vmrs apsr_nzcv, fpscr", "it mi", "vmovmi.f32 s0, s1"], 4),
    ] {
        assert_eq!(of(lines), Ok(expected), "{lines:?}");
    }
}

/// A branch fills the pipeline anew if it is taken; a division takes its most.
#[test]
fn branches_and_divisions_take_the_most_of_their_range() {
    let branch = Instruction { size: 2, mnemonic: "bne".into(), operands: "#0x100".into() };
    for (branched, expected) in [(false, 1), (true, 4)] {
        assert_eq!(cycles(&[Executed { instruction: &branch, branched }]), Ok(expected));
    }
    assert_eq!(of(&["udiv r0, r1, r2"]), Ok(12));
}

/// No instruction is counted whose timing is not known.
#[test]
fn an_unknown_instruction_is_an_error() {
    let error = of(&["smlad r0, r1, r2, r3"]).unwrap_err();
    assert!(error.contains("smlad"), "{error}");
}
