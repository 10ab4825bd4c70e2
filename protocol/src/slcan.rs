//! CAN frames as lines of text, the serial-line CAN form of Lawicel's CANUSB that `slcand` and
//! python-can read: `tiiildd…tttt\r`, identifier, length, data and a time stamp in hexadecimal; `T`
//! with eight digits for extended identifiers, `r` and `R` for remote frames.

use embedded_can::{ExtendedId, Frame, Id, StandardId};
use stillbeam::axis::Sequence;
use stillbeam::drive::ClassicFrame;

/// Longest line: `T`, 8 + 1 + 16 + 4 digits, carriage return.
pub const MAX: usize = 31;

/// A line.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    bytes: [u8; MAX],
    length: usize,
}

impl Line {
    /// Its bytes, the carriage return included.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes[..self.length]
    }

    fn push(&mut self, byte: u8) {
        self.bytes[self.length] = byte;
        self.length += 1;
    }

    fn hex(&mut self, value: u32, digits: u32) {
        for place in (0..digits).rev() {
            let digit = (value >> (4 * place)) as usize & 0xf;
            self.push(b"0123456789ABCDEF"[digit]);
        }
    }
}

/// The line of a frame. `stamp` is Lawicel's: milliseconds, 0 to 59,999.
pub fn encode(frame: &ClassicFrame, stamp: u16) -> Line {
    let mut line = Line { bytes: [0; MAX], length: 0 };
    let remote = frame.is_remote_frame();
    match frame.id() {
        Id::Standard(id) => {
            line.push(if remote { b'r' } else { b't' });
            line.hex(id.as_raw().into(), 3);
        }
        Id::Extended(id) => {
            line.push(if remote { b'R' } else { b'T' });
            line.hex(id.as_raw(), 8);
        }
    }
    line.hex(frame.dlc() as u32, 1);
    for &byte in frame.data() {
        line.hex(byte.into(), 2);
    }
    line.hex(stamp.into(), 4);
    line.push(b'\r');
    line
}

/// The stamp of a tick's frames: the tick's time in whole ms, modulo a minute, where a tick lasts
/// `tick` µs.
pub fn stamp(sequence: Sequence, tick: u32) -> u16 {
    (u64::from(sequence.0) * u64::from(tick) / 1_000 % 60_000) as u16
}

/// The frame and stamp of a line, with or without its carriage return. `None` if it is none.
pub fn decode(line: &[u8]) -> Option<(ClassicFrame, u16)> {
    let line = line.strip_suffix(b"\r").unwrap_or(line);
    let (&kind, mut rest) = line.split_first()?;
    let remote = matches!(kind, b'r' | b'R');
    let id: Id = match kind {
        b't' | b'r' => StandardId::new(hex(&mut rest, 3)? as u16)?.into(),
        b'T' | b'R' => ExtendedId::new(hex(&mut rest, 8)?)?.into(),
        _ => return None,
    };
    let length = hex(&mut rest, 1)? as usize;
    let mut data = [0; 8];
    let data = data.get_mut(..length)?;
    if !remote {
        for byte in data.iter_mut() {
            *byte = hex(&mut rest, 2)? as u8;
        }
    }
    let stamp = hex(&mut rest, 4)? as u16;
    let frame =
        if remote { ClassicFrame::new_remote(id, length) } else { ClassicFrame::new(id, data) };
    if rest.is_empty() { Some((frame?, stamp)) } else { None }
}

/// Takes that many hexadecimal digits.
fn hex(text: &mut &[u8], digits: usize) -> Option<u32> {
    let (head, rest) = text.split_at_checked(digits)?;
    *text = rest;
    head.iter().try_fold(0, |value, &digit| Some(value << 4 | char::from(digit).to_digit(16)?))
}

/// Cuts a stream of bytes into lines.
#[derive(Clone, Debug)]
pub struct Splitter {
    bytes: [u8; MAX],
    filled: usize,
}

impl Default for Splitter {
    fn default() -> Self {
        Self::new()
    }
}

impl Splitter {
    /// Empty.
    pub const fn new() -> Self {
        Self { bytes: [0; MAX], filled: 0 }
    }

    /// Takes a byte. Where it closes a line, that line, for [`decode`]; of what is too long, only
    /// the beginning is kept, which is no frame.
    pub fn push(&mut self, byte: u8) -> Option<&[u8]> {
        if byte != b'\r' {
            if let Some(slot) = self.bytes.get_mut(self.filled) {
                *slot = byte;
                self.filled += 1;
            }
            return None;
        }
        let filled = core::mem::take(&mut self.filled);
        self.bytes.get(..filled)
    }
}
