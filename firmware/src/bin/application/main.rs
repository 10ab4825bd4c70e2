//! The application: axes in a hard tick, drives, a host on a serial line, a report.
//!
//! | task | executor | what it does |
//! |---|---|---|
//! | [`tick::run`] | highest | steps every axis, hands the setpoints on |
//! | [`drive::send`], [`drive::receive`] | lowest | frames to the drives, encoder angles from them |
//! | [`command::run`] | lowest | requests of the host: plans, sets up, answers |
//! | [`link::setpoints`] | lowest | every setpoint to the host |
//! | [`report::run`] | lowest | a line a second over defmt |
//!
//! One board, chosen by a feature; everything it differs in is in its file.
#![no_std]
#![no_main]

mod axes;
#[cfg_attr(feature = "mps2", path = "boards/mps2.rs")]
#[cfg_attr(feature = "nucleo-g474re", path = "boards/nucleo_g474re.rs")]
mod board;
mod command;
mod drive;
mod link;
mod report;
mod shared;
mod tick;

use cortex_m_rt::entry;
use embassy_executor::{InterruptExecutor, SendSpawner, Spawner};
use stillbeam_firmware::stack;

/// The tick's executor, above the others; the board's interrupt polls it.
static TICK: InterruptExecutor = InterruptExecutor::new();

/// Everybody else's executor, at the lowest priority. An interrupt too, and not the thread, so that
/// the processor sleeps for as long as nothing is pended.
static TASKS: InterruptExecutor = InterruptExecutor::new();

#[entry]
fn main() -> ! {
    stack::paint();
    if let Err(error) = shared::set_up() {
        defmt::panic!("axes.rs: {}", error);
    }
    let devices = board::set_up();
    let (tick, tasks) = board::start(&TICK, &TASKS);
    tasks.spawn(started(devices, tick).expect("one of each"));
    loop {
        board::idle();
    }
}

/// Starts the tasks, the tick last: by then everyone it hands setpoints to is there.
#[embassy_executor::task]
async fn started(devices: board::Devices, tick: SendSpawner) {
    // SAFETY: this is a task, and it does not outlive its executor.
    let spawner = unsafe { Spawner::for_current_executor().await };
    let board::Devices { link_reader, link_writer, bus_reader, bus_writer } = devices;
    link::open(link_writer).await;
    spawner.spawn(command::run(link_reader).expect("one of each"));
    spawner.spawn(drive::send(bus_writer).expect("one of each"));
    spawner.spawn(drive::receive(bus_reader).expect("one of each"));
    spawner.spawn(link::setpoints().expect("one of each"));
    spawner.spawn(report::run().expect("one of each"));
    board::more(spawner);
    tick.spawn(tick::run().expect("one of each"));
}
