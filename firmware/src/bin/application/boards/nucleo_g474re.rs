//! NUCLEO-G474RE (STM32G474RET6, Cortex-M4F at 170 MHz). ST RM0440, memory map; the flash as one
//! bank. Builds; nobody has flashed it yet.
//!
//! FLASH : ORIGIN = 0x08000000, LENGTH = 512K
//! RAM : ORIGIN = 0x20000000, LENGTH = 96K
//!
//! LPUART1 (PA2, PA3: the ST-LINK's serial port, 921,600 baud) is the host; FDCAN1 (PA11 receive,
//! PA12 transmit, to a transceiver) the bus at 250 kbit/s, an ODrive's default; ADC1 (PA0, PA1) the
//! strain gauges, amplified. Report over RTT.
//!
//! Everything counts on the board's crystal X3, 24 MHz: CAN tolerates some 0.5 % between two nodes,
//! which the processor's own oscillator may be off by alone.

use core::cell::RefCell;

use cortex_m::peripheral::{DCB, DWT};
use defmt_rtt as _;
use embassy_executor::{InterruptExecutor, SendSpawner, Spawner};
use embassy_stm32::adc::{Adc, AdcConfig, SampleTime};
use embassy_stm32::can::config::TxBufferMode;
use embassy_stm32::can::{self, CanConfigurator, CanRx, CanTx};
use embassy_stm32::interrupt::{self, InterruptExt, Priority};
use embassy_stm32::peripherals::{ADC1, FDCAN1, IWDG, LPUART1, PA0, PA1};
use embassy_stm32::rcc::{Hse, HseMode, Pll, PllMul, PllPreDiv, PllRDiv, PllSource, Sysclk, mux};
use embassy_stm32::time::Hertz;
use embassy_stm32::usart::{self, BufferedUart, BufferedUartRx, BufferedUartTx};
use embassy_stm32::wdg::IndependentWatchdog;
use embassy_stm32::{Config, Peri, bind_interrupts, interrupt as handler};
use embassy_sync::blocking_mutex::CriticalSectionMutex;
use embedded_can::Frame;
use stillbeam::Angle;
use stillbeam::axis::Sequence;
use stillbeam::drive::ClassicFrame;
use stillbeam_wiring::Sensor;

use crate::tick::MICROSECONDS;

/// Unit of [`cost`].
pub const UNIT: &str = "cycles";
/// Rate of [`counts`]: the core's clock.
pub const COUNTS_PER_SECOND: u32 = 170_000_000;

const BAUD: u32 = 921_600;
/// 24 MHz make 6 × 16 quanta a bit at 250 kbit/s, 3 × 16 at 500, 3 × 8 at 1 Mbit/s, sampled at 87.5
/// %.
const CAN_BITRATE: u32 = 250_000;

/// Without a tick for this long the board begins anew, drives off. The oscillator that it counts by
/// is off by up to 10 %.
const WATCHDOG_MICROSECONDS: u32 = 100_000;
const _: () = assert!(2 * MICROSECONDS <= WATCHDOG_MICROSECONDS, "the watchdog outlasts two ticks");

static WATCHDOG: CriticalSectionMutex<RefCell<Option<IndependentWatchdog<'static, IWDG>>>> =
    CriticalSectionMutex::new(RefCell::new(None));

/// The devices that the application uses.
pub struct Devices {
    pub link_reader: LinkReader,
    pub link_writer: LinkWriter,
    pub bus_reader: BusReader,
    pub bus_writer: BusWriter,
    pub sensors: Sensors,
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
    // In the order in which they are sent: a priority queue may swap frames of one drive.
    let config = bus.config().set_tx_buffer_mode(TxBufferMode::Fifo);
    bus.set_config(config);
    let filter = can::filter::StandardFilter::accept_all_into_fifo0();
    bus.properties().set_standard_filter(can::filter::StandardFilterSlot::_0, filter);
    let (writer, reader, _) = bus.into_normal_mode().split();
    // Below the tick. The time driver's alarm stays above it, at P0.
    interrupt::LPUART1.set_priority(Priority::P6);
    interrupt::FDCAN1_IT0.set_priority(Priority::P6);
    interrupt::FDCAN1_IT1.set_priority(Priority::P6);
    let mut watchdog = IndependentWatchdog::new(p.IWDG, WATCHDOG_MICROSECONDS);
    watchdog.unleash();
    WATCHDOG.lock(|slot| *slot.borrow_mut() = Some(watchdog));
    Devices {
        link_reader,
        link_writer,
        bus_reader: BusReader { bus: reader },
        bus_writer: BusWriter { bus: writer },
        sensors: Sensors::new(p.ADC1, p.PA0, p.PA1),
    }
}

