//! The drive at the other end of the bus.

use stillbeam::axis::Mode;
use stillbeam::drive::ClassicFrame;
use stillbeam::drive::odrive::{EncoderEstimates, Heartbeat, Node};

use crate::board::Step;
use stillbeam_wiring::Order;

/// A drive that follows its setpoints and reports its position.
pub struct Drive {
    position: f32,
}

impl Drive {
    /// Creates a drive at rest at `position`, turns.
    pub fn at(position: f32) -> Self {
        Self { position }
    }

    /// Takes a setpoint.
    pub fn follow(&mut self, step: &Step) {
        if step.tick.mode != Mode::Disabled {
            self.position = step.demand.position.in_turns() as f32;
        }
    }

    /// Returns the frame with the encoder's position.
    pub fn report(&self, node: Node) -> ClassicFrame {
        let estimates = EncoderEstimates { position: self.position, velocity: 0.0 };
        // Eight bytes are a frame.
        node.estimates_frame(&estimates).unwrap_or_else(|| unreachable!("eight bytes"))
    }

    /// Its heartbeat without errors: in closed-loop control, or idle.
    pub fn heartbeat(&self, node: Node, on: bool) -> Option<ClassicFrame> {
        node.heartbeat_frame(&Heartbeat::new(on, 0))
    }

    /// Carries out what the firmware tells it beside the setpoints.
    pub fn obey(&mut self, order: Order) {
        if let Order::SetPosition(turns) = order {
            self.position = turns;
        }
    }
}
