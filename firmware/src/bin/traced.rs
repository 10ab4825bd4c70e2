//! Ticks between barriers, for a trace of what is executed. The arms are prepared, so that the
//! trace holds little else. Prints a line `method,terms` for each arm, in their order.
#![no_std]
#![no_main]

use core::fmt::Write;
use core::hint::black_box;

use cortex_m::asm;
use cortex_m_rt::entry;
use semihosting::process::ExitCode;
use stillbeam::prepared::Prepared;
use stillbeam::{Generator, Move, Profile};
use stillbeam_firmware::output::Output;
use stillbeam_golden::methods::Method;

#[path = "../bench/tick.rs"]
mod tick;

// `TICK`, s, and `trace_all`, which hands every arm to `trace`. The build script writes them.
include!(concat!(env!("OUT_DIR"), "/traced.rs"));

stillbeam_firmware::exit_on_panic!();
stillbeam_firmware::unused_interrupts!();

/// Ticks of each arm, all of them inside of a move.
const TICKS: u32 = 20;

/// Ticks an arm in the middle of a move.
#[inline(never)]
fn trace<M: Method>(output: &mut Output, terms: &str, words: &[u32]) {
    let stepper = M::Stepper::load(words, TICK).expect("the build's own words");
    let mut made = Generator::<_, 16>::new(stepper, -0.3);
    let arm = made.as_mut().expect("an angle within range");
    let motion = Move::To { profile: Profile::Cubic, duration: 1.0, to: 0.9 };
    arm.push(&motion).expect("a gentle move");
    for _ in 0..20 {
        black_box(tick::tick(black_box(arm)));
    }
    for _ in 0..TICKS {
        asm::dmb();
        let setpoint = tick::tick(black_box(arm));
        asm::dmb();
        black_box(setpoint);
    }
    writeln!(output, "{},{terms}", M::ID).expect("the host takes the lines");
}

#[entry]
fn main() -> ! {
    let mut output = Output::open().expect("standard output by semihosting");
    trace_all(&mut output);
    output.flush().expect("the host takes the lines");
    ExitCode::SUCCESS.exit_process()
}
