//! The application: axes in a hard tick, drives, a host on a serial line, a report.
//!
//! | task | executor | what it does |
//! |---|---|---|
//! | [`tick::run`] | highest | steps every axis, hands the setpoints on |
//! | [`drive::send`], [`drive::receive`] | middle | frames to the drives, encoder angles from them |
//! | [`command::run`] | middle | requests of the host: carries out, hands down, answers |
//! | [`link::setpoints`] | middle | every setpoint, and what [`record`] takes, to the host |
//! | [`report::run`] | middle | a line a second over defmt |
//! | [`plan::run`] | lowest | plans moves and rows of paths, changes payloads |
//!
//! One board, chosen by a feature; everything it differs in is in its file.
#![no_std]
#![no_main]

mod arms;
#[cfg_attr(feature = "mps2", path = "boards/mps2.rs")]
#[cfg_attr(feature = "nucleo-g474re", path = "boards/nucleo_g474re.rs")]
#[cfg_attr(feature = "nucleo-g491re", path = "boards/nucleo_g491re.rs")]
mod board;
mod command;
mod drive;
mod link;
mod path;
mod plan;
mod record;
mod report;
mod shared;
mod tick;

use cortex_m_rt::entry;
use embassy_executor::{InterruptExecutor, SendSpawner, Spawner};
use stillbeam_firmware::stack;

/// The executors, each of an interrupt, the most urgent first; the board's handlers poll them. The
/// last is not the thread's, so that the processor sleeps for as long as nothing is pended.
static TICK: InterruptExecutor = InterruptExecutor::new();
/// Drives, link, requests, report.
static TASKS: InterruptExecutor = InterruptExecutor::new();
/// Plans.
static PLANS: InterruptExecutor = InterruptExecutor::new();

#[entry]
fn main() -> ! {
    stack::paint();
    if let Err(error) = shared::set_up() {
        defmt::panic!("axes.rs: {}", error);
    }
    let devices = board::set_up();
    let [tick, tasks, plans] = board::start([&TICK, &TASKS, &PLANS]);
    plans.spawn(plan::run().expect("one of each"));
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
    let board::Devices { link_reader, link_writer, bus_reader, bus_writer, sensors } = devices;
    record::set_up(sensors);
    link::open(link_writer).await;
    spawner.spawn(command::run(link_reader).expect("one of each"));
    spawner.spawn(drive::send(bus_writer).expect("one of each"));
    spawner.spawn(drive::receive(bus_reader).expect("one of each"));
    spawner.spawn(link::setpoints().expect("one of each"));
    spawner.spawn(report::run().expect("one of each"));
    board::more(spawner);
    tick.spawn(tick::run().expect("one of each"));
}
