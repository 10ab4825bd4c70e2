//! Arm MPS2 with the AN386 image (Cortex-M4F at 25 MHz) as QEMU models it: `-M mps2-an386`.
//! Arm DAI 0386, memory map: ZBT SSRAM 1 at 0, SSRAM 2 and 3 at 0x2000_0000; CMSDK timers and UARTs.
//!
//! FLASH : ORIGIN = 0x00000000, LENGTH = 4M
//! RAM : ORIGIN = 0x20000000, LENGTH = 4M
//!
//! UART 0 is the host, UART 1 the bus: CAN frames as slcan lines, both ways.
//!
//! To be run with `-icount shift=6`: 64 ns an instruction, 1.6 cycles of 25 MHz, about what a
//! Cortex-M4F takes on average; a tick of 10 ms has 156,250 instructions. (The bench's shift of 10
//! counts more exactly and leaves a tick only 9,765.)
//!
//! **Lock-step.** If there is a host on QEMU's standard input, it grants every tick with two bytes:
//! how many bytes of UART 0 and of UART 1 have to be in before time goes on. Time stands still while
//! the board waits: a semihosting call takes no virtual time, and with both timers stopped and the
//! processor asleep QEMU's clock has nowhere to go.

use core::cell::RefCell;
use core::sync::atomic::{AtomicU32, Ordering};
use core::task::Waker;

use cortex_m::interrupt::InterruptNumber;
use cortex_m::peripheral::NVIC;
use defmt_semihosting as _;
use embassy_executor::{InterruptExecutor, SendSpawner, Spawner};
use embassy_futures::yield_now;
use embassy_sync::blocking_mutex::CriticalSectionMutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::pipe::Pipe;
use embassy_sync::signal::Signal;
use embassy_time_driver::Driver;
use embassy_time_queue_utils::Queue;
use semihosting::fs::File;
use semihosting::io::Read as _;
use stillbeam::drive::{ClassicFrame, Sequence};
use stillbeam_firmware::exit;
use stillbeam_protocol::slcan;

use crate::link::LINK;
use crate::tick::{TO_DRIVE, TO_HOST};

/// What [`cost`] counts.
pub const UNIT: &str = "instructions";
/// Counts a tick: 10 ms at 25 MHz.
pub const PERIOD: u32 = 250_000;

/// The devices that the application uses.
pub struct Devices {
    pub link_reader: LinkReader,
    pub link_writer: LinkWriter,
    pub bus_reader: BusReader,
    pub bus_writer: BusWriter,
}

pub type LinkReader = Receiver<0>;
pub type LinkWriter = Transmitter<0>;

/// Starts clocks and devices.
pub fn set_up() -> Devices {
    TIME.start();
    UARTS.iter().for_each(Uart::start);
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
    let line = slcan::Splitter::new();
    Devices {
        link_reader: Receiver,
        link_writer: Transmitter,
        bus_reader: BusReader { line },
        bus_writer: BusWriter,
    }
}

/// Starts the executors of the tick and of the tasks below it.
pub fn start(
    tick: &'static InterruptExecutor,
    tasks: &'static InterruptExecutor,
) -> (SendSpawner, SendSpawner) {
    (tick.start(Irq::Tick), tasks.start(Irq::Tasks))
}

/// Starts the tasks that only this board has.
pub fn more(spawner: Spawner) {
    spawner.spawn(keep_step().expect("one of each"));
}

/// Nothing is pended. Not asleep: where QEMU's clock leaps from a sleep to the next alarm, it leaps
/// twice as far now and then (7.2, `sleep=off`).
pub fn idle() {
    cortex_m::asm::nop();
}

/// A free-running counter, 40 ns.
#[inline(always)]
pub fn counts() -> u32 {
    !TIME.counter.value()
}

/// Counts as instructions: 1.6 each.
pub fn cost(counts: u32) -> u32 {
    counts * 5 / 8
}

