//! Segments made, and rounded to what the tick works with.

use core::f64::consts::TAU;

use super::{End, Rest, Segment, Shape};
use crate::hub::{Angle, HubState};
use crate::math::{Each, Scalar};
use crate::motion::Peaks;
use crate::motion::piece::Ends;

impl<T: Scalar> Segment<T> {
    /// A segment of `length` ticks (not whole in general) that begins `before` ticks, 0 to 1,
    /// before the first tick that belongs to it. With `before = 0` its first angle is exact.
    pub(crate) fn new(
        start: Angle<f64>,
        shape: Shape<T>,
        length: T,
        before: T,
        count: u32,
        tick: f64,
    ) -> Self {
        let half = T::HALF * length * T::from_f64(tick);
        let [begin, _, end_acceleration] = shape.ends();
        let rate_scale = T::from_f64(TAU) / half;
        let acceleration_scale = T::TWO * rate_scale / half;
        let at_start = End { angle: start.cast(), rate: T::ZERO, acceleration: T::ZERO };
        let segment = Self {
            origin: start.plus(-begin.to_f64()).cast(),
            count,
            begin: at_start,
            offset: T::TWO * before / length - T::ONE,
            advance: T::TWO / length,
            rate_scale,
            acceleration_scale,
            end_acceleration: T::HALF * end_acceleration * acceleration_scale,
            kink_moment: T::ZERO,
            low: shape.low(),
            rest: shape.rest(),
        }
        .begun();
        if before == T::ZERO {
            let begin = End { angle: at_start.angle, ..segment.begin };
            return Self { begin, ..segment };
        }
        segment
    }

    /// Constant `rate` (rad/s) for `count` ticks.
    pub(crate) fn cruise(start: Angle<f64>, rate: f64, count: u32, tick: f64) -> Self {
        // At most ½ turn a tick by the rate check of `Plan`, so the product fits an i64.
        let step = (rate * tick * (18_446_744_073_709_551_616.0 / TAU)) as i64;
        Self::steady(start.cast(), T::from_f64(rate), step, count)
    }

    /// The quintic from the state `hub` through `turn` turns to `rate` (rad/s) without
    /// acceleration, in `count` ticks of `tick` s, and its peaks. Its tick 0 is the hub's own.
    /// Planned in the precision of the tick.
    pub(crate) fn from_hub(
        hub: &HubState<T>,
        turn: T,
        rate: T,
        count: u32,
        tick: f64,
    ) -> (Self, Peaks) {
        let duration = T::from_u32(count) * T::from_f64(tick);
        let ends = Ends::new(turn, [hub.rate, rate], [hub.acceleration, T::ZERO], duration);
        let piece = ends.quintic();
        let (start, length) = (hub.angle.precise(), T::from_u32(count));
        let segment = Self::new(start, Shape::Quintic(piece.0), length, T::ZERO, count, tick)
            .beginning(hub.rate, hub.acceleration)
            .ending(T::ZERO);
        (segment, piece.peaks(duration))
    }

    /// The hub `hub` at its rate, without a tick: planned in the precision of the tick, whose
    /// length is `tick` s.
    pub(crate) fn carried_on(hub: &HubState<T>, tick: T) -> Self {
        let n = T::from_f64;
        // Two parts of 30 bits, so that no wider scalar is needed: |turns a tick| is below ½.
        let (high, rest) = (hub.rate * tick * n(1073741824.0 / TAU)).split();
        let (low, _) = (rest * n(1073741824.0)).split();
        let step = (i64::from(high) << 34).wrapping_add(i64::from(low) << 4);
        Self::steady(hub.angle, hub.rate, step, 0)
    }

    /// At rest at `angle` for as long as ticks can be counted.
    pub(crate) fn rest(angle: Angle<T>) -> Self {
        Self::steady(angle, T::ZERO, 0, u32::MAX)
    }

    #[inline(always)]
    fn steady(origin: Angle<T>, rate: T, step: i64, count: u32) -> Self {
        Self {
            origin,
            count,
            begin: End { angle: origin, rate, acceleration: T::ZERO },
            offset: T::ZERO,
            advance: T::ZERO,
            rate_scale: T::ZERO,
            acceleration_scale: T::ZERO,
            end_acceleration: T::ZERO,
            kink_moment: T::ZERO,
            low: [T::ZERO; 3],
            rest: Rest::Cruise { rate, step },
        }
    }
}

impl Segment<f64> {
    /// Rounds to the scalar of the tick.
    pub fn cast<T: Scalar>(&self) -> Segment<T> {
        let f = T::from_f64;
        Segment {
            origin: self.origin.cast(),
            count: self.count,
            begin: End {
                angle: self.begin.angle.cast(),
                rate: f(self.begin.rate),
                acceleration: f(self.begin.acceleration),
            },
            offset: f(self.offset),
            advance: f(self.advance),
            rate_scale: f(self.rate_scale),
            acceleration_scale: f(self.acceleration_scale),
            end_acceleration: f(self.end_acceleration),
            kink_moment: f(self.kink_moment),
            low: self.low.each(f),
            rest: match self.rest {
                Rest::Cubic { steepest } => Rest::Cubic { steepest: f(steepest) },
                Rest::Quintic(high) => Rest::Quintic(high.each(f)),
                Rest::Harmonic(ab) => Rest::Harmonic(ab.each(f)),
                Rest::Bulged { high, d } => Rest::Bulged { high: high.each(f), d: d.each(f) },
                Rest::Cruise { rate, step } => Rest::Cruise { rate: f(rate), step },
            },
        }
    }
}
