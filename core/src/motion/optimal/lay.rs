//! A time-optimal motion as segments, whose borders may lie between the ticks.

use core::f64::consts::TAU;

use super::{Piece, TimeOptimal};
use crate::Error;
use crate::error::MAX_TICKS;
use crate::hub::HubState;
use crate::math::Scalar;
use crate::motion::joiner::{Curve, Joiner};
use crate::motion::segment::Shape;
use crate::motion::{MoveSummary, Segment};

/// Part of a tick that is rounding: a motion from rest to rest that ends as little behind a tick is
/// not slowed down to the next one.
const ROUNDING: f64 = 1e-10;

impl TimeOptimal {
    /// Hands the segments of the motion to `sink`, first to last, with setpoints every `tick` s. A
    /// piece that holds no tick has one too, of [count](Segment::count) 0.
    ///
    /// A motion from rest to rest is slowed down until it ends at a tick. Another one ends inside
    /// of a tick, in general. The hub then keeps its rate for the rest of that tick and for the
    /// next one, whose segment carries what the arm feels of the end. A motion that ends within
    /// 1e-7 of a tick of one ends at it.
    ///
    /// # Errors
    /// A motion that takes more than 2²⁴ ticks; nothing has been handed over then.
    pub fn lay<T: Scalar>(
        &self,
        tick: f64,
        sink: &mut dyn FnMut(&Segment<T>),
    ) -> Result<MoveSummary, Error> {
        let longest = tick * f64::from(MAX_TICKS);
        Error::check("move.duration", self.duration(), 0.0, longest, "s")?;
        let motion = if self.rests() { self.ending_at_tick(tick) } else { self.clone() };
        let mut joiner = Joiner::new(*self.start(), tick);
        let mut time = 0.0;
        for (i, piece) in motion.pieces().iter().enumerate() {
            time += piece.duration;
            let last = i + 1 == motion.pieces().len();
            let until = time / tick;
            let end = if last { *self.end() } else { motion.state_after(piece) };
            let begin_acceleration = piece.acceleration;
            let curve = Curve { shape: piece.shape(), until, end, begin_acceleration };
            if let Some(segment) = joiner.append(&curve) {
                sink(&segment.cast());
            }
        }
        if joiner.ticks() as f64 > joiner.border() || joiner.ticks() == 0 {
            let until = joiner.ticks() as f64 + 1.0;
            let length = until - joiner.border();
            let curve = onward(joiner.here(), length, until, tick);
            if let Some(segment) = joiner.append(&curve) {
                sink(&segment.cast());
            }
        }
        let end = HubState::turning(joiner.here().angle, joiner.here().rate);
        let ticks = joiner.ticks() as u32;
        let rounded_by = f64::from(ticks) * tick - self.duration();
        Ok(MoveSummary { end, ticks, peaks: motion.peaks(), rounded_by })
    }

    /// True if the hub rests at the beginning and at the end.
    fn rests(&self) -> bool {
        let still = |hub: &HubState<f64>| hub.rate == 0.0 && hub.acceleration == 0.0;
        still(self.start()) && still(self.end())
    }

    /// Returns a motion from rest to rest, slowed down to end at a tick. By a factor σ the
    /// durations grow; rates, accelerations and jerks fall by σ, σ² and σ³.
    fn ending_at_tick(&self, tick: f64) -> Self {
        let ticks = libm::ceil(self.duration() / tick - ROUNDING).max(1.0);
        let factor = ticks * tick / self.duration();
        let mut slower = self.clone();
        if factor.is_finite() {
            slower.slow_down(factor);
        }
        slower
    }

    /// The hub at the end of a piece, with the acceleration from within.
    fn state_after(&self, piece: &Piece) -> HubState<f64> {
        let [turned, rate, acceleration] = piece.after(piece.duration);
        let angle = self.start().angle.plus(turned / TAU);
        HubState { acceleration, ..HubState::turning(angle, rate) }
    }
}

/// The hub's way on from `here` at constant rate, `length` ticks long.
fn onward(here: &HubState<f64>, length: f64, until: f64, tick: f64) -> Curve {
    let turned = here.rate * length * tick / TAU;
    let end = HubState::turning(here.angle.plus(turned), here.rate);
    Curve { shape: Shape::Cubic([0.5 * turned, 0.0, 0.0]), until, end, begin_acceleration: 0.0 }
}

impl Piece {
    /// Its cubic `c₁s + c₂s² + c₃s³`, about `s = ½`.
    fn shape(&self) -> Shape<f64> {
        let t = self.duration;
        let c1 = self.rate * t / TAU;
        let c2 = self.acceleration * t * t / (2.0 * TAU);
        let c3 = self.jerk * t * t * t / (6.0 * TAU);
        Shape::Cubic([(c1 + c2 + 0.75 * c3) / 2.0, (c2 + 1.5 * c3) / 4.0, c3 / 8.0])
    }
}
