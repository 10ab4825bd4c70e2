//! Crashes in the way that the environment variable `STILLBEAM_FAULT` names when this is built, to
//! test how the harness reports it.
#![no_std]
#![no_main]

use cortex_m_rt::entry;

stillbeam_firmware::exit_on_panic!();
stillbeam_firmware::unused_interrupts!();

#[entry]
fn main() -> ! {
    match option_env!("STILLBEAM_FAULT") {
        Some("hang") => loop {
            cortex_m::asm::nop();
        },
        Some("fault") => cortex_m::asm::udf(),
        _ => panic!("STILLBEAM_FAULT is hang, fault or panic"),
    }
}
