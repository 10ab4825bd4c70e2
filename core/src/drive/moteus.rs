//! moteus registers as a CAN FD payload.
//!
//! Mode 0x000 = 10 (position), position 0x020, velocity 0x021, feed-forward torque 0x022, watchdog
//! timeout 0x027; all of them f32 but the mode. Subframe `0x0c | n`: write n floats from the
//! register after it on; `0x01`: write one int8. A frame is filled up to a length that CAN FD has
//! with 0x50, no operation. Source: moteus documentation, CAN protocol and registers;
//! `mjlib/multiplex/format.h`.
//!
//! Positions are turns of what the drive calls its output: with
//! `motor_position.rotor_to_output_ratio` left at 1, the motor's shaft.

mod reply;

pub use reply::{QUERY_BYTES, Reply};

use super::{Encoded, Range, Saturated, WHOLE_TURNS, turns};
use crate::Error;
use crate::motor::Demand;

/// Payload length: 23 bytes of subframes, filled up.
pub const BYTES: usize = 24;

/// Values of a payload, in f32.
pub const RANGE: Range = Range { position: WHOLE_TURNS, velocity: f32::MAX, torque: f32::MAX };

const WRITE_INT8: u8 = 0x01;
const WRITE_FLOAT: u8 = 0x0c;
const NOP: u8 = 0x50;
/// Mode 10, position, and then three floats from register 0x020 on.
const TO_POSITION: [u8; 5] = [WRITE_INT8, 0x00, 10, WRITE_FLOAT | 3, 0x20];
/// One float to register 0x027.
const TO_WATCHDOG: [u8; 2] = [WRITE_FLOAT | 1, 0x27];

/// A servo and how long it may go without a setpoint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo {
    id: u8,
    watchdog: f32,
}

impl Servo {
    /// Servo 1 to 127; `watchdog` in s, after which it stops by itself. Three to ten ticks do.
    pub fn new(id: u8, watchdog: f64) -> Result<Self, Error> {
        Error::check("drive.servo", f64::from(id), 1.0, 127.0, "")?;
        Error::check("drive.watchdog", watchdog, 1e-3, 10.0, "s")?;
        Ok(Self { id, watchdog: watchdog as f32 })
    }

    /// Identifier of a frame from source 0 to this servo; with `reply` it answers. With it, the
    /// identifier takes an extended frame.
    pub fn id(&self, reply: bool) -> u32 {
        u32::from(reply) << 15 | u32::from(self.id)
    }

    /// The payload. `None` if a value is not finite: a NaN means "ignore" to this drive.
    ///
    /// The position is one f32: its step is 6e-8 of the turns gone since the encoder's zero.
    pub fn encode(&self, demand: &Demand<f32>) -> Option<Encoded<[u8; BYTES]>> {
        if !demand.is_finite() {
            return None;
        }
        let position = demand.position.turns as f32 + demand.position.part;
        let mut payload = [NOP; BYTES];
        payload[..5].copy_from_slice(&TO_POSITION);
        payload[5..9].copy_from_slice(&position.to_le_bytes());
        payload[9..13].copy_from_slice(&demand.velocity.to_le_bytes());
        payload[13..17].copy_from_slice(&demand.torque.to_le_bytes());
        payload[17..19].copy_from_slice(&TO_WATCHDOG);
        payload[19..23].copy_from_slice(&self.watchdog.to_le_bytes());
        Some(Encoded { payload, saturated: Saturated::default() })
    }

    /// The demand in a payload of this shape and watchdog.
    pub fn decode(&self, payload: &[u8; BYTES]) -> Option<Demand<f32>> {
        let (to_position, rest) = payload.split_first_chunk::<5>()?;
        let (values, rest) = rest.split_first_chunk::<12>()?;
        let (to_watchdog, rest) = rest.split_first_chunk::<2>()?;
        let (watchdog, rest) = rest.split_first_chunk::<4>()?;
        let ours = *to_position == TO_POSITION
            && *to_watchdog == TO_WATCHDOG
            && *watchdog == self.watchdog.to_le_bytes()
            && rest == [NOP];
        let &[p0, p1, p2, p3, v0, v1, v2, v3, t0, t1, t2, t3] = values;
        let demand = Demand {
            position: turns(f32::from_le_bytes([p0, p1, p2, p3]))?,
            velocity: f32::from_le_bytes([v0, v1, v2, v3]),
            torque: f32::from_le_bytes([t0, t1, t2, t3]),
        };
        (ours && demand.is_finite()).then_some(demand)
    }
}
