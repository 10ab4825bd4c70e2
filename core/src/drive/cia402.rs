//! CiA 402 cyclic synchronous position: what goes into the PDOs and how the drive is prepared.
//!
//! 0x607A target position i32, 0x60B1 velocity offset i32, 0x60B2 torque offset i16 in ‰ of the
//! rated torque, 0x60C2 interpolation period `value × 10^index` s. Positions are encoder
//! increments. Velocities are increments per second, the unit of a drive whose factor group is left
//! alone, or what [`VelocityUnit`] says. [`PowerDrive`] is the state machine behind 0x6040 and
//! 0x6041. Source: CiA 402-2 / IEC 61800-7-201; object descriptions as in Beckhoff's AX8000 and
//! Elmo's DSP 402 manuals.
//!
//! One PDO of ten bytes over EtherCAT or CAN FD; over classic CAN two, of eight and of two bytes,
//! which take effect together at the SYNC after them.

mod power;
mod status;

use embedded_can::Frame;

pub use power::{PowerDrive, State, Step, Wanted};
pub use status::{Emergency, Status};

use super::counts::{count, count_i16};
use super::frame::standard;
use super::{Encoded, Range, Saturated, WHOLE_TURNS};
use crate::Error;
use crate::axis::Sequence;
use crate::motor::Demand;

/// A drive's node id and what its counts mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    node: u8,
    /// Increments a motor turn.
    increments: u32,
    /// 0x6076, N m.
    rated_torque: f32,
    /// Counts of the velocity offset in a turn/s.
    velocity_counts: f32,
}

/// Unit of 0x60B1 that the drive was told: 0x60A9, or the maker's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VelocityUnit {
    /// Encoder increments per second.
    Increments,
    /// Turns per minute times `10^-decimals`, 0 to 3 decimals: 1 is 0.1 rpm.
    PerMinute {
        /// Decimals of the unit.
        decimals: u8,
    },
}

/// Payload of the whole PDO: 0x607A, 0x60B1, 0x60B2.
pub type Payload = [u8; 10];

impl Drive {
    /// Node 1 to 127, encoder increments a turn (to 2²⁴), rated torque in N m.
    pub fn new(node: u8, increments: u32, rated_torque: f64) -> Result<Self, Error> {
        Error::check("drive.node", f64::from(node), 1.0, 127.0, "")?;
        Error::check("drive.increments", f64::from(increments), 4.0, 16_777_216.0, "a turn")?;
        Error::check("drive.rated_torque", rated_torque, 1e-6, 1e6, "N m")?;
        let velocity_counts = increments as f32;
        Ok(Self { node, increments, rated_torque: rated_torque as f32, velocity_counts })
    }

    /// The same drive with its velocity offset in another unit.
    ///
    /// # Errors
    /// More than 3 decimals.
    pub fn with_velocity_unit(self, unit: VelocityUnit) -> Result<Self, Error> {
        let velocity_counts = match unit {
            VelocityUnit::Increments => self.increments as f32,
            VelocityUnit::PerMinute { decimals } => {
                let decimals =
                    Error::check("drive.velocity_decimals", f64::from(decimals), 0.0, 3.0, "")?;
                60.0 * [1.0, 10.0, 100.0, 1000.0][decimals as usize]
            }
        };
        Ok(Self { velocity_counts, ..self })
    }

    /// Contents of the PDO.
    pub fn range(&self) -> Range {
        // The greatest f32 below 2³¹.
        let most = 2_147_483_520.0;
        let position = most / self.increments as f32;
        Range {
            position: if position < WHOLE_TURNS { position } else { WHOLE_TURNS },
            velocity: most / self.velocity_counts,
            torque: 32.767 * self.rated_torque,
        }
    }

    /// N m a count of the torque offset.
    pub fn torque_step(&self) -> f32 {
        self.rated_torque / 1000.0
    }

    /// The payload. `None` if a value is not finite.
    ///
    /// Whole turns are multiplied in integers: the position is right to half an increment until it
    /// saturates, 2³¹ increments from the encoder's zero.
    pub fn encode(&self, demand: &Demand<f32>) -> Option<Encoded<Payload>> {
        if !demand.is_finite() {
            return None;
        }
        let per_turn = self.increments as f32;
        let whole = i64::from(demand.position.turns) * i64::from(self.increments);
        let (rest, _) = count(demand.position.part, per_turn, i32::MIN, i32::MAX);
        let exact = whole + i64::from(rest);
        let position = exact.clamp(i32::MIN.into(), i32::MAX.into()) as i32;
        let (velocity, velocity_cut) =
            count(demand.velocity, self.velocity_counts, i32::MIN, i32::MAX);
        let (torque, torque_cut) = count_i16(demand.torque, 1000.0 / self.rated_torque);
        let mut payload = [0; 10];
        payload[..4].copy_from_slice(&position.to_le_bytes());
        payload[4..8].copy_from_slice(&velocity.to_le_bytes());
        payload[8..].copy_from_slice(&torque.to_le_bytes());
        let position = i64::from(position) != exact;
        let saturated = Saturated { position, velocity: velocity_cut, torque: torque_cut };
        Some(Encoded { payload, saturated })
    }

