//! Emulated drives on the bus. They follow at once and report their position.

use stillbeam::Angle;
use stillbeam::drive::ClassicFrame;
use stillbeam::drive::odrive::{EncoderEstimates, Node};
use stillbeam_protocol::slcan;

/// An ODrive whose shaft is at its latest setpoint.
#[derive(Clone, Copy, Debug)]
pub struct Drive {
    node: Node,
    /// Position, turns.
    position: f32,
    /// Velocity, turns/s.
    velocity: f32,
    /// True in closed-loop control.
    on: bool,
}

impl Drive {
    /// Creates a drive that is off, its shaft at `position` turns.
    pub fn new(node: Node, position: f32) -> Self {
        Self { node, position, velocity: 0.0, on: false }
    }

    /// Takes a frame from the bus, if it is this drive's.
    pub fn hear(&mut self, frame: &ClassicFrame) {
        if let Some(on) = self.node.axis_state(frame) {
            self.on = on;
        }
        if let Some(demand) = self.node.demand(frame) {
            self.position = demand.position.in_turns() as f32;
            self.velocity = demand.velocity;
        }
    }

    /// Returns the bus message with the position of the shaft.
    pub fn estimates(&self) -> Vec<u8> {
        let velocity = if self.on { self.velocity } else { 0.0 };
        let estimates = EncoderEstimates { position: self.position, velocity };
        self.node
            .estimates_frame(&estimates)
            .map(|frame| slcan::encode(&frame, 0).bytes().to_vec())
            .unwrap_or_default()
    }

    /// True if it is in closed-loop control.
    pub fn is_on(&self) -> bool {
        self.on
    }

    /// Returns the shaft's angle as the firmware understands it.
    pub fn shaft(&self) -> Angle<f32> {
        Angle { turns: 0, part: 0.0 }.plus(self.position)
    }
}
