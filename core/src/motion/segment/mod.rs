//! A piece of the commanded motion in the form that the tick evaluates.

mod border;
mod braking;
mod ends;
mod setup;
mod shape;

pub use braking::Braking;
pub(crate) use shape::Shape;

use super::curve::{BULGE, Derivatives, bulge, cubic, harmonic, quintic};
use crate::hub::{Angle, HubState};
use crate::math::Scalar;

/// A stretch of the motion with one formula, `u = −1..1` over its length. About the middle the
/// coefficients are small and nothing cancels: rounding is an eighth of that in `0..1`.
///
/// The first tick that belongs to a segment may lie a fraction of a tick after its beginning: the
/// thirds of a trapezoid need not be whole ticks. Where the next tick lies behind its end, no tick
/// belongs to it: its [count](Self::count) is 0, and [`Self::hub_at`] alone gives the hub in it.
///
/// Error in f32: angle 2e-7 of the segment's own turn (a cruise: 3e-8 turn, however long), rate
/// 5e-7 and acceleration 1e-6 of their peaks. The hub at tick 0 and the acceleration at the end are
/// stored apart from the formula: of a move's first and last segment they are exact, correctly
/// rounded to the scalar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment<T> {
    /// Angle at `u = 0`; of a cruise, at its first tick.
    origin: Angle<T>,
    /// Ticks that belong to the segment.
    count: u32,
    /// The hub at the first of them.
    begin: End<T>,
    /// `u` at the first of them.
    offset: T,
    /// `u` a tick.
    advance: T,
    /// `4π / D`, turns per `u` to rad/s, `D` the length in seconds.
    rate_scale: T,
    /// `16π / D²`, half of `d²Δ/du²` to rad/s².
    acceleration_scale: T,
    /// θ̈ at `u = 1`, from the left.
    end_acceleration: T,
    /// See [`Self::kink_moment`].
    kink_moment: T,
    /// Coefficients `c₁`, `c₂`, `c₃` of a cubic; the first coefficients of the other shapes.
    low: [T; 3],
    rest: Rest<T>,
}

/// The hub at an end of a segment, but for its sine and cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
struct End<T> {
    angle: Angle<T>,
    /// rad/s.
    rate: T,
    /// rad/s².
    acceleration: T,
}

/// Part of a shape beyond its first three coefficients. It is kept apart from those, so that a tick
/// of a cubic need not look which shape it is, and taking a cubic up copies nothing else.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Rest<T> {
    Cubic {
        /// Upper bound of `|dΔ/du|`.
        steepest: T,
    },
    /// `c₄`, `c₅`.
    Quintic([T; 2]),
    /// `a`, `b`.
    Harmonic([T; 2]),
    Bulged {
        high: [T; 2],
        d: [T; BULGE],
    },
    /// Constant rate (rad/s). `step / 2⁶⁴` turns a tick, multiplied out in integers: after 10⁹
    /// ticks the angle is within 6e-11 turn.
    Cruise {
        rate: T,
        step: i64,
    },
}

impl<T: Scalar> Segment<T> {
    /// The hub at the segment's tick `k`, `k < count`.
    pub fn hub(&self, k: u32) -> HubState<T> {
        let mut hub = HubState::ZERO;
        if k == 0 {
            self.begin(&mut hub);
        } else {
            self.drive_otherwise(&mut hub, k);
        }
        (hub.sin, hub.cos) = hub.angle.sin_cos();
        hub
    }

    /// The hub's angle at the segment's tick `k`, `k < count`.
    #[inline(never)]
    pub(crate) fn angle(&self, k: u32) -> Angle<T> {
        let mut hub = HubState::ZERO;
        if k == 0 {
            self.begin(&mut hub);
        } else {
            self.drive_otherwise(&mut hub, k);
        }
        hub.angle
    }

    /// Moves the hub, but for its sine and cosine, to the segment's tick `k`, `0 < k < count`.
    /// Tick 0 is [`Self::begin`]'s: the formula gives it too, but rounded.
    #[inline(always)]
    pub(crate) fn drive(&self, hub: &mut HubState<T>, k: u32) {
        if self.is_cubic() {
            self.drive_cubic(hub, k);
        } else {
            self.drive_otherwise(hub, k);
        }
    }

    /// Does the work of [`Self::drive`] for a cubic.
    #[inline(always)]
    pub(crate) fn drive_cubic(&self, hub: &mut HubState<T>, k: u32) {
        let u = self.offset + T::from_u32(k) * self.advance;
        (hub.angle, hub.rate, hub.acceleration) = self.scaled(cubic(self.low, u));
    }

    /// Does the work of [`Self::drive`] for the other shapes. Kept apart, as most ticks are of
    /// cubics.
    #[inline(never)]
    pub(crate) fn drive_otherwise(&self, hub: &mut HubState<T>, k: u32) {
        (hub.angle, hub.rate, hub.acceleration) = match self.rest {
            Rest::Cruise { rate, step } => (self.origin.cruise(step, k), rate, T::ZERO),
            _ => self.scaled(self.derivatives(self.offset + T::from_u32(k) * self.advance)),
        };
    }

    #[inline(always)]
    fn derivatives(&self, u: T) -> Derivatives<T> {
        let [c1, c2, c3] = self.low;
        match self.rest {
            Rest::Cubic { .. } => cubic(self.low, u),
            Rest::Quintic([c4, c5]) => quintic([c1, c2, c3, c4, c5], u),
            Rest::Bulged { high: [c4, c5], d } => {
                let (base, bulge) = (quintic([c1, c2, c3, c4, c5], u), bulge(&d, u));
                (base.0 + bulge.0, base.1 + bulge.1, base.2 + bulge.2)
            }
            Rest::Harmonic([a, b]) => harmonic([c1, c2], a, b, u),
            Rest::Cruise { .. } => (T::ZERO, T::ZERO, T::ZERO),
        }
    }

