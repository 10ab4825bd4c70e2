//! Reports of a CiA 402 drive: status, position and mode in a TPDO, emergencies, answers to SDOs.

use embedded_can::Frame;

use super::Drive;
use super::power::State;
use crate::drive::Condition;
use crate::drive::frame::standard;
use crate::hub::Angle;

/// Payload of TPDO 1: 0x6041, 0x6064, 0x6061.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Status {
    /// 0x6041.
    pub statusword: u16,
    /// 0x6064, actual position, increments.
    pub position: i32,
    /// 0x6061, mode of operation in effect; 8 is cyclic synchronous position.
    pub mode: i8,
}

/// An emergency object: a fault's code (0x603F) and the error register (0x1001).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Emergency {
    /// Error code; 0 says that an error is gone.
    pub code: u16,
    /// Error register.
    pub register: u8,
}

impl Status {
    /// The condition; `Busy` for a statusword that the profile does not have.
    pub fn condition(&self) -> Condition {
        State::of(self.statusword).map_or(Condition::Busy, State::condition)
    }
}

impl Drive {
    /// The status in TPDO 1 of this drive.
    pub fn status(&self, frame: &impl Frame) -> Option<Status> {
        let &[s0, s1, p0, p1, p2, p3, mode] = self.received(0x180, frame)?;
        Some(Status {
            statusword: u16::from_le_bytes([s0, s1]),
            position: i32::from_le_bytes([p0, p1, p2, p3]),
            mode: i8::from_le_bytes([mode]),
        })
    }

    /// TPDO 1, as the drive sends it.
    pub fn status_frame<F: Frame>(&self, status: &Status) -> Option<F> {
        let [s0, s1] = status.statusword.to_le_bytes();
        let [p0, p1, p2, p3] = status.position.to_le_bytes();
        let [mode] = status.mode.to_le_bytes();
        F::new(standard(0x180 + u16::from(self.node)), &[s0, s1, p0, p1, p2, p3, mode])
    }

    /// RPDO 3: 0x6040, the controlword, and 0x6060, the mode, cyclic synchronous position.
    pub fn control<F: Frame>(&self, controlword: u16) -> Option<F> {
        let [low, high] = controlword.to_le_bytes();
        F::new(standard(0x400 + u16::from(self.node)), &[low, high, 8])
    }

    /// The shaft's angle at an actual position, turns from the encoder's zero.
    pub fn angle(&self, position: i32) -> Angle<f32> {
        let increments = i64::from(self.increments);
        let rest = i64::from(position).rem_euclid(increments);
        let turns = i64::from(position).div_euclid(increments) as i32;
        Angle { turns, part: 0.0 }.plus(rest as f32 / self.increments as f32)
    }

    /// The emergency in a frame of this drive.
    pub fn emergency(&self, frame: &impl Frame) -> Option<Emergency> {
        let &[low, high, register, ..] = self.received::<8>(0x080, frame)?;
        Some(Emergency { code: u16::from_le_bytes([low, high]), register })
    }

    /// The answer to an SDO download: done, or the abort's code. `None` for another frame.
    pub fn downloaded(&self, frame: &impl Frame) -> Option<Result<(), u32>> {
        match *self.received::<8>(0x580, frame)? {
            [0x60, ..] => Some(Ok(())),
            [0x80, _, _, _, c0, c1, c2, c3] => Some(Err(u32::from_le_bytes([c0, c1, c2, c3]))),
            _ => None,
        }
    }

    /// The bytes of a data frame of this drive with that function code.
    fn received<'a, const B: usize>(
        &self,
        function: u16,
        frame: &'a impl Frame,
    ) -> Option<&'a [u8; B]> {
        let id = standard(function + u16::from(self.node));
        let ours = frame.id() == id.into() && frame.is_data_frame();
        if ours { frame.data().try_into().ok() } else { None }
    }
}
