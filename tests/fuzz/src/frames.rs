//! Bytes of a serial line: command frames, reports, captured CAN frames.

use stillbeam_protocol::frame::{Garbled, MAX, Splitter, decode, encode};
use stillbeam_protocol::{Report, Request, slcan};

/// Whatever comes over a line is cut into frames; one that is read is written as something that is
/// read as the same. The first byte says whether the frames come with their checksum or get it
/// here: without, hardly any would be read.
pub fn frames(bytes: &[u8]) {
    let Some((&kind, rest)) = bytes.split_first() else { return };
    if kind.is_multiple_of(2) {
        let mut splitter = Splitter::new();
        for &byte in rest {
            if let Some(frame) = splitter.push(byte) {
                whole(frame);
            }
        }
        lines(rest);
    } else {
        content(rest);
    }
}

fn whole(frame: Result<&mut [u8], Garbled>) {
    let Ok(frame) = frame else { return };
    assert!(frame.len() <= MAX);
    let mut twin = frame.to_vec();
    if let Ok(request) = decode::<Request>(frame) {
        again(&request);
    }
    if let Ok(report) = decode::<Report<'_>>(&mut twin) {
        again(&report);
    }
}

/// Reads the content of a frame, without checksum and coding.
fn content(message: &[u8]) {
    if let Ok((request, _)) = postcard::take_from_bytes::<Request>(message) {
        again(&request);
    }
    if let Ok((report, _)) = postcard::take_from_bytes::<Report<'_>>(message) {
        again(&report);
    }
}

/// Written, read and written once more: the same bytes. A NaN is not its own equal, its bytes are.
trait Message: Sized {
    fn frame(&self) -> Result<Vec<u8>, Garbled>;
    fn read_again(frame: &mut [u8]) -> Result<Vec<u8>, Garbled>;
}

impl Message for Request {
    fn frame(&self) -> Result<Vec<u8>, Garbled> {
        encode(self, &mut [0; MAX]).map(<[u8]>::to_vec)
    }
    fn read_again(frame: &mut [u8]) -> Result<Vec<u8>, Garbled> {
        decode::<Self>(frame)?.frame()
    }
}

impl Message for Report<'_> {
    fn frame(&self) -> Result<Vec<u8>, Garbled> {
        encode(self, &mut [0; MAX]).map(<[u8]>::to_vec)
    }
    fn read_again(frame: &mut [u8]) -> Result<Vec<u8>, Garbled> {
        decode::<Report<'_>>(frame)?.frame()
    }
}

fn again<M: Message>(message: &M) {
    match message.frame() {
        Ok(first) => {
            assert_eq!(first.iter().position(|&byte| byte == 0), Some(first.len() - 1));
            let second = M::read_again(&mut first.clone());
            assert_eq!(second.as_ref(), Ok(&first));
        }
        // A report's texts can be longer than any of ours.
        Err(error) => assert_eq!(error, Garbled::TooLong),
    }
}

/// Captured CAN frames, as lines of text.
fn lines(bytes: &[u8]) {
    let mut splitter = slcan::Splitter::new();
    for &byte in bytes.iter().chain(b"\r") {
        let Some((frame, stamp)) = splitter.push(byte).and_then(slcan::decode) else { continue };
        let line = slcan::encode(&frame, stamp);
        assert_eq!(slcan::decode(line.bytes()), Some((frame, stamp)));
    }
}
