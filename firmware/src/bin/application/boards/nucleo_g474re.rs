//! NUCLEO-G474RE (STM32G474RET6, Cortex-M4F at 170 MHz). ST RM0440, memory map; the flash as one
//! bank. Builds; nobody has flashed it yet.
//!
//! FLASH : ORIGIN = 0x08000000, LENGTH = 512K
//! RAM : ORIGIN = 0x20000000, LENGTH = 96K
//!
//! LPUART1 (PA2, PA3: the ST-LINK's serial port, 921,600 baud) is the host; FDCAN1 (PA11 receive,
//! PA12 transmit, to a transceiver) the bus at 250 kbit/s, an ODrive's default. Report over RTT.

use cortex_m::peripheral::{DCB, DWT};
use defmt_rtt as _;
use embassy_executor::{InterruptExecutor, SendSpawner, Spawner};
use embassy_stm32::can::{self, CanConfigurator, CanRx, CanTx};
use embassy_stm32::interrupt::{self, InterruptExt, Priority};
use embassy_stm32::peripherals::{FDCAN1, LPUART1};
use embassy_stm32::rcc::{Pll, PllMul, PllPreDiv, PllQDiv, PllRDiv, PllSource, Sysclk, mux};
use embassy_stm32::usart::{self, BufferedUart, BufferedUartRx, BufferedUartTx};
use embassy_stm32::{Config, bind_interrupts, interrupt as handler};
use embedded_can::Frame;
use stillbeam::drive::{ClassicFrame, Sequence};

/// What [`cost`] counts.
pub const UNIT: &str = "cycles";
/// Counts a tick: 10 ms at 170 MHz.
pub const PERIOD: u32 = 1_700_000;

const BAUD: u32 = 921_600;
const CAN_BITRATE: u32 = 250_000;

/// The devices that the application uses.
pub struct Devices {
    pub link_reader: LinkReader,
    pub link_writer: LinkWriter,
    pub bus_reader: BusReader,
    pub bus_writer: BusWriter,
}

pub type LinkReader = BufferedUartRx<'static>;
pub type LinkWriter = BufferedUartTx<'static>;

bind_interrupts!(struct Irqs {
    LPUART1 => usart::BufferedInterruptHandler<LPUART1>;
    FDCAN1_IT0 => can::IT0InterruptHandler<FDCAN1>;
    FDCAN1_IT1 => can::IT1InterruptHandler<FDCAN1>;
});

/// Starts clocks and devices.
pub fn set_up() -> Devices {
    let p = embassy_stm32::init(clocks());
    // SAFETY: the only use of the core's debug units.
    let mut core = unsafe { cortex_m::Peripherals::steal() };
    DCB::enable_trace(&mut core.DCB);
    DWT::unlock();
    DWT::enable_cycle_counter(&mut core.DWT);

    let mut line = usart::Config::default();
    line.baudrate = BAUD;
    let [transmit, receive] = buffers();
    let uart = BufferedUart::new(p.LPUART1, p.PA3, p.PA2, transmit, receive, Irqs, line)
        .expect("a rate that the clock divides to");
    let (link_writer, link_reader) = uart.split();

    let mut bus = CanConfigurator::new(p.FDCAN1, p.PA11, p.PA12, Irqs);
    bus.set_bitrate(CAN_BITRATE);
    let filter = can::filter::StandardFilter::accept_all_into_fifo0();
    bus.properties().set_standard_filter(can::filter::StandardFilterSlot::_0, filter);
    let (writer, reader, _) = bus.into_normal_mode().split();
    Devices {
        link_reader,
        link_writer,
        bus_reader: BusReader { bus: reader },
        bus_writer: BusWriter { bus: writer },
    }
}

/// 16 MHz / 4 × 85 = 340 MHz: / 2 for the core, / 4 for CAN.
fn clocks() -> Config {
    let mut config = Config::default();
    config.rcc.hsi = true;
    config.rcc.pll = Some(Pll {
        source: PllSource::HSI,
        prediv: PllPreDiv::DIV4,
        mul: PllMul::MUL85,
        divp: None,
        divq: Some(PllQDiv::DIV4),
        divr: Some(PllRDiv::DIV2),
    });
    config.rcc.sys = Sysclk::PLL1_R;
    config.rcc.boost = true;
    config.rcc.mux.fdcansel = mux::Fdcansel::PLL1_Q;
    config
}

/// Buffers of the serial line: two ticks' setpoints out, a few requests in.
fn buffers() -> [&'static mut [u8]; 2] {
    static mut BUFFERS: [[u8; 256]; 2] = [[0; 256]; 2];
    // SAFETY: called once, by `set_up`.
    let [transmit, receive] = unsafe { &mut *(&raw mut BUFFERS) };
    [transmit, receive]
}

/// Starts the executors of the tick and of the tasks below it, on interrupts of devices that are not
/// used.
pub fn start(
    tick: &'static InterruptExecutor,
    tasks: &'static InterruptExecutor,
) -> (SendSpawner, SendSpawner) {
    interrupt::UART4.set_priority(Priority::P2);
    interrupt::UART5.set_priority(Priority::P15);
    (tick.start(interrupt::UART4), tasks.start(interrupt::UART5))
}

#[handler]
unsafe fn UART4() {
    // SAFETY: pended by the executor itself, after its start.
    unsafe { crate::TICK.on_interrupt() }
}

#[handler]
unsafe fn UART5() {
    // SAFETY: as above.
    unsafe { crate::TASKS.on_interrupt() }
}

/// Starts the tasks that only this board has: none.
pub fn more(_: Spawner) {}

/// Nothing is pended: sleep.
pub fn idle() {
    cortex_m::asm::wfi();
}

/// A free-running counter of cycles.
#[inline(always)]
pub fn counts() -> u32 {
    DWT::cycle_count()
}

/// Counts as cycles.
pub fn cost(counts: u32) -> u32 {
    counts
}

/// Counts as µs.
pub fn microseconds(counts: u32) -> u32 {
    counts / 170
}

/// A tick has been made: nobody waits for it here.
pub fn ticked() {}

/// The drives' own watchdogs stop them.
#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    if let Some(place) = info.location() {
        defmt::error!("panic at {=str}:{}", place.file(), place.line());
    }
    loop {
        cortex_m::asm::nop();
    }
}

/// CAN frames to the bus.
pub struct BusWriter {
    bus: CanTx<'static>,
}

impl BusWriter {
    /// Queues a frame; where three wait already, the last of them gives way. The sequence number
    /// has no place in the frame.
    pub async fn send(&mut self, frame: &ClassicFrame, _: Sequence) {
        let frame = if frame.is_remote_frame() {
            can::frame::Frame::new_remote(frame.id(), frame.dlc()).ok()
        } else {
            can::frame::Frame::new_data(frame.id(), frame.data()).ok()
        };
        if let Some(frame) = frame {
            self.bus.write(&frame).await;
        }
    }
}

/// CAN frames from the bus.
pub struct BusReader {
    bus: CanRx<'static>,
}

impl BusReader {
    /// The next frame.
    pub async fn receive(&mut self) -> ClassicFrame {
        loop {
            // Errors of the bus show as silence of a drive.
            if let Ok(envelope) = self.bus.read().await
                && let Some(frame) =
                    ClassicFrame::new(*envelope.frame.header().id(), envelope.frame.data())
            {
                return frame;
            }
        }
    }
}
