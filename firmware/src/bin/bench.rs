//! Counts set-up and every tick of every method, and prints the least and the worst of each path:
//! lines `tick,id,method,size,quality,skip,least,worst,setup` and
//! `function,name,least,worst,error`.
#![no_std]
#![no_main]

use core::fmt::Write;

use cortex_m_rt::entry;
use semihosting::process::ExitCode;
use stillbeam_firmware::counter::Chosen;
use stillbeam_firmware::output::Output;
use stillbeam_firmware::stopwatch::{self, Counter, Stopwatch};

// Plans and changes are counted with an FPU only.
#[cfg(target_abi = "eabihf")]
#[path = "../bench/changes.rs"]
mod changes;
#[path = "../bench/functions.rs"]
mod functions;
#[cfg(target_abi = "eabihf")]
#[path = "../bench/plans.rs"]
mod plans;
#[path = "../bench/scenes.rs"]
mod scenes;
#[path = "../bench/tick.rs"]
mod tick;
#[path = "../bench/ticks.rs"]
mod ticks;

stillbeam_firmware::exit_on_panic!();
stillbeam_firmware::unused_interrupts!();

#[entry]
fn main() -> ! {
    let mut output = Output::open().expect("standard output by semihosting");
    let watch = Stopwatch::<Chosen>::start();
    writeln!(output, "unit,{}", Chosen::UNIT).expect("the host takes the lines");
    ticks::print(&watch, &mut output);
    #[cfg(target_abi = "eabihf")]
    {
        plans::print(&watch, &mut output);
        changes::print(&watch, &mut output);
    }
    functions::print(&watch, &mut output);
    output.flush().expect("the host takes the lines");
    ExitCode::SUCCESS.exit_process()
}
