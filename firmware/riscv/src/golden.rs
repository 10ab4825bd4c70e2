//! Steps every scene with a few methods and streams every setpoint's bits to the host, as
//! the firmware's program `golden` does, on RV32IMAC: QEMU's machine `virt`.
#![no_std]
#![no_main]

use semihosting::process;
use stillbeam_golden::{record, run_own};

#[path = "../../src/output.rs"]
mod output;
mod panic;

/// Makes the run.
#[riscv_rt::entry]
fn main() -> ! {
    let mut output = output::Output::open().expect("standard output by semihosting");
    run_own(&mut |case, tick, setpoint| {
        let record = record::encode(record::stamp(case.index, tick), setpoint);
        output.write(&record).expect("the host takes the stream");
    })
    .expect("every embedded scene is accepted");
    output.flush().expect("the host takes the stream");
    process::exit(0)
}