/// 24 MHz / 6 × 85 = 340 MHz, / 2 for the core; 24 MHz as they are for CAN.
fn clocks() -> Config {
    let mut config = Config::default();
    config.rcc.hsi = false;
    config.rcc.hse = Some(Hse { freq: Hertz::mhz(24), mode: HseMode::Oscillator });
    config.rcc.pll = Some(Pll {
        source: PllSource::HSE,
        prediv: PllPreDiv::DIV6,
        mul: PllMul::MUL85,
        divp: None,
        divq: None,
        divr: Some(PllRDiv::DIV2),
    });
    config.rcc.sys = Sysclk::PLL1_R;
    config.rcc.boost = true;
    config.rcc.mux.fdcansel = mux::Fdcansel::HSE;
    config.rcc.mux.adc12sel = mux::Adcsel::SYS;
    config
}

/// Buffers of the serial line: two ticks' setpoints out, a few requests in.
fn buffers() -> [&'static mut [u8]; 2] {
    static mut BUFFERS: [[u8; 256]; 2] = [[0; 256]; 2];
    let both = &raw mut BUFFERS;
    // SAFETY: called once, by `set_up`.
    let [transmit, receive] = unsafe { &mut *both };
    [transmit, receive]
}

/// Starts the executors, the most urgent first, on interrupts of devices that are not used.
pub fn start([tick, tasks, plans]: [&'static InterruptExecutor; 3]) -> [SendSpawner; 3] {
    interrupt::UART4.set_priority(Priority::P2);
    interrupt::UART5.set_priority(Priority::P14);
    interrupt::USART3.set_priority(Priority::P15);
    [tick.start(interrupt::UART4), tasks.start(interrupt::UART5), plans.start(interrupt::USART3)]
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

#[handler]
unsafe fn USART3() {
    // SAFETY: as above.
    unsafe { crate::PLANS.on_interrupt() }
}

/// Starts the tasks that only this board has: none.
pub fn more(_: Spawner) {}

/// Sleeps until an interrupt is pended.
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

/// A tick has been made: the one thing that keeps the watchdog quiet.
pub fn ticked() {
    WATCHDOG.lock(|watchdog| watchdog.borrow_mut().iter_mut().for_each(IndependentWatchdog::pet));
}

/// No more ticks, no more frames: the drives' own watchdogs stop them, and this board's begins
/// anew.
#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    cortex_m::interrupt::disable();
    if let Some(place) = info.location() {
        defmt::error!("panic at {=str}:{}", place.file(), place.line());
    }
    loop {
        cortex_m::asm::nop();
    }
}

/// Strain gauges, amplified to 0 to 3.3 V, on PA0 and PA1.
pub struct Sensors {
    adc: Adc<'static, ADC1>,
    first: Peri<'static, PA0>,
    second: Peri<'static, PA1>,
}

impl Sensors {
    /// Sets the converter up: 12 bit.
    fn new(
        adc: Peri<'static, ADC1>,
        first: Peri<'static, PA0>,
        second: Peri<'static, PA1>,
    ) -> Self {
        Self { adc: Adc::new(adc, AdcConfig::default()), first, second }
    }
}

impl Sensor for Sensors {
    const COLUMN: &'static str = "strain_v";
    const AXES: usize = 2;

    /// Voltage, V: 47.5 + 12.5 cycles of the converter at 42.5 MHz, 1.4 µs.
    fn read(&mut self, axis: usize, _: u32, _: Angle<f32>) -> f32 {
        let time = SampleTime::CYCLES47_5;
        let counts = match axis {
            0 => self.adc.blocking_read(&mut self.first, time),
            _ => self.adc.blocking_read(&mut self.second, time),
        };
        f32::from(counts) * (3.3 / 4095.0)
    }
}

/// CAN frames to the bus.
pub struct BusWriter {
    bus: CanTx<'static>,
}

impl BusWriter {
    /// Queues a frame; where three wait already, waits for one of them. The sequence number has no
    /// place in the frame.
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
