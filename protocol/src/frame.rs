//! Frames: `COBS(postcard(message) ++ CRC-32/ISCSI little-endian) ++ 0`.

use crc::{CRC_32_ISCSI, Crc, NoTable};
use serde::{Deserialize, Serialize};

/// Longest frame, its closing zero included.
pub const MAX: usize = 304;

/// Longest message with its checksum: COBS adds one byte in 254 and one more.
const MAX_BODY: usize = MAX - 3;

/// Bitwise: a table would take 1 KiB of the target's flash to save microseconds a message.
const CHECKSUM: Crc<u32, NoTable> = Crc::<u32, NoTable>::new(&CRC_32_ISCSI);

/// A frame that is not one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Garbled {
    /// Longer than [`MAX`].
    TooLong,
    /// Not COBS, or too short for a checksum.
    Coding,
    /// The checksum is another: cut or altered on the way.
    Checksum,
    /// The checksum holds and the content is no message: another version of the protocol.
    Content,
}

/// Writes the message's frame, closing zero included, and returns it.
///
/// # Errors
/// [`Garbled::TooLong`] if the message does not fit; no message of this crate does not.
pub fn encode<'a>(message: &impl Serialize, frame: &'a mut [u8; MAX]) -> Result<&'a [u8], Garbled> {
    let mut body = [0; MAX_BODY];
    let length = postcard::to_slice(message, &mut body).map_err(|_| Garbled::TooLong)?.len();
    let sum = CHECKSUM.checksum(&body[..length]).to_le_bytes();
    let end = length + sum.len();
    body.get_mut(length..end).ok_or(Garbled::TooLong)?.copy_from_slice(&sum);
    let coded =
        cobs::try_encode(&body[..end], &mut frame[..MAX - 1]).map_err(|_| Garbled::TooLong)?;
    frame[coded] = 0;
    Ok(&frame[..=coded])
}

/// The message in a frame, with or without its closing zero. Decodes in place.
///
/// # Errors
/// Returns the fault of the frame. Never panics.
pub fn decode<'a, M: Deserialize<'a>>(frame: &'a mut [u8]) -> Result<M, Garbled> {
    let length = frame.iter().position(|&byte| byte == 0).unwrap_or(frame.len());
    if length > MAX {
        return Err(Garbled::TooLong);
    }
    let frame = &mut frame[..length];
    let decoded = cobs::decode_in_place(frame).map_err(|_| Garbled::Coding)?;
    let body = frame.get(..decoded).ok_or(Garbled::Coding)?;
    let (message, sum) = body.split_last_chunk::<4>().ok_or(Garbled::Coding)?;
    if CHECKSUM.checksum(message) != u32::from_le_bytes(*sum) {
        return Err(Garbled::Checksum);
    }
    match postcard::take_from_bytes(message) {
        Ok((message, [])) => Ok(message),
        _ => Err(Garbled::Content),
    }
}

/// Cuts a stream of bytes into frames.
#[derive(Clone, Debug)]
pub struct Splitter {
    bytes: [u8; MAX],
    filled: usize,
    /// The frame under way is too long: drop it up to its zero.
    too_long: bool,
}

impl Default for Splitter {
    fn default() -> Self {
        Self::new()
    }
}

impl Splitter {
    /// Empty.
    pub const fn new() -> Self {
        Self { bytes: [0; MAX], filled: 0, too_long: false }
    }

    /// Takes a byte. Where it closes a frame, that frame, for [`decode`]; zeros between frames are
    /// nothing.
    pub fn push(&mut self, byte: u8) -> Option<Result<&mut [u8], Garbled>> {
        if byte != 0 {
            match self.bytes.get_mut(self.filled) {
                Some(slot) => {
                    *slot = byte;
                    self.filled += 1;
                }
                None => self.too_long = true,
            }
            return None;
        }
        let filled = core::mem::take(&mut self.filled);
        if core::mem::take(&mut self.too_long) {
            return Some(Err(Garbled::TooLong));
        }
        (filled > 0).then(|| Ok(&mut self.bytes[..filled]))
    }
}
