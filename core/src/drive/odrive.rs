//! ODrive "CAN simple": `Set_Input_Pos`, `Set_Axis_State`, `Get_Encoder_Estimates`, and the
//! `Heartbeat` with its errors.
//!
//! Identifier `node << 5 | command`, 11 bits. Set_Input_Pos is command 0x0C: position f32 (turns),
//! velocity feed-forward i16 (0.001 turn/s), torque feed-forward i16 (0.001 N m), the drive's
//! default scales. Source: ODrive documentation, CAN Protocol, and its `odrive-cansimple.dbc`.

mod heartbeat;

use embedded_can::Frame;

pub use heartbeat::{Errors, Heartbeat, InputMode};

use super::counts::count_i16;
use super::frame::standard;
use super::{Encoded, Range, Saturated, WHOLE_TURNS};
use crate::Error;
use crate::hub::Angle;
use crate::motor::Demand;

/// N m a count of the torque feed-forward.
pub const TORQUE_STEP: f32 = 0.001;

/// Values of a Set_Input_Pos frame.
pub const RANGE: Range = Range { position: WHOLE_TURNS, velocity: 32.767, torque: 32.767 };

const SET_AXIS_STATE: u16 = 0x07;
const SET_INPUT_POS: u16 = 0x0c;
const GET_ENCODER_ESTIMATES: u16 = 0x09;
const PER_UNIT: f32 = 1000.0;

/// `AXIS_STATE_IDLE` and `AXIS_STATE_CLOSED_LOOP_CONTROL`.
const IDLE: u8 = 1;
const CLOSED_LOOP: u8 = 8;

/// An axis by its node id, 0 to 63.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Node(u8);

/// Angle and rate of the shaft as the encoder measures them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EncoderEstimates {
    /// Turns.
    pub position: f32,
    /// Turns/s.
    pub velocity: f32,
}

impl EncoderEstimates {
    /// The position as an angle. `None` if it is not finite or 2²¹ − ½ turns and more.
    pub fn angle(&self) -> Option<Angle<f32>> {
        super::turns(self.position)
    }
}

impl Node {
    /// The node of that id.
    pub fn new(id: u8) -> Result<Self, Error> {
        Error::check("drive.node", f64::from(id), 0.0, 63.0, "")?;
        Ok(Self(id))
    }

    /// The Set_Input_Pos frame. `None` if a value is not finite.
    ///
    /// The position is one f32: its step is 6e-8 of the turns gone since the encoder's zero.
    pub fn set_input_pos<F: Frame>(self, demand: &Demand<f32>) -> Option<Encoded<F>> {
        let Encoded { payload, saturated } = encode(demand)?;
        let payload = F::new(self.id(SET_INPUT_POS), &payload)?;
        Some(Encoded { payload, saturated })
    }

    /// The demand in a Set_Input_Pos frame of this node.
    pub fn demand(self, frame: &impl Frame) -> Option<Demand<f32>> {
        decode(self.of(SET_INPUT_POS, frame)?)
    }

    /// Set_Axis_State: on (8, closed-loop control) or off (1, idle). Send a position first, so that
    /// the drive does not begin at an old one.
    pub fn set_axis_state<F: Frame>(self, on: bool) -> Option<F> {
        F::new(self.id(SET_AXIS_STATE), &[state(on), 0, 0, 0])
    }

    /// Reads Set_Axis_State for this node: true if it switches on, false if off, `None` if it is
    /// another frame.
    pub fn axis_state(self, frame: &impl Frame) -> Option<bool> {
        match self.payload(SET_AXIS_STATE, frame)? {
            [CLOSED_LOOP, 0, 0, 0] => Some(true),
            [IDLE, 0, 0, 0] => Some(false),
            _ => None,
        }
    }

    /// The request for the encoder's estimates: the same frame, remote.
    pub fn request_estimates<F: Frame>(self) -> Option<F> {
        F::new_remote(self.id(GET_ENCODER_ESTIMATES), 8)
    }

    /// A Get_Encoder_Estimates frame, as the drive sends it.
    pub fn estimates_frame<F: Frame>(self, estimates: &EncoderEstimates) -> Option<F> {
        let [p, v] = [estimates.position, estimates.velocity].map(f32::to_le_bytes);
        F::new(self.id(GET_ENCODER_ESTIMATES), &[p[0], p[1], p[2], p[3], v[0], v[1], v[2], v[3]])
    }

    /// The estimates in such a frame of this node, if they are finite.
    pub fn estimates(self, frame: &impl Frame) -> Option<EncoderEstimates> {
        let &[p0, p1, p2, p3, v0, v1, v2, v3] = self.of(GET_ENCODER_ESTIMATES, frame)?;
        let position = f32::from_le_bytes([p0, p1, p2, p3]);
        let velocity = f32::from_le_bytes([v0, v1, v2, v3]);
        let finite = position.is_finite() && velocity.is_finite();
        finite.then_some(EncoderEstimates { position, velocity })
    }

    fn id(self, command: u16) -> embedded_can::StandardId {
        standard(u16::from(self.0) << 5 | command)
    }

    /// The bytes of a data frame of this node and command.
    fn payload<F: Frame>(self, command: u16, frame: &F) -> Option<&[u8]> {
        let ours = frame.id() == self.id(command).into() && frame.is_data_frame();
        ours.then(|| frame.data())
    }

    /// The eight bytes of a data frame of this node and command.
    fn of<F: Frame>(self, command: u16, frame: &F) -> Option<&[u8; 8]> {
        self.payload(command, frame)?.try_into().ok()
    }
}

/// The axis state of a drive that is on or off.
fn state(on: bool) -> u8 {
    if on { CLOSED_LOOP } else { IDLE }
}

/// Payload of Set_Input_Pos. `None` if a value is not finite.
pub fn encode(demand: &Demand<f32>) -> Option<Encoded<[u8; 8]>> {
    if !demand.is_finite() {
        return None;
    }
    let p = (demand.position.turns as f32 + demand.position.part).to_le_bytes();
    let (velocity, velocity_cut) = count_i16(demand.velocity, PER_UNIT);
    let (torque, torque_cut) = count_i16(demand.torque, PER_UNIT);
    let (v, t) = (velocity.to_le_bytes(), torque.to_le_bytes());
    Some(Encoded {
        payload: [p[0], p[1], p[2], p[3], v[0], v[1], t[0], t[1]],
        saturated: Saturated { position: false, velocity: velocity_cut, torque: torque_cut },
    })
}

/// The demand in a payload. `None` if the position is not finite or 2²¹ − ½ turns and more.
pub fn decode(payload: &[u8; 8]) -> Option<Demand<f32>> {
    let &[p0, p1, p2, p3, v0, v1, t0, t1] = payload;
    let position = f32::from_le_bytes([p0, p1, p2, p3]);
    let (velocity, torque) = (i16::from_le_bytes([v0, v1]), i16::from_le_bytes([t0, t1]));
    Some(Demand {
        position: super::turns(position)?,
        velocity: f32::from(velocity) / PER_UNIT,
        torque: f32::from(torque) / PER_UNIT,
    })
}
