//! Counts set-up and ticks as the firmware's program `bench` does, on RV32IMAC: QEMU's machine
//! `virt`.
#![no_std]
#![no_main]

use core::fmt::Write;

use semihosting::process;
use stopwatch::{Counter, Stopwatch};

#[path = "../../src/output.rs"]
mod output;
mod panic;
#[path = "../../src/bench/scenes.rs"]
mod scenes;
#[path = "../../src/stopwatch.rs"]
mod stopwatch;
#[path = "../../src/bench/tick.rs"]
mod tick;
#[path = "../../src/bench/ticks.rs"]
mod ticks;

/// Instructions retired, by the core's own counter. QEMU's counts the time of its clock in ns: it
/// must run with `-icount shift=10`, so that an instruction takes 1,024 of them.
struct Retired;

impl Counter for Retired {
    const UNIT: &'static str = "instructions";

    fn start() -> Self {
        Self
    }

    #[inline(always)]
    fn barrier() {
        riscv::asm::fence();
    }

    #[inline(always)]
    fn read(&self) -> u32 {
        (riscv::register::minstret::read64() >> 10) as u32
    }

    fn between(&self, from: u32, to: u32) -> u32 {
        to.wrapping_sub(from)
    }
}

/// Makes the counts.
#[riscv_rt::entry]
fn main() -> ! {
    let mut output = output::Output::open().expect("standard output by semihosting");
    let watch = Stopwatch::<Retired>::start();
    writeln!(output, "unit,{}", Retired::UNIT).expect("the host takes the lines");
    ticks::print(&watch, &mut output);
    output.flush().expect("the host takes the lines");
    process::exit(0)
}
