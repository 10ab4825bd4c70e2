//! The firmware's log: defmt frames, decoded with the strings in its image.

use std::io::Read;
use std::sync::mpsc::{Receiver, channel};
use std::thread;

use defmt_decoder::{DecodeError, Table};

use crate::error::Error;

/// Lines as they come.
pub struct Log {
    lines: Receiver<String>,
}

impl Log {
    /// Decodes a stream until it ends.
    ///
    /// # Errors
    /// The image has no defmt strings.
    pub fn new(elf: &[u8], mut stream: impl Read + Send + 'static) -> Result<Self, Error> {
        let table = Table::parse(elf)
            .map_err(|error| Error::new(format_args!("image: {error}")))?
            .ok_or_else(|| Error::new("image: no defmt strings; accepted is the application's"))?;
        let (sender, lines) = channel();
        thread::spawn(move || {
            let mut decoder = table.new_stream_decoder();
            let mut bytes = [0; 1024];
            while let Ok(n @ 1..) = stream.read(&mut bytes) {
                decoder.received(&bytes[..n]);
                loop {
                    let line = match decoder.decode() {
                        Ok(frame) => {
                            let level = frame.level().map_or("", |level| level.as_str());
                            format!("{level:<5} {}", frame.display_message())
                        }
                        Err(DecodeError::UnexpectedEof) => break,
                        Err(DecodeError::Malformed) => "garbled".to_owned(),
                    };
                    // Nobody listens any more.
                    if sender.send(line).is_err() {
                        return;
                    }
                }
            }
        });
        Ok(Self { lines })
    }

    /// What has come since the last time.
    pub fn lines(&mut self) -> Vec<String> {
        self.lines.try_iter().collect()
    }
}
