//! Answers of a moteus, and the frames beside the setpoint's.

use super::{NOP, Servo, WRITE_FLOAT, WRITE_INT8};
use crate::drive::Condition;

/// Payload length of [`Servo::query`]: six bytes of subframes, filled up.
pub const QUERY_BYTES: usize = 8;

const READ_INT8: u8 = 0x10;
const READ_FLOAT: u8 = 0x1c;
/// Replies with registers of int8, int16, int32 and f32; the lower bits are their number.
const REPLY: u8 = 0x20;

const MODE: u32 = 0x000;
const POSITION: u32 = 0x001;
const VELOCITY: u32 = 0x002;
const TORQUE: u32 = 0x003;
const FAULT: u32 = 0x00f;
/// "Set output exact": the position in effect from now on.
const OUTPUT_EXACT: [u8; 3] = [WRITE_FLOAT | 1, 0xb1, 0x02];

/// A servo's report of itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Reply {
    /// Register 0x000: 0 stopped, 1 fault, 10 position, 11 position timeout.
    pub mode: i8,
    /// Turns.
    pub position: f32,
    /// Turns/s.
    pub velocity: f32,
    /// N m.
    pub torque: f32,
    /// Register 0x00f, the fault's code; 0 for none.
    pub fault: i8,
}

impl Reply {
    /// Stopped is off, position mode is on, fault and position timeout are faults.
    pub fn condition(&self) -> Condition {
        match self.mode {
            0 => Condition::Off,
            10 => Condition::On,
            // A watchdog that ran out has no code of its own.
            1 | 11 => Condition::Fault(u32::from(self.fault.unsigned_abs())),
            _ => Condition::Busy,
        }
    }

    /// The reply in a payload. `None` if it lacks one of mode, position, velocity, torque and
    /// fault, as f32 but for mode and fault, or holds a number that is not finite.
    pub fn decode(payload: &[u8]) -> Option<Self> {
        let mut reply = Self::default();
        let mut found = 0_u8;
        let mut rest = payload;
        while let Some((&word, after)) = rest.split_first() {
            rest = after;
            if word == NOP {
                continue;
            }
            if word & 0xf0 != REPLY {
                return None;
            }
            let size = [1, 2, 4, 4][usize::from(word >> 2 & 3)];
            let count = match word & 3 {
                0 => varuint(&mut rest)?,
                few => u32::from(few),
            };
            let first = varuint(&mut rest)?;
            for k in 0..count {
                let (value, after) = rest.split_at_checked(size)?;
                rest = after;
                found |= reply.take(first.checked_add(k)?, word >> 2 & 3, value)?;
            }
        }
        let finite =
            [reply.position, reply.velocity, reply.torque].iter().all(|value| value.is_finite());
        (found == 0x1f && finite).then_some(reply)
    }

    /// Takes a register's value. Returns the bit of its field, 0 for a register that is not asked
    /// for.
    fn take(&mut self, register: u32, format: u8, value: &[u8]) -> Option<u8> {
        let int8 = || (format == 0).then(|| value.first().map(|x| i8::from_le_bytes([*x])))?;
        let float = || (format == 3).then(|| value.try_into().ok().map(f32::from_le_bytes))?;
        match register {
            MODE => self.mode = int8()?,
            POSITION => self.position = float()?,
            VELOCITY => self.velocity = float()?,
            TORQUE => self.torque = float()?,
            FAULT => self.fault = int8()?,
            _ => return Some(0),
        }
        Some(match register {
            FAULT => 0x10,
            below => 1 << below,
        })
    }
}

/// Reads a varuint: seven bits a byte, the low ones first.
fn varuint(rest: &mut &[u8]) -> Option<u32> {
    let mut value = 0_u32;
    for shift in [0, 7, 14, 21] {
        let (&byte, after) = rest.split_first()?;
        *rest = after;
        value |= u32::from(byte & 0x7f) << shift;
        if byte & 0x80 == 0 {
            return Some(value);
        }
    }
    None
}

impl Servo {
    /// Payload that asks for mode, position, velocity, torque and fault. The identifier needs the
    /// reply's bit, see [`Servo::id`].
    pub fn query(&self) -> [u8; QUERY_BYTES] {
        [READ_INT8 | 1, 0x00, READ_FLOAT | 3, 0x01, READ_INT8 | 1, 0x0f, NOP, NOP]
    }

    /// Payload that stops the servo, mode 0. It also clears a fault.
    pub fn stop(&self) -> [u8; 3] {
        [WRITE_INT8, 0x00, 0]
    }

    /// Payload that makes the servo call where it is `turns`. Re-homes a shaft that has turned so
    /// far that its f32 position loses counts, see [`super::super::Lost`]. `None` if `turns` is not
    /// finite. Send it to a servo that is stopped.
    pub fn set_position(&self, turns: f32) -> Option<[u8; 8]> {
        let [t0, t1, t2, t3] = turns.to_le_bytes();
        let [write, low, high] = OUTPUT_EXACT;
        turns.is_finite().then_some([write, low, high, t0, t1, t2, t3, NOP])
    }
}
