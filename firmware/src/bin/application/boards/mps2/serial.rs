//! Serial lines, and the bus on one of them.

use core::sync::atomic::{AtomicU32, Ordering};

use embassy_futures::yield_now;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::pipe::Pipe;
use stillbeam::axis::Sequence;
use stillbeam::drive::ClassicFrame;
use stillbeam_protocol::slcan;

use crate::tick::MICROSECONDS;

/// A CMSDK UART: registers DATA, STATE (full: bit 0 transmit, bit 1 receive), CTRL, INTCLEAR,
/// BAUDDIV.
pub struct Uart {
    base: usize,
    input: Pipe<CriticalSectionRawMutex, 128>,
    taken: AtomicU32,
}

pub static UARTS: [Uart; 2] = [Uart::new(0x4000_4000), Uart::new(0x4000_5000)];

impl Uart {
    const fn new(base: usize) -> Self {
        Self { base, input: Pipe::new(), taken: AtomicU32::new(0) }
    }

    fn register(&self, index: usize) -> *mut u32 {
        (self.base as *mut u32).wrapping_add(index)
    }

    pub fn start(&self) {
        // SAFETY: registers of this device, which nothing else uses.
        unsafe {
            self.register(4).write_volatile(25);
            // Transmit, receive, interrupt on receive.
            self.register(2).write_volatile(0b1011);
        }
    }

    /// In the interrupt: empties the one-byte buffer.
    pub fn take(&self) {
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

    /// Bytes that have come in since power-up.
    pub fn taken(&self) -> u32 {
        self.taken.load(Ordering::Acquire)
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
        let stamp = slcan::stamp(sequence, MICROSECONDS);
        UARTS[1].send(slcan::encode(frame, stamp).bytes()).await;
    }
}

/// CAN frames from the captured bus.
pub struct BusReader {
    line: slcan::Splitter,
}

impl BusReader {
    /// From the beginning of a line.
    pub fn new() -> Self {
        Self { line: slcan::Splitter::new() }
    }

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