    /// The demand in a payload.
    pub fn decode(&self, payload: &Payload) -> Demand<f32> {
        let &[p0, p1, p2, p3, v0, v1, v2, v3, t0, t1] = payload;
        let position = i32::from_le_bytes([p0, p1, p2, p3]);
        let velocity = i32::from_le_bytes([v0, v1, v2, v3]);
        let torque = i16::from_le_bytes([t0, t1]);
        Demand {
            position: self.angle(position),
            velocity: (f64::from(velocity) / f64::from(self.velocity_counts)) as f32,
            torque: f32::from(torque) * self.torque_step(),
        }
    }

    /// The payload as RPDO 1 (0x607A, 0x60B1) and RPDO 2 (0x60B2) of the predefined connection set.
    pub fn rpdos<F: Frame>(&self, payload: &Payload) -> Option<[F; 2]> {
        let node = u16::from(self.node);
        let first = F::new(standard(0x200 + node), &payload[..8])?;
        Some([first, F::new(standard(0x300 + node), &payload[8..])?])
    }

    /// SDO downloads that set 0x60C2 to the tick, to be sent before operation is enabled. The drive
    /// answers each.
    pub fn interpolation_period<F: Frame>(&self, period: InterpolationPeriod) -> Option<[F; 2]> {
        let [index] = period.index.to_le_bytes();
        Some([self.download(0x60c2, 1, period.value)?, self.download(0x60c2, 2, index)?])
    }

    /// SDO download that sets 0x6060, modes of operation, to 8, cyclic synchronous position.
    pub fn cyclic_synchronous_position<F: Frame>(&self) -> Option<F> {
        self.download(0x6060, 0, 8)
    }

    /// Expedited SDO download of one byte (CiA 301: command specifier 0x2F).
    fn download<F: Frame>(&self, index: u16, sub: u8, value: u8) -> Option<F> {
        let [low, high] = index.to_le_bytes();
        let id = standard(0x600 + u16::from(self.node));
        F::new(id, &[0x2f, low, high, sub, value, 0, 0, 0])
    }
}

/// 0x60C2, the time between two setpoints: `value × 10^index` s.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InterpolationPeriod {
    value: u8,
    index: i8,
}

impl InterpolationPeriod {
    /// The period of a tick of `tick` s, exact to 1e-9 of it. In milliseconds where that can be,
    /// the unit that every drive takes; else in the coarsest unit from 10⁻⁴ to 10⁻⁶ s, then 10⁻² to
    /// 1 s.
    ///
    /// # Errors
    /// The tick is not 1 to 255 of any of these units. What it must be is the nearest that is.
    pub fn new(tick: f64) -> Result<Self, Error> {
        Error::check("drive.interpolation_period", tick, 1e-6, 255.0, "s")?;
        let mut nearest = f64::INFINITY;
        for (index, per_second) in
            [(-3, 1e3), (-4, 1e4), (-5, 1e5), (-6, 1e6), (-2, 1e2), (-1, 1e1), (0, 1.0)]
        {
            let value = ((tick * per_second + 0.5) as u8).max(1);
            let period = f64::from(value) / per_second;
            if (period - tick).abs() <= 1e-9 * tick {
                return Ok(Self { value, index });
            }
            if (period - tick).abs() < (nearest - tick).abs() {
                nearest = period;
            }
        }
        let (parameter, unit) = ("drive.interpolation_period", "s");
        Err(Error::OutOfRange { parameter, value: tick, min: nearest, max: nearest, unit })
    }
}

/// The SYNC that makes the drives take up their PDOs, with its counter (CiA 301, 0x1019): 1 to
/// `overflow`, 2 to 240. It is the sequence number of the PDOs before it.
pub fn sync<F: Frame>(sequence: Sequence, overflow: u8) -> Option<F> {
    let overflow = u16::from(overflow.clamp(2, 240));
    F::new(standard(0x080), &[(sequence.0 % overflow) as u8 + 1])
}
