//! A serial line that applies the fault to its frames.

use rand::Rng;
use rand::rngs::StdRng;
use stillbeam_protocol::frame::{MAX, encode};
use stillbeam_protocol::{Command, Request};

use super::Fault;

/// Bytes on their way.
pub struct Line {
    fault: Fault,
    /// Frames and the tick at which each arrives.
    under_way: Vec<(u32, Vec<u8>)>,
    /// Tick up to which the line is dead.
    dead: u32,
    sequence: u16,
    /// Number of frames that were cut, altered, moved or doubled.
    pub injected: u64,
}

impl Line {
    /// Creates an idle line.
    pub fn new(fault: Fault) -> Self {
        Self { fault, under_way: Vec::new(), dead: 0, sequence: 0, injected: 0 }
    }

    /// Sends a command at tick `k`.
    pub fn send(&mut self, command: Command, k: u32, rng: &mut StdRng) {
        let request = Request { sequence: self.sequence, axis: 0, command };
        self.sequence = self.sequence.wrapping_add(1);
        let mut frame = [0; MAX];
        // Every request fits.
        let Ok(bytes) = encode(&request, &mut frame).map(<[u8]>::to_vec) else { return };
        match self.fault {
            Fault::Cut => self.cut(bytes, k, rng),
            Fault::Garbled if rng.random_bool(0.2) => {
                self.injected += 1;
                self.under_way.push((k, garbled(bytes, rng)));
            }
            Fault::Reordered if rng.random_bool(0.3) => {
                self.injected += 1;
                self.under_way.push((k + rng.random_range(1..=20), bytes));
            }
            Fault::Duplicated if rng.random_bool(0.3) => {
                for _ in 0..rng.random_range(1..4) {
                    self.injected += 1;
                    self.under_way.push((k + rng.random_range(0..=20), bytes.clone()));
                }
                self.under_way.push((k, bytes));
            }
            _ => self.under_way.push((k, bytes)),
        }
    }

    fn cut(&mut self, mut bytes: Vec<u8>, k: u32, rng: &mut StdRng) {
        if rng.random_bool(0.01) {
            self.injected += 1;
            self.dead = k + rng.random_range(1..100);
        }
        if k < self.dead {
            return;
        }
        if rng.random_bool(0.15) {
            self.injected += 1;
            bytes.truncate(rng.random_range(0..bytes.len()));
        }
        self.under_way.push((k, bytes));
    }

    /// Returns the bytes that arrive before tick `k`.
    pub fn deliver(&mut self, k: u32) -> Vec<u8> {
        let (arrived, rest) =
            std::mem::take(&mut self.under_way).into_iter().partition(|f| f.0 <= k);
        self.under_way = rest;
        let arrived: Vec<(u32, Vec<u8>)> = arrived;
        arrived.into_iter().flat_map(|(_, bytes)| bytes).collect()
    }
}

/// Flips bits, inserts bytes, or returns noise.
fn garbled(mut bytes: Vec<u8>, rng: &mut StdRng) -> Vec<u8> {
    for _ in 0..rng.random_range(1..6) {
        let at = rng.random_range(0..=bytes.len());
        match bytes.get_mut(at) {
            Some(byte) if rng.random_bool(0.7) => *byte ^= 1 << rng.random_range(0..8),
            _ => bytes.insert(at, rng.random()),
        }
    }
    if rng.random_bool(0.1) {
        bytes.extend((0..rng.random_range(0..400)).map(|_| rng.random::<u8>()));
    }
    bytes
}
