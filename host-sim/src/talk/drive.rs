//! Emulated drives on the bus. They follow at once and report their position, or they turn a
//! machine and report its encoder.

use stillbeam::Angle;
use stillbeam::drive::ClassicFrame;
use stillbeam::drive::odrive::{EncoderEstimates, Node};
use stillbeam_protocol::slcan;

use super::body::Body;
use crate::error::Error;

/// An ODrive. Its shaft is at its latest setpoint, or where its machine is.
pub struct Drive {
    node: Node,
    /// Position, turns.
    position: f32,
    /// Velocity, turns/s.
    velocity: f32,
    /// True in closed-loop control.
    on: bool,
    /// True after a fault, until it is cleared.
    faulty: bool,
    body: Option<Body>,
}

impl Drive {
    /// Creates a drive that is off, its shaft at `position` turns.
    pub fn new(node: Node, position: f32) -> Self {
        Self { node, position, velocity: 0.0, on: false, faulty: false, body: None }
    }

    /// Creates a drive that is off and turns a machine.
    pub fn with_body(node: Node, body: Body) -> Self {
        let position = body.reading() as f32;
        Self { body: Some(body), ..Self::new(node, position) }
    }

    /// Lets the machine run for a tick, if there is one.
    ///
    /// # Errors
    /// A machine that cannot be simulated on.
    pub fn advance(&mut self) -> Result<(), Error> {
        let Some(body) = &mut self.body else { return Ok(()) };
        body.advance(self.on)?;
        self.position = body.reading() as f32;
        Ok(())
    }

    /// Switches itself off, with a brake, and stays so until [`Self::clear`].
    pub fn fail(&mut self) {
        (self.on, self.faulty) = (false, true);
    }

    /// Clears a fault. The drive stays off until it is switched on.
    pub fn clear(&mut self) {
        self.faulty = false;
    }

    /// The machine behind the drive.
    pub fn body(&self) -> Option<&Body> {
        self.body.as_ref()
    }

    /// The machine behind the drive, to be tampered with.
    pub fn body_mut(&mut self) -> Option<&mut Body> {
        self.body.as_mut()
    }

    /// Takes a frame from the bus, if it is this drive's.
    pub fn hear(&mut self, frame: &ClassicFrame) {
        if let Some(on) = self.node.axis_state(frame) {
            let begins = on && !self.on && !self.faulty;
            self.on = on && !self.faulty;
            if let (true, Some(body)) = (begins, &mut self.body) {
                body.enable();
            }
        }
        if let Some(demand) = self.node.demand(frame) {
            if let Some(body) = &mut self.body {
                body.command(&demand);
                return;
            }
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