    #[inline(always)]
    fn scaled(&self, (delta, first, half_second): Derivatives<T>) -> (Angle<T>, T, T) {
        let rate = first * self.rate_scale;
        (self.origin.plus(delta), rate, half_second * self.acceleration_scale)
    }

    /// Returns the hub any real number of ticks after the segment's first, for solvers that choose
    /// their own steps. `ticks` may be negative, down to the segment's true beginning.
    pub fn hub_at(&self, ticks: T) -> HubState<T> {
        let (angle, rate, acceleration) = self.angle_at(ticks);
        let (sin, cos) = angle.sin_cos();
        HubState { angle, rate, acceleration, sin, cos }
    }

    /// Angle, rate and acceleration of [`Self::hub_at`], without sine and cosine.
    #[inline(always)]
    pub(crate) fn angle_at(&self, ticks: T) -> (Angle<T>, T, T) {
        if ticks == T::ZERO {
            return (self.begin.angle, self.begin.rate, self.begin.acceleration);
        }
        match self.rest {
            Rest::Cruise { rate, step } => {
                (self.origin.plus(T::from_fraction(step) * ticks), rate, T::ZERO)
            }
            _ => self.scaled(self.derivatives(self.offset + ticks * self.advance)),
        }
    }

    /// Ticks from the segment's true beginning to its first tick, or the next one, 0 to 1.
    pub fn ticks_before(&self) -> T {
        if self.advance == T::ZERO { T::ZERO } else { (self.offset + T::ONE) / self.advance }
    }

    /// Ticks that belong to the segment; 0 if none lies within it.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// θ̈ at the segment's end, from the left, rad/s².
    pub fn end_acceleration(&self) -> T {
        self.end_acceleration
    }

    /// Returns the same quintic with another bulge, turns; any other shape unchanged.
    #[inline(always)]
    pub(crate) fn bulged(mut self, bulge: &[T; BULGE]) -> Self {
        if let Rest::Bulged { d, .. } = &mut self.rest {
            *d = *bulge;
        }
        self
    }

    /// Moment of the border within the tick before, rad/s²: excess of `∫₀¹(1 − s)θ̈ ds` over that
    /// of the parabola with the same mean and ends. The later end is the left-hand value at the
    /// border. Zero where the border is a tick and the stretch before it holds one. The stepper
    /// takes it in by
    /// [`Stepper::kink`](crate::Stepper::kink).
    ///
    /// Of a segment without a tick that ends at one: moment of all borders within that tick, for
    /// what comes behind.
    pub fn kink_moment(&self) -> T {
        self.kink_moment
    }

    /// Gives the segment that moment.
    pub(crate) fn set_kink_moment(&mut self, kink_moment: T) {
        self.kink_moment = kink_moment;
    }

    /// θ̈ of a cubic at its first tick and at its last.
    pub(crate) fn accelerations(&self) -> [T; 2] {
        if !self.is_cubic() {
            return [T::ZERO; 2];
        }
        let [_, c2, c3] = self.low;
        let scale = self.acceleration_scale;
        let (middle, slope) = (c2 * scale, (T::TWO + T::ONE) * c3 * scale);
        let last = self.offset + T::from_u32(self.count.saturating_sub(1)) * self.advance;
        [self.begin.acceleration, middle + slope * last]
    }

    /// True if it is a cubic: its θ̈ is then a straight line.
    #[inline(always)]
    pub(crate) fn is_cubic(&self) -> bool {
        matches!(self.rest, Rest::Cubic { .. })
    }

    /// A bound of `|θ̇|` over a cubic, rad/s; of the other shapes 0.
    #[inline(always)]
    pub(crate) fn rate_bound(&self) -> T {
        if let Rest::Cubic { steepest } = self.rest { steepest * self.rate_scale } else { T::ZERO }
    }

    /// True if the hub stays where it is.
    #[inline(always)]
    pub(crate) fn is_rest(&self) -> bool {
        matches!(self.rest, Rest::Cruise { rate, step: 0 } if rate == T::ZERO)
    }

    /// Copies `other`. A cubic takes a fraction of the instructions that a segment with all its
    /// coefficients takes.
    #[inline(never)]
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.origin = other.origin;
        self.count = other.count;
        self.begin = other.begin;
        self.offset = other.offset;
        self.advance = other.advance;
        self.rate_scale = other.rate_scale;
        self.acceleration_scale = other.acceleration_scale;
        self.end_acceleration = other.end_acceleration;
        self.kink_moment = other.kink_moment;
        self.low = other.low;
        if let Rest::Cubic { steepest } = other.rest {
            self.rest = Rest::Cubic { steepest };
        } else {
            self.rest = other.rest;
        }
    }
}

impl<T: Scalar> Angle<T> {
    /// Returns the angle `k` steps of `step / 2⁶⁴` turns further on, rounded once.
    #[inline(always)]
    fn cruise(self, step: i64, k: u32) -> Self {
        // step × k, at most 96 bits, as whole turns and a 64-bit fraction.
        let low = (step as u32 as u64) * u64::from(k);
        let high = (step >> 32) * i64::from(k) + (low >> 32) as i64;
        let fraction = (high << 32) | (low & 0xffff_ffff) as i64;
        // A fraction of ½ and more reads as negative: one turn on.
        let whole = (high >> 32) as i32 + i32::from(fraction < 0);
        let turned = self.plus(T::from_fraction(fraction));
        Self { turns: turned.turns.wrapping_add(whole), part: turned.part }
    }
}
