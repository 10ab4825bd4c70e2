//! The firmware's log: defmt frames, decoded with the strings in its image.

use std::fs::File;
use std::io::Read;

use defmt_decoder::{DecodeError, Table};

use crate::error::Error;

/// Lines of the log, read from a file that grows.
pub struct Log {
    table: Table,
    file: File,
    bytes: Vec<u8>,
    /// Number of lines that were handed out.
    given: usize,
}

impl Log {
    /// Opens the log of an image, in `file`.
    ///
    /// # Errors
    /// An error is returned if the image has no defmt strings.
    pub fn new(elf: &[u8], file: File) -> Result<Self, Error> {
        let table = Table::parse(elf)
            .map_err(|error| Error::new(format_args!("image: {error}")))?
            .ok_or_else(|| {
                Error::new("image: no defmt strings; it must be the application's image")
            })?;
        Ok(Self { table, file, bytes: Vec::new(), given: 0 })
    }

    /// Returns the lines that were logged before tick `tick` was made and not handed out yet, each
    /// with the number of ticks made until then.
    pub fn before(&mut self, tick: u32) -> Vec<(u32, String)> {
        // What cannot be read is not shown.
        let _ = self.file.read_to_end(&mut self.bytes);
        let mut decoder = self.table.new_stream_decoder();
        decoder.received(&self.bytes);
        let mut lines = Vec::new();
        loop {
            match decoder.decode() {
                Ok(frame) => {
                    let made = frame.display_timestamp().map(|stamp| stamp.to_string());
                    let made = made.and_then(|stamp| stamp.parse().ok()).unwrap_or(0);
                    let level = frame.level().map_or("", |level| level.as_str());
                    lines.push((made, format!("{level:<5} {}", frame.display_message())));
                }
                Err(DecodeError::UnexpectedEof) => break,
                Err(DecodeError::Malformed) => lines.push((0, "garbled".to_owned())),
            }
        }
        let new = lines.into_iter().skip(self.given).take_while(|(made, _)| *made < tick);
        let new: Vec<_> = new.collect();
        self.given += new.len();
        new
    }
}
