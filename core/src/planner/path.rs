//! The curve of a still move, before its bulge.

use crate::math::{Each, array};
use core::f64::consts::TAU;

use crate::hub::HubState;
use crate::motion::segment::Shape;
use crate::motion::{BULGE, Segment};

/// A quintic from any state of the hub to `to`, where it turns at `rate` without acceleration;
/// continuous in angle, rate and acceleration at both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Path {
    pub from: HubState<f64>,
    /// rad.
    pub to: f64,
    /// rad/s.
    pub rate: f64,
    pub ticks: u32,
    /// s.
    pub tick: f64,
}

/// Sixteenths of `u … u⁵` of the quintics that turn by 1; that begin with a rate of 1 and end where
/// they began; that end with a rate of 1 likewise; that begin with an acceleration of 1. Per `u`.
const TURN: [f64; 5] = [15.0, 0.0, -10.0, 0.0, 3.0];
const RATE: [f64; 5] = [-7.0, -6.0, 10.0, 1.0, -3.0];
const END_RATE: [f64; 5] = [-7.0, 6.0, 10.0, -1.0, -3.0];
const ACCELERATION: [f64; 5] = [-1.0, -2.0, 2.0, 1.0, -1.0];

impl Path {
    /// Duration T, s.
    pub fn duration(&self) -> f64 {
        f64::from(self.ticks) * self.tick
    }

    /// Turns from beginning to end.
    pub fn turn(&self) -> f64 {
        self.to / TAU - self.from.angle.in_turns()
    }

    /// `c₁ … c₅` of the quintic, turns.
    pub fn quintic(&self) -> [f64; 5] {
        let half = 0.5 * self.duration();
        let turn = self.turn();
        let rate = self.from.rate * half / TAU;
        let end_rate = self.rate * half / TAU;
        let acceleration = self.from.acceleration * half * half / TAU;
        array(|k| {
            let begin = RATE[k] * rate + ACCELERATION[k] * acceleration;
            (TURN[k] * turn + begin + END_RATE[k] * end_rate) / 16.0
        })
    }

    /// The quintic with a bulge in rad.
    pub fn segment(&self, bulge: &[f64; BULGE]) -> Segment<f64> {
        let shape = Shape::Bulged { c: self.quintic(), d: bulge.each(|b| b / TAU) };
        let length = f64::from(self.ticks);
        Segment::new(self.from.angle, shape, length, 0.0, self.ticks, self.tick)
            .beginning(self.from.rate, self.from.acceleration)
            .ending(0.0)
    }
}
