//! Arm MPS2 with the AN386 image (Cortex-M4F at 25 MHz) as QEMU models it: `-M mps2-an386`. Arm DAI
//! 0386, memory map: ZBT SSRAM 1 at 0, SSRAM 2 and 3 at 0x2000_0000; CMSDK timers and UARTs.
//!
//! FLASH : ORIGIN = 0x00000000, LENGTH = 4M
//! RAM : ORIGIN = 0x20000000, LENGTH = 4M
//!
//! UART 0 is the host, UART 1 the bus: CAN frames as slcan lines, both ways.
//!
//! To be run with `-icount shift=6`: 64 ns an instruction, 1.6 cycles of 25 MHz, about what a
//! Cortex-M4F takes on average; 10 ms have 156,250 instructions. (The bench's shift of 10 counts
//! more exactly and leaves 10 ms only 9,765.)
//!
//! **Lock-step.** If there is a host on QEMU's standard input, it grants every tick with four
//! bytes: how many bytes of UART 0 and of UART 1 have to be in before time goes on, and for how
//! many µs from the last tick the board is kept from running, which shows what late and missed
//! ticks do. Time stands still while the board waits: a semihosting call takes no virtual time, and
//! with both timers stopped and the processor asleep QEMU's clock has nowhere to go.

#[path = "mps2/lock_step.rs"]
mod lock_step;
#[path = "mps2/serial.rs"]
mod serial;
#[path = "mps2/time.rs"]
mod time;

use cortex_m::interrupt::InterruptNumber;
use cortex_m::peripheral::NVIC;
use defmt_semihosting as _;
use embassy_executor::{InterruptExecutor, SendSpawner, Spawner};
pub use lock_step::ticked;
pub use serial::{BusReader, BusWriter};
use serial::{Receiver, Transmitter, UARTS};
use stillbeam_firmware::exit;
use stillbeam_wiring::{StandIn, Truth};
use time::time;

/// Unit of [`cost`].
pub const UNIT: &str = "instructions";
/// Rate of [`counts`].
pub const COUNTS_PER_SECOND: u32 = 25_000_000;

/// There are no arms: the sensors show modes that are computed.
pub type Sensors = StandIn<{ Truth::ARMS.len() }>;

/// The devices that the application uses.
pub struct Devices {
    pub link_reader: LinkReader,
    pub link_writer: LinkWriter,
    pub bus_reader: BusReader,
    pub bus_writer: BusWriter,
    pub sensors: Sensors,
}

pub type LinkReader = Receiver<0>;
pub type LinkWriter = Transmitter<0>;

/// Starts clocks and devices.
pub fn set_up() -> Devices {
    time().start();
    UARTS.iter().for_each(|uart| uart.start());
    // SAFETY: the only use of the interrupt controller, before anything depends on priorities.
    let mut nvic = unsafe { cortex_m::Peripherals::steal() }.NVIC;
    for (irq, priority) in PRIORITIES {
        // SAFETY: as above; the executors' are unmasked by themselves.
        unsafe { nvic.set_priority(irq, priority) };
    }
    for irq in [Irq::Alarm, Irq::Link, Irq::Bus] {
        // SAFETY: as above.
        unsafe { NVIC::unmask(irq) };
    }
    Devices {
        link_reader: Receiver,
        link_writer: Transmitter,
        bus_reader: BusReader::new(),
        bus_writer: BusWriter,
        sensors: StandIn::new(Truth::ARMS),
    }
}

/// Starts the executors, the most urgent first.
pub fn start([tick, tasks, plans]: [&'static InterruptExecutor; 3]) -> [SendSpawner; 3] {
    [tick.start(Irq::Tick), tasks.start(Irq::Tasks), plans.start(Irq::Plans)]
}

/// Starts the tasks that only this board has.
pub fn more(spawner: Spawner) {
    spawner.spawn(lock_step::keep_step().expect("one of each"));
}

/// Nothing is pended. Not asleep: where QEMU's clock leaps from a sleep to the next alarm, it leaps
/// twice as far now and then (7.2, `sleep=off`).
pub fn idle() {
    cortex_m::asm::nop();
}

/// A free-running counter, 40 ns.
#[inline(always)]
pub fn counts() -> u32 {
    time().reading()
}

/// Counts as instructions: 1.6 each.
pub fn cost(counts: u32) -> u32 {
    counts * 5 / 8
}

#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    // The place alone: formatted messages would take some 4 KiB.
    if let Some(place) = info.location() {
        defmt::error!("panic at {=str}:{}", place.file(), place.line());
    }
    semihosting::process::exit(exit::PANICKED)
}

// Interrupts.

#[derive(Clone, Copy)]
enum Irq {
    Link = 0,
    Bus = 2,
    Alarm = 8,
    /// Of no device.
    Plans = 29,
    /// Of no device.
    Tasks = 30,
    /// Of no device.
    Tick = 31,
}

// SAFETY: numbers of the AN386, below 32.
unsafe impl InterruptNumber for Irq {
    fn number(self) -> u16 {
        self as u16
    }
}

/// Priorities of the interrupts: the tick is above the lines and below the alarm, the tasks are
/// below those, the plans below all.
const PRIORITIES: [(Irq, u8); 6] = [
    (Irq::Alarm, 0x20),
    (Irq::Tick, 0x40),
    (Irq::Link, 0x60),
    (Irq::Bus, 0x60),
    (Irq::Tasks, 0xc0),
    (Irq::Plans, 0xe0),
];

unsafe extern "C" {
    fn DefaultHandler();
}

extern "C" fn on_link() {
    UARTS[0].take();
}

extern "C" fn on_bus() {
    UARTS[1].take();
}

extern "C" fn on_alarm() {
    time().ring();
}

extern "C" fn on_tick() {
    // SAFETY: pended by the executor itself, after its start.
    unsafe { crate::TICK.on_interrupt() }
}

extern "C" fn on_tasks() {
    // SAFETY: as above.
    unsafe { crate::TASKS.on_interrupt() }
}

extern "C" fn on_plans() {
    // SAFETY: as above.
    unsafe { crate::PLANS.on_interrupt() }
}

#[unsafe(link_section = ".vector_table.interrupts")]
#[unsafe(no_mangle)]
static __INTERRUPTS: [unsafe extern "C" fn(); 32] = {
    let mut table: [unsafe extern "C" fn(); 32] = [DefaultHandler; 32];
    table[Irq::Link as usize] = on_link;
    table[Irq::Bus as usize] = on_bus;
    table[Irq::Alarm as usize] = on_alarm;
    table[Irq::Plans as usize] = on_plans;
    table[Irq::Tasks as usize] = on_tasks;
    table[Irq::Tick as usize] = on_tick;
    table
};
