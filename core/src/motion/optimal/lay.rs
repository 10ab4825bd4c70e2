//! A time-optimal motion as segments, whose borders may lie between the ticks.

use core::f64::consts::TAU;

use super::{Piece, TimeOptimal};
use crate::Error;
use crate::error::MAX_TICKS;
use crate::hub::{Angle, HubState};
use crate::math::Scalar;
use crate::motion::cubics::moment;
use crate::motion::segment::Shape;
use crate::motion::{MoveSummary, Segment};

/// Part of a tick that is rounding. Borders that lie as close to a tick are moved to it, and pieces
/// as short are left out.
const ROUNDING: f64 = 1e-6;

impl TimeOptimal {
    /// Hands the segments of the motion to `sink`, first to last, with setpoints every `tick` s.
    ///
    /// A motion from rest to rest is slowed down until it ends at a tick. Another one ends inside
    /// of a tick, in general. The hub then keeps its rate for the rest of that tick and for the
    /// next one, whose segment carries what the arm feels of the end.
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
        let mut laying = Laying { start: self.start().angle, tick, ..Laying::NEW };
        let mut end = 0.0;
        for piece in motion.pieces() {
            end += piece.duration / tick;
            laying.add(piece, whole(end), sink);
        }
        let after = f64::from(laying.first) - laying.border;
        let mut last = *self.end();
        last.angle = last.angle.plus(last.rate * tick * after / TAU);
        let mut ticks = laying.first;
        if after > 0.0 || ticks == 0 {
            let mut segment = Segment::cruise(last.angle, last.rate, 1, tick);
            segment.set_kink_moment(laying.kink_moment);
            sink(&segment);
            ticks += 1;
            last.angle = last.angle.plus(last.rate * tick / TAU);
        }
        let rounded_by = f64::from(ticks) * tick - self.duration();
        let end = HubState::turning(last.angle, last.rate);
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
        let ticks = whole(self.duration() / tick);
        let factor = libm::ceil(ticks) * tick / self.duration();
        let mut slower = self.clone();
        if factor.is_finite() {
            slower.slow_down(factor);
        }
        slower
    }
}

/// Returns a number of ticks, rounded if it is as good as whole.
fn whole(ticks: f64) -> f64 {
    let nearest = libm::round(ticks);
    if libm::fabs(ticks - nearest) <= ROUNDING { nearest } else { ticks }
}

/// Segments under construction.
struct Laying<T> {
    /// Angle at the beginning.
    start: Angle<f64>,
    /// h, s.
    tick: f64,
    /// First tick of the next segment.
    first: u32,
    /// End of what is laid, ticks.
    border: f64,
    /// What the tick before `first` has felt of the borders in it: see [`Segment::kink_moment`].
    kink_moment: T,
}

impl<T: Scalar> Laying<T> {
    const NEW: Self = Self {
        start: Angle { turns: 0, part: 0.0 },
        tick: 0.0,
        first: 0,
        border: 0.0,
        kink_moment: T::ZERO,
    };

    /// Adds a piece that goes on to `end`, ticks. One that contains no tick leaves but its part of
    /// the kink.
    fn add(&mut self, piece: &Piece, end: f64, sink: &mut dyn FnMut(&Segment<T>)) {
        let n = T::from_f64;
        let next = libm::ceil(end) as u32;
        let length = end - self.border;
        let before = f64::from(self.first) - self.border;
        let after = f64::from(next) - end;
        if length <= ROUNDING {
            self.border = end;
            return;
        }
        let [_, _, end_acceleration] = piece.after(piece.duration);
        let [begin, end_acceleration] = [n(piece.acceleration), n(end_acceleration)];
        let [from, to] = [n(1.0 - before), n(1.0 - after)];
        if next == self.first {
            self.kink_moment += moment(from, to, begin, end_acceleration);
        } else {
            let mut segment = self.segment(piece, length, before, next).ending(end_acceleration);
            if before == 0.0 {
                segment = segment.beginning(n(piece.rate), begin);
                self.kink_moment = T::ZERO;
            }
            let [at_first, at_last] = segment.accelerations();
            self.kink_moment += moment(from, T::ONE, begin, at_first);
            segment.set_kink_moment(self.kink_moment);
            sink(&segment);
            // The tick's parabola goes up to the left-hand value at the border.
            let parabola = n(1.0 / 12.0) * (at_last - end_acceleration);
            self.kink_moment = moment(T::ZERO, to, at_last, end_acceleration) - parabola;
        }
        (self.first, self.border) = (next, end);
    }

    /// A piece of `length` ticks that begins `before` ticks before its first tick.
    fn segment(&self, piece: &Piece, length: f64, before: f64, next: u32) -> Segment<T> {
        let t = length * self.tick;
        let c1 = piece.rate * t / TAU;
        let c2 = piece.acceleration * t * t / (2.0 * TAU);
        let c3 = piece.jerk * t * t * t / (6.0 * TAU);
        // c₁s + c₂s² + c₃s³ about s = ½.
        let cubic = [(c1 + c2 + 0.75 * c3) / 2.0, (c2 + 1.5 * c3) / 4.0, c3 / 8.0];
        let n = T::from_f64;
        let start = self.start.plus(piece.turned / TAU);
        let shape = Shape::Cubic(cubic.map(n));
        Segment::new(start, shape, n(length), n(before), next - self.first, self.tick)
    }
}
