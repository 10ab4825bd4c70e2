//! The machine that runs the firmware: carries bytes both ways and lets time pass.

use std::collections::VecDeque;
use std::io::{ErrorKind, Read, Write};
use std::path::Path;
use std::time::Duration;

use super::Emulator;
use crate::error::Error;

/// Most bytes of one line that are sent with a tick. The board's buffer holds them.
const CHUNK: usize = 120;

/// Time limit of one read.
pub(super) const POLL: Duration = Duration::from_millis(20);

/// Time without a byte after which a board is taken for dead.
const PATIENCE: Duration = Duration::from_secs(20);

/// The same in QEMU, whose host may be busy with other work. That QEMU has ended is seen at once.
const EMULATED_PATIENCE: Duration = Duration::from_secs(120);

/// A running firmware.
pub struct Machine {
    link: Box<dyn Line>,
    emulator: Option<Emulator>,
    /// Bytes that wait for the next grants: of the link, of the bus.
    outbox: [VecDeque<u8>; 2],
    /// Time for which the next tick is kept from running, µs.
    stall: u16,
    /// Time waited for a byte so far, without that in which this program did not run.
    silence: Duration,
}

/// A serial line with a short time limit on reads.
trait Line: Read + Write + Send {}
impl<T: Read + Write + Send> Line for T {}

impl Machine {
    /// Starts an image in QEMU.
    ///
    /// # Errors
    /// An error is returned if QEMU or the image is missing, or if the two do not connect.
    pub fn emulate(image: &Path) -> Result<Self, Error> {
        let (emulator, link) = Emulator::start(image)?;
        Ok(Self::new(Box::new(link), Some(emulator)))
    }

    /// Opens the serial port of a board.
    ///
    /// # Errors
    /// The port cannot be opened.
    pub fn open(port: &str, baud: u32) -> Result<Self, Error> {
        let line = serialport::new(port, baud).timeout(POLL).open().map_err(|error| {
            Error::new(format_args!(
                "serial = \"{port}\": {error}; must be a serial port, e.g. /dev/ttyACM0"
            ))
        })?;
        Ok(Self::new(Box::new(line), None))
    }

    fn new(link: Box<dyn Line>, emulator: Option<Emulator>) -> Self {
        Self { link, emulator, outbox: Default::default(), stall: 0, silence: Duration::ZERO }
    }

    /// True if time passes only by [`Machine::grant`], and the bus can be read.
    pub fn is_emulated(&self) -> bool {
        self.emulator.is_some()
    }

    /// Sends bytes to the firmware: with the next grant if time is granted, otherwise now.
    pub fn send(&mut self, bytes: &[u8]) -> Result<(), Error> {
        if self.is_emulated() {
            self.outbox[0].extend(bytes);
            return Ok(());
        }
        self.link.write_all(bytes).and_then(|()| self.link.flush()).map_err(|e| broken("link", e))
    }

    /// Sends bytes to the emulated bus.
    pub fn send_to_bus(&mut self, bytes: &[u8]) {
        self.outbox[1].extend(bytes);
    }

    /// Bytes that the emulated bus takes before the next tick, beside those that wait for it.
    pub fn room_on_bus(&self) -> usize {
        CHUNK.saturating_sub(self.outbox[1].len())
    }

    /// Keeps the next tick that is granted from running for `microseconds` µs.
    pub fn stall(&mut self, microseconds: u16) {
        self.stall = microseconds;
    }

    /// Lets the next tick take place, once the bytes sent before it are in. Returns true if none
    /// were left to send after it.
    pub fn grant(&mut self) -> Result<bool, Error> {
        let Some(emulator) = &mut self.emulator else { return Ok(true) };
        let chunk = |line: &mut VecDeque<u8>| {
            let n = line.len().min(CHUNK);
            line.drain(..n).collect::<Vec<u8>>()
        };
        let stall = core::mem::take(&mut self.stall);
        let [link, bus] = self.outbox.each_mut().map(chunk);
        let sent = self.link.write_all(&link).and_then(|()| emulator.bus.write_all(&bus));
        sent.and_then(|()| emulator.grant([link.len() as u8, bus.len() as u8], stall))
            .map_err(|error| broken("link", error))?;
        Ok(self.outbox.iter().all(VecDeque::is_empty))
    }

    /// Returns the bytes that have come from the firmware; none after a short wait.
    ///
    /// # Errors
    /// An error is returned if the line is broken or has been silent for too long. In QEMU it holds
    /// QEMU's messages.
    pub fn receive(&mut self) -> Result<Vec<u8>, Error> {
        let mut bytes = vec![0; 4096];
        let n = match self.link.read(&mut bytes) {
            Ok(0) => return Err(self.gone("closed its line")),
            Ok(n) => n,
            Err(error) if is_timeout(&error) => 0,
            Err(error) => return Err(broken("link", error)),
        };
        self.silence = if n > 0 { Duration::ZERO } else { self.silence + POLL };
        let patience = if self.is_emulated() { EMULATED_PATIENCE } else { PATIENCE };
        if self.silence > patience {
            return Err(self.gone(&format!("has been silent for {} s", patience.as_secs())));
        }
        bytes.truncate(n);
        Ok(bytes)
    }

    /// Returns the bytes that have come from the emulated bus; none after a short wait.
    pub fn receive_from_bus(&mut self) -> Result<Vec<u8>, Error> {
        let Some(emulator) = &mut self.emulator else { return Ok(Vec::new()) };
        let mut bytes = vec![0; 4096];
        let n = match emulator.bus.read(&mut bytes) {
            Ok(n) => n,
            Err(error) if is_timeout(&error) => 0,
            Err(error) => return Err(broken("bus", error)),
        };
        bytes.truncate(n);
        Ok(bytes)
    }

    /// Returns the lines that the firmware logged before tick `tick` and since the last call, each
    /// with the number of ticks made until then.
    pub fn log(&mut self, tick: u32) -> Vec<(u32, String)> {
        self.emulator.as_mut().map(|emulator| emulator.log.before(tick)).unwrap_or_default()
    }

    fn gone(&mut self, what: &str) -> Error {
        let end = self.emulator.as_mut().map(Emulator::epitaph).unwrap_or_default();
        let log = self.log(u32::MAX);
        let last = log.last().map(|(_, line)| format!("; it last logged: {line}"));
        let last = last.unwrap_or_default();
        Error::new(format_args!("firmware: {what}{end}{last}"))
    }
}

fn is_timeout(error: &std::io::Error) -> bool {
    matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::WouldBlock | ErrorKind::Interrupted)
}

fn broken(line: &str, error: std::io::Error) -> Error {
    Error::new(format_args!("firmware: its {line} broke: {error}"))
}
