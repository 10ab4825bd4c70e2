//! Steps every scene with every method, or without an FPU with a few, and streams every
//! setpoint's bits to the host.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use semihosting::process::ExitCode;
use stillbeam_firmware::output::Output;
use stillbeam_golden::{record, run_own};

stillbeam_firmware::exit_on_panic!();
stillbeam_firmware::unused_interrupts!();

#[entry]
fn main() -> ! {
    let mut output = Output::open().expect("standard output by semihosting");
    run_own(&mut |case, tick, setpoint| {
        let record = record::encode(record::stamp(case.index, tick), setpoint);
        output.write(&record).expect("the host takes the stream");
    })
    .expect("every embedded scene is accepted");
    output.flush().expect("the host takes the stream");
    ExitCode::SUCCESS.exit_process()
}
