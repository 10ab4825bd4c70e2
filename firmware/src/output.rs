//! Bytes to the emulator's standard output, many at a time: a semihosting call stops the machine
//! and costs more than a thousand ticks.

use semihosting::io::{self, Write};

/// Buffered standard output.
pub struct Output {
    stdout: io::Stdout,
    buffer: [u8; 16 * 1024],
    filled: usize,
}

impl Output {
    /// Opens it.
    pub fn open() -> io::Result<Self> {
        Ok(Self { stdout: io::stdout()?, buffer: [0; 16 * 1024], filled: 0 })
    }

    /// Puts bytes behind the others.
    pub fn write(&mut self, mut bytes: &[u8]) -> io::Result<()> {
        while !bytes.is_empty() {
            let room = &mut self.buffer[self.filled..];
            let n = room.len().min(bytes.len());
            room[..n].copy_from_slice(&bytes[..n]);
            self.filled += n;
            bytes = &bytes[n..];
            if self.filled == self.buffer.len() {
                self.flush()?;
            }
        }
        Ok(())
    }

    /// Sends what is waiting.
    pub fn flush(&mut self) -> io::Result<()> {
        self.stdout.write_all(&self.buffer[..self.filled])?;
        self.filled = 0;
        Ok(())
    }
}

impl core::fmt::Write for Output {
    fn write_str(&mut self, text: &str) -> core::fmt::Result {
        self.write(text.as_bytes()).map_err(|_| core::fmt::Error)
    }
}
