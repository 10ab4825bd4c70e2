//! A drive's view of its motor's shaft.

use std::collections::VecDeque;

use super::parts::check;
use crate::error::Error;

/// An encoder on the motor's shaft.
#[derive(Clone, Debug, PartialEq)]
pub struct Encoder {
    /// Counts a turn.
    counts: u32,
    /// Age of what the drive reads, updates of its loop.
    delay: usize,
    /// Turns that are not read yet, oldest first.
    seen: VecDeque<f64>,
    /// Turns by which the encoder is off.
    offset: f64,
}

impl Encoder {
    /// An encoder of `counts` a turn, read every `dt` s with a latency of `latency` s, rounded to
    /// whole readings.
    ///
    /// # Errors
    /// A number of counts that is not 4 to 2²⁴, or a latency that is not 0 to 0.1 s.
    pub fn new(counts: u32, latency: f64, dt: f64) -> Result<Self, Error> {
        check("encoder.counts", counts.into(), 4.0, 16_777_216.0, "a turn")?;
        check("encoder.latency", latency, 0.0, 0.1, "s")?;
        let delay = (latency / dt).round() as usize;
        Ok(Self { counts, delay, seen: VecDeque::with_capacity(delay + 1), offset: 0.0 })
    }

    /// Returns the reading, turns in whole counts, of a shaft that is at `turns` now.
    pub fn read(&mut self, turns: f64) -> f64 {
        let counts = f64::from(self.counts);
        self.seen.push_back(((turns + self.offset) * counts).floor() / counts);
        let oldest = self.seen[0];
        if self.seen.len() > self.delay {
            self.seen.pop_front();
        }
        oldest
    }

    /// Shifts every later reading by `turns`: a slipped coupling or a lost index.
    pub fn jump(&mut self, turns: f64) {
        self.offset += turns;
    }

    /// Counts a turn.
    pub fn counts(&self) -> u32 {
        self.counts
    }
}

#[cfg(test)]
mod tests {
    use super::Encoder;

    #[test]
    fn a_reading_is_old_and_whole() {
        let mut encoder = Encoder::new(100, 2e-3, 1e-3).expect("in range");
        let read: Vec<f64> = (0..5).map(|k| encoder.read(0.013 * f64::from(k))).collect();
        assert_eq!(read, [0.0, 0.0, 0.0, 0.01, 0.02]);
        encoder.jump(0.5);
        let later: Vec<f64> = (0..3).map(|_| encoder.read(0.052)).collect();
        assert_eq!(later, [0.03, 0.05, 0.55]);
    }
}
