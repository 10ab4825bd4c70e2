//! Reports of an ODrive, and the frame that clears its errors.

use embedded_can::Frame;

use super::{CLOSED_LOOP, IDLE, Node, state};
use crate::drive::Condition;

const HEARTBEAT: u16 = 0x01;
const GET_ERROR: u16 = 0x03;
const SET_CONTROLLER_MODE: u16 = 0x0b;
const CLEAR_ERRORS: u16 = 0x18;
const SET_ABSOLUTE_POSITION: u16 = 0x19;

/// `CONTROL_MODE_POSITION_CONTROL`.
const POSITION_CONTROL: u32 = 3;

/// The cyclic Heartbeat, command 0x01.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Heartbeat {
    /// `axis.active_errors`; 0 for none.
    pub errors: u32,
    /// `axis.current_state`.
    pub state: u8,
    /// `axis.procedure_result`.
    pub procedure_result: u8,
}

/// The reply to Get_Error, command 0x03.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Errors {
    /// `axis.active_errors`.
    pub active: u32,
    /// `axis.disarm_reason`: what switched the drive off last.
    pub disarm_reason: u32,
}

/// `controller.config.input_mode` of a drive in position control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputMode {
    /// Setpoints as they come: `INPUT_MODE_PASSTHROUGH`.
    Passthrough = 1,
    /// Through a filter, which leaves the torque out: `INPUT_MODE_POS_FILTER`.
    Filtered = 3,
}

impl Errors {
    /// `DRV_FAULT`, a bit of [`Self::active`]: the gate driver reports an error.
    pub const DRIVER_FAULT: u32 = 0x20;
    /// `WATCHDOG_TIMER_EXPIRED`, a bit of [`Self::active`]: no setpoint came for too long.
    pub const WATCHDOG_EXPIRED: u32 = 0x0100_0000;
}

impl Heartbeat {
    /// Creates the heartbeat of a drive in closed-loop control or idle, with its active errors.
    pub fn new(on: bool, errors: u32) -> Self {
        Self { errors, state: state(on), procedure_result: 0 }
    }

    /// Idle is off, closed-loop control is on, any error is a fault.
    pub fn condition(&self) -> Condition {
        match (self.errors, self.state) {
            (0, IDLE) => Condition::Off,
            (0, CLOSED_LOOP) => Condition::On,
            (0, _) => Condition::Busy,
            (errors, _) => Condition::Fault(errors),
        }
    }
}

impl Node {
    /// The heartbeat in a frame of this node.
    pub fn heartbeat(self, frame: &impl Frame) -> Option<Heartbeat> {
        let &[e0, e1, e2, e3, state, procedure_result, ..] = self.of(HEARTBEAT, frame)?;
        Some(Heartbeat { errors: u32::from_le_bytes([e0, e1, e2, e3]), state, procedure_result })
    }

    /// A Heartbeat frame, as the drive sends it.
    pub fn heartbeat_frame<F: Frame>(self, heartbeat: &Heartbeat) -> Option<F> {
        let [e0, e1, e2, e3] = heartbeat.errors.to_le_bytes();
        let data = [e0, e1, e2, e3, heartbeat.state, heartbeat.procedure_result, 0, 0];
        F::new(self.id(HEARTBEAT), &data)
    }

    /// The request for the errors: the same frame, remote.
    pub fn request_errors<F: Frame>(self) -> Option<F> {
        F::new_remote(self.id(GET_ERROR), 8)
    }

    /// The errors in a Get_Error frame of this node.
    pub fn errors(self, frame: &impl Frame) -> Option<Errors> {
        let &[a0, a1, a2, a3, d0, d1, d2, d3] = self.of(GET_ERROR, frame)?;
        let active = u32::from_le_bytes([a0, a1, a2, a3]);
        Some(Errors { active, disarm_reason: u32::from_le_bytes([d0, d1, d2, d3]) })
    }

    /// Clear_Errors. The drive stays idle: switch it on anew.
    pub fn clear_errors<F: Frame>(self) -> Option<F> {
        F::new(self.id(CLEAR_ERRORS), &[0])
    }

    /// True for a Clear_Errors frame of this node.
    pub fn clears_errors(self, frame: &impl Frame) -> bool {
        self.payload(CLEAR_ERRORS, frame).is_some()
    }

    /// Set_Controller_Mode: position control with that input mode.
    pub fn position_control<F: Frame>(self, input: InputMode) -> Option<F> {
        let [c0, c1, c2, c3] = POSITION_CONTROL.to_le_bytes();
        let [i0, i1, i2, i3] = (input as u32).to_le_bytes();
        F::new(self.id(SET_CONTROLLER_MODE), &[c0, c1, c2, c3, i0, i1, i2, i3])
    }

    /// Set_Absolute_Position: from now on the encoder calls where it is `turns`. Re-homes a shaft
    /// that has turned so far that its f32 position loses counts, see [`super::super::Lost`]. Send
    /// it with the drive off: the setpoint does not move along.
    pub fn set_absolute_position<F: Frame>(self, turns: f32) -> Option<F> {
        if !turns.is_finite() {
            return None;
        }
        F::new(self.id(SET_ABSOLUTE_POSITION), &turns.to_le_bytes())
    }

    /// The turns in a Set_Absolute_Position frame of this node, if they are finite.
    pub fn absolute_position(self, frame: &impl Frame) -> Option<f32> {
        let bytes = self.payload(SET_ABSOLUTE_POSITION, frame)?.try_into().ok()?;
        Some(f32::from_le_bytes(bytes)).filter(|turns| turns.is_finite())
    }
}