/// Counts as µs.
pub fn microseconds(counts: u32) -> u32 {
    counts / 25
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

/// Of the tick, above the lines, below the alarm; of the tasks, below all.
const PRIORITIES: [(Irq, u8); 5] = [
    (Irq::Alarm, 0x20),
    (Irq::Tick, 0x40),
    (Irq::Link, 0x60),
    (Irq::Bus, 0x60),
    (Irq::Tasks, 0xe0),
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
    TIME.ring();
}

extern "C" fn on_tick() {
    // SAFETY: pended by the executor itself, after its start.
    unsafe { crate::TICK.on_interrupt() }
}

extern "C" fn on_tasks() {
    // SAFETY: as above.
    unsafe { crate::TASKS.on_interrupt() }
}

#[unsafe(link_section = ".vector_table.interrupts")]
#[unsafe(no_mangle)]
static __INTERRUPTS: [unsafe extern "C" fn(); 32] = {
    let mut table: [unsafe extern "C" fn(); 32] = [DefaultHandler; 32];
    table[Irq::Link as usize] = on_link;
    table[Irq::Bus as usize] = on_bus;
    table[Irq::Alarm as usize] = on_alarm;
    table[Irq::Tasks as usize] = on_tasks;
    table[Irq::Tick as usize] = on_tick;
    table
};

// Serial lines.

/// A CMSDK UART: registers DATA, STATE (full: bit 0 transmit, bit 1 receive), CTRL, INTCLEAR,
/// BAUDDIV.
struct Uart {
    base: usize,
    input: Pipe<CriticalSectionRawMutex, 128>,
    /// Bytes that have come in.
    taken: AtomicU32,
}

static UARTS: [Uart; 2] = [Uart::new(0x4000_4000), Uart::new(0x4000_5000)];

impl Uart {
    const fn new(base: usize) -> Self {
        Self { base, input: Pipe::new(), taken: AtomicU32::new(0) }
    }

    fn register(&self, index: usize) -> *mut u32 {
        (self.base as *mut u32).wrapping_add(index)
    }

    fn start(&self) {
        // SAFETY: registers of this device, which nothing else uses.
        unsafe {
            self.register(4).write_volatile(25);
            // Transmit, receive, interrupt on receive.
            self.register(2).write_volatile(0b1011);
        }
    }

    /// In the interrupt: empties the one-byte buffer.
    fn take(&self) {
        // SAFETY: as above.
        unsafe {
            self.register(3).write_volatile(0b10);
            while self.register(1).read_volatile() & 0b10 != 0 {
                let byte = self.register(0).read_volatile() as u8;
                // What finds the pipe full is lost, as on any line; the checksum will tell.
                let _ = self.input.try_write(&[byte]);
                self.taken.store(self.taken.load(Ordering::Relaxed) + 1, Ordering::Release);
            }
        }
    }

    async fn send(&self, bytes: &[u8]) {
        for &byte in bytes {
            // SAFETY: as above.
            while unsafe { self.register(1).read_volatile() } & 1 != 0 {
                yield_now().await;
            }
            // SAFETY: as above.
            unsafe { self.register(0).write_volatile(byte.into()) };
        }
    }
}

/// Bytes from a line.
pub struct Receiver<const UART: usize>;

/// Bytes to a line.
pub struct Transmitter<const UART: usize>;

impl<const UART: usize> embedded_io_async::ErrorType for Receiver<UART> {
    type Error = core::convert::Infallible;
}

impl<const UART: usize> embedded_io_async::Read for Receiver<UART> {
    async fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Self::Error> {
        Ok(UARTS[UART].input.read(bytes).await)
    }
}

impl<const UART: usize> embedded_io_async::ErrorType for Transmitter<UART> {
    type Error = core::convert::Infallible;
}

impl<const UART: usize> embedded_io_async::Write for Transmitter<UART> {
    async fn write(&mut self, bytes: &[u8]) -> Result<usize, Self::Error> {
        UARTS[UART].send(bytes).await;
        Ok(bytes.len())
    }

    async fn flush(&mut self) -> Result<(), Self::Error> {
        Ok(())
    }
}

/// CAN frames to the captured bus.
pub struct BusWriter;

impl BusWriter {
    /// Sends a frame, stamped with its tick's time.
    pub async fn send(&mut self, frame: &ClassicFrame, sequence: Sequence) {
        let milliseconds = u32::from(sequence.0) * 10 % 60_000;
        UARTS[1].send(slcan::encode(frame, milliseconds as u16).bytes()).await;
    }
}

/// CAN frames from the captured bus.
pub struct BusReader {
    line: slcan::Splitter,
}

impl BusReader {
    /// The next frame; lines that are none are dropped.
    pub async fn receive(&mut self) -> ClassicFrame {
        loop {
            let mut byte = [0];
            UARTS[1].input.read(&mut byte).await;
            if let Some((frame, _)) = self.line.push(byte[0]).and_then(slcan::decode) {
                return frame;
            }
        }
    }
}

// Time.

/// A CMSDK timer: registers CTRL, VALUE (counts down at 25 MHz), RELOAD, INTCLEAR.
struct Timer {
    base: usize,
}

impl Timer {
    fn register(&self, index: usize) -> *mut u32 {
        (self.base as *mut u32).wrapping_add(index)
    }

    #[inline(always)]
    fn value(&self) -> u32 {
        // SAFETY: reading a counter.
        unsafe { self.register(1).read_volatile() }
    }

    /// Counts `from` down, again and again; `control` is 1, or 0b1001 with interrupt.
    fn run(&self, from: u32, control: u32) {
        // SAFETY: registers of this device, used under a critical section or before anything runs.
        unsafe {
            self.register(0).write_volatile(0);
            self.register(2).write_volatile(from);
            self.register(1).write_volatile(from);
            self.register(0).write_volatile(control);
        }
    }

    /// Goes on from where it stands, or stops there.
    fn control(&self, control: u32) {
        // SAFETY: as above.
        unsafe { self.register(0).write_volatile(control) }
    }

    fn acknowledge(&self) {
        // SAFETY: as above.
        unsafe { self.register(3).write_volatile(1) }
    }
}

/// Timer 1 runs free and is extended to 64 bits, timer 0 is the alarm.
struct Time {
    alarm: Timer,
    counter: Timer,
    state: CriticalSectionMutex<RefCell<State>>,
}

struct State {
    queue: Queue,
    high: u32,
    low: u32,
}

/// Counts a µs, the unit of embassy-time here.
const PER_MICROSECOND: u64 = 25;
/// Longest alarm, half of what the counter can tell; whoever asked for a later one is asked again.
const LONGEST: u64 = 1 << 31;

embassy_time_driver::time_driver_impl!(static TIME: Time = Time {
    alarm: Timer { base: 0x4000_0000 },
    counter: Timer { base: 0x4000_1000 },
    state: CriticalSectionMutex::new(RefCell::new(State { queue: Queue::new(), high: 0, low: 0 })),
});

impl Time {
    fn start(&self) {
        self.counter.run(u32::MAX, 1);
    }

    /// Asked at least every 85 s, half the counter's range.
    fn counts(&self, state: &mut State) -> u64 {
        let low = !self.counter.value();
        state.high += u32::from(low < state.low);
        state.low = low;
        u64::from(state.high) << 32 | u64::from(low)
    }

    /// Wakes who is due and sets the alarm for who is next.
    fn set(&self, state: &mut State) {
        let now = self.counts(state);
        let next = state.queue.next_expiration(now / PER_MICROSECOND);
        let wait = next.saturating_mul(PER_MICROSECOND).saturating_sub(now).clamp(1, LONGEST);
        self.alarm.run(wait as u32, 0b1001);
    }

    fn ring(&self) {
        self.state.lock(|state| {
            self.alarm.control(0);
            self.alarm.acknowledge();
            self.set(&mut state.borrow_mut());
        });
    }

    /// Time stands still.
    fn hold(&self) {
        self.alarm.control(0);
        self.counter.control(0);
    }

    /// Time goes on.
    fn go_on(&self) {
        self.counter.control(1);
        self.state.lock(|state| self.set(&mut state.borrow_mut()));
    }
}

impl Driver for Time {
    fn now(&self) -> u64 {
        self.state.lock(|state| self.counts(&mut state.borrow_mut())) / PER_MICROSECOND
    }

    fn schedule_wake(&self, at: u64, waker: &Waker) {
        self.state.lock(|state| {
            let state = &mut *state.borrow_mut();
            if state.queue.schedule_wake(at, waker) {
                self.set(state);
            }
        });
    }
}

// Lock-step.

static TICKED: Signal<CriticalSectionRawMutex, ()> = Signal::new();

/// A tick has been made.
pub fn ticked() {
    TICKED.signal(());
}

/// Holds time after every tick, once its setpoints are out, until the host grants the next one.
#[embassy_executor::task]
async fn keep_step() {
    let Ok(mut host) = File::open(c"/dev/stdin") else { return };
    let mut granted = [0; 2];
    let mut first = true;
    let mut awaited = [0u32; 2];
    loop {
        TICKED.wait().await;
        while !(TO_DRIVE.is_empty() && TO_HOST.is_empty() && LINK.try_lock().is_ok()) {
            yield_now().await;
        }
        match host.read_exact(&mut granted) {
            Ok(()) => first = false,
            // Nobody there: run free. Gone: over.
            Err(_) if first => return,
            Err(_) => semihosting::process::exit(0),
        }
        for (awaited, granted) in awaited.iter_mut().zip(granted) {
            *awaited += u32::from(granted);
        }
        TIME.hold();
        let all_in =
            || UARTS.iter().zip(awaited).all(|(u, n)| u.taken.load(Ordering::Acquire) >= n);
        while !all_in() {
            // Masked, so that no byte slips in between the look and the sleep; it wakes all the same.
            cortex_m::interrupt::free(|_| {
                if !all_in() {
                    cortex_m::asm::wfi();
                }
            });
        }
        TIME.go_on();
    }
}
