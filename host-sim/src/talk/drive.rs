//! Emulated drives on the bus. They follow at once and report their position, or they turn a
//! machine and report its encoder.

use stillbeam::drive::ClassicFrame;
use stillbeam::drive::odrive::{EncoderEstimates, Errors, Heartbeat, Node};
use stillbeam_protocol::slcan;

use super::body::Body;
use crate::error::Error;

/// Interval of the heartbeats, s: ODrive's own default.
const HEARTBEAT: f64 = 0.1;

/// Time without a setpoint after which a drive that is on switches itself off, s: ODrive's
/// `watchdog_timeout`.
const WATCHDOG: f64 = 0.1;

/// An ODrive. Its shaft is at its latest setpoint, or where its machine is.
pub struct Drive {
    node: Node,
    /// Position, turns.
    position: f32,
    /// Velocity, turns/s.
    velocity: f32,
    /// True in closed-loop control.
    on: bool,
    /// Errors that switched it off, until they are cleared; 0 for none.
    errors: u32,
    /// True while no frame comes or goes.
    cut: bool,
    /// Time since the latest setpoint, s.
    starved: f64,
    /// The latest heartbeat, with the time since then, s.
    said: Option<(Heartbeat, f64)>,
    body: Option<Body>,
}

impl Drive {
    /// Creates a drive that is off, its shaft at `position` turns.
    pub fn new(node: Node, position: f32) -> Self {
        Self {
            node,
            position,
            velocity: 0.0,
            on: false,
            errors: 0,
            cut: false,
            starved: 0.0,
            said: None,
            body: None,
        }
    }

    /// Creates a drive that is off and turns a machine.
    pub fn with_body(node: Node, body: Body) -> Self {
        let position = body.reading() as f32;
        Self { body: Some(body), ..Self::new(node, position) }
    }

    /// Goes on for a tick of `tick` s.
    ///
    /// # Errors
    /// A machine that cannot be simulated on.
    pub fn advance(&mut self, tick: f64) -> Result<(), Error> {
        if let Some((_, since)) = &mut self.said {
            *since += tick;
        }
        let Some(body) = &mut self.body else { return Ok(()) };
        body.advance(self.on)?;
        self.position = body.reading() as f32;
        Ok(())
    }

    /// Waits for the setpoint of a tick of `tick` s that the firmware has made. While it plans, its
    /// ticks are heard of later than they are granted.
    pub fn await_setpoint(&mut self, tick: f64) {
        self.starved += tick;
        if self.on && self.starved > WATCHDOG + 0.5 * tick {
            (self.on, self.errors) = (false, Errors::WATCHDOG_EXPIRED);
        }
    }

    /// Switches itself off, with a brake, until its errors are cleared.
    pub fn fail(&mut self) {
        (self.on, self.errors) = (false, Errors::DRIVER_FAULT);
    }

    /// Cuts its line to the bus, or mends it.
    pub fn cut(&mut self, cut: bool) {
        self.cut = cut;
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
        if self.cut {
            return;
        }
        if self.node.clears_errors(frame) {
            self.errors = 0;
        }
        if let Some(turns) = self.node.absolute_position(frame) {
            self.position = turns;
            if let Some(body) = &mut self.body {
                body.call_it(turns.into());
            }
        }
        if let Some(on) = self.node.axis_state(frame) {
            let begins = on && !self.on && self.errors == 0;
            self.on = on && self.errors == 0;
            if let (true, Some(body)) = (begins, &mut self.body) {
                body.enable();
            }
        }
        if let Some(demand) = self.node.demand(frame) {
            self.starved = 0.0;
            if let Some(body) = &mut self.body {
                body.command(&demand);
                return;
            }
            self.position = demand.position.in_turns() as f32;
            self.velocity = demand.velocity;
        }
    }

    /// Returns the frames that it sends at a tick: its position, and its heartbeat if that is due
    /// and leaves the bus' lines within `room` bytes. With `busy`, one that says something new
    /// waits for a tick without requests: the firmware may take either first.
    pub fn reports(&mut self, busy: bool, room: usize) -> Vec<ClassicFrame> {
        if self.cut {
            return Vec::new();
        }
        let velocity = if self.on { self.velocity } else { 0.0 };
        let estimates = EncoderEstimates { position: self.position, velocity };
        let mut frames: Vec<ClassicFrame> =
            self.node.estimates_frame(&estimates).into_iter().collect();
        let heartbeat = Heartbeat::new(self.on, self.errors);
        let (last, since) = self.said.map_or((None, f64::INFINITY), |(h, t)| (Some(h), t));
        let due = since > HEARTBEAT - 1e-6;
        let waits = busy && last.is_some_and(|last| last != heartbeat) && since < 2.0 * HEARTBEAT;
        if due
            && !waits
            && let Some(frame) = self.node.heartbeat_frame(&heartbeat)
            && line(&frame).len() + frames.iter().map(|f| line(f).len()).sum::<usize>() <= room
        {
            frames.push(frame);
            self.said = Some((heartbeat, 0.0));
        }
        frames
    }

    /// True if it is in closed-loop control.
    pub fn is_on(&self) -> bool {
        self.on
    }
}

/// Returns the bus' line of a frame from a drive.
pub(super) fn line(frame: &ClassicFrame) -> Vec<u8> {
    slcan::encode(frame, 0).bytes().to_vec()
}
