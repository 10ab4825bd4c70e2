//! A piece of the commanded motion in the form that the tick evaluates.

mod braking;

use core::f64::consts::{PI, TAU};

pub use braking::Braking;

use super::Angle;
use crate::math::Scalar;

/// The hub at one instant. Rate and acceleration in rad/s and rad/s²; where the acceleration
/// jumps it is the right-hand value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hub<T> {
    /// θ.
    pub angle: Angle<T>,
    /// θ̇, rad/s.
    pub rate: T,
    /// θ̈, rad/s².
    pub acceleration: T,
    /// sin θ; 0 in the tick of an arm that does not feel where down is.
    pub sin: T,
    /// cos θ; 1 likewise.
    pub cos: T,
}

impl<T: Scalar> Hub<T> {
    /// At rest at angle 0.
    pub(crate) const ZERO: Self = Self {
        angle: Angle { turns: 0, part: T::ZERO },
        rate: T::ZERO,
        acceleration: T::ZERO,
        sin: T::ZERO,
        cos: T::ONE,
    };
}

/// A stretch of the motion with one formula, `u = −1..1` over its length. About the middle the
/// coefficients are small and nothing cancels: rounding is an eighth of that in `0..1`.
///
/// The first tick that belongs to a segment may lie a fraction of a tick after its beginning: the
/// thirds of a trapezoid need not be whole ticks.
///
/// Error in f32: angle 1e-7 of the segment's own turn (a cruise: 3e-8 turn, however long), rate
/// and acceleration 3e-7 of their peaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment<T> {
    /// Angle at `u = 0`; of a cruise, at its first tick.
    origin: Angle<T>,
    /// Ticks that belong to the segment.
    count: u32,
    /// `u` at the first of them.
    offset: T,
    /// `u` a tick.
    advance: T,
    /// `4π / D`, turns per `u` to rad/s, `D` the length in seconds.
    rate_scale: T,
    /// `16π / D²`, half of `d²Δ/du²` to rad/s².
    acceleration_scale: T,
    /// θ̈ at `u = 1`, from the left.
    landing: T,
    /// What the tick before the first tick needs to know of the border within it: see
    /// [`Stepper::shift`](crate::Stepper::shift). Zero where the border is a tick.
    entry: T,
    shape: Shape<T>,
}

/// Turns from the segment's middle, as a function of `u`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape<T> {
    /// `c₁u + c₂u² + c₃u³`.
    Cubic([T; 3]),
    /// `c₁u + … + c₅u⁵`.
    Quintic([T; 5]),
    /// `c₁u + c₂u² + a sin πu + b (cos πu − 1)`.
    Harmonic { c: [T; 2], a: T, b: T },
    /// Constant rate (rad/s). `step / 2⁶⁴` turns a tick, multiplied out in integers: after 10⁹
    /// ticks the angle is within 3e-11 turn.
    Cruise { rate: T, step: i64 },
}

/// `(Δ, dΔ/du, ½ d²Δ/du²)` of a shape in turns.
type Derivatives<T> = (T, T, T);

impl<T: Scalar> Segment<T> {
    /// The hub at the segment's tick `k`, `k < count`.
    pub fn hub(&self, k: u32) -> Hub<T> {
        let mut hub = Hub::ZERO;
        self.drive(&mut hub, k);
        (hub.sin, hub.cos) = hub.angle.sin_cos();
        hub
    }

    /// Moves the hub, but for its sine and cosine, to the segment's tick `k`, `k < count`.
    #[inline(always)]
    pub(crate) fn drive(&self, hub: &mut Hub<T>, k: u32) {
        if let Shape::Cubic(c) = self.shape {
            let u = self.offset + T::from_u32(k) * self.advance;
            (hub.angle, hub.rate, hub.acceleration) = self.scaled(cubic(c, u));
        } else {
            self.drive_otherwise(hub, k);
        }
    }

    /// What is no cubic, out of the way of those that are: most ticks are theirs.
    #[inline(never)]
    fn drive_otherwise(&self, hub: &mut Hub<T>, k: u32) {
        (hub.angle, hub.rate, hub.acceleration) = match self.shape {
            Shape::Cruise { rate, step } => (self.origin.cruise(step, k), rate, T::ZERO),
            _ => self.scaled(self.derivatives(self.offset + T::from_u32(k) * self.advance)),
        };
    }

    #[inline(always)]
    fn derivatives(&self, u: T) -> Derivatives<T> {
        match self.shape {
            Shape::Cubic(c) => cubic(c, u),
            Shape::Quintic(c) => quintic(c, u),
            Shape::Harmonic { c, a, b } => harmonic(c, a, b, u),
            Shape::Cruise { .. } => (T::ZERO, T::ZERO, T::ZERO),
        }
    }

    #[inline(always)]
    fn scaled(&self, (delta, first, half_second): Derivatives<T>) -> (Angle<T>, T, T) {
        let rate = first * self.rate_scale;
        (self.origin.plus(delta), rate, half_second * self.acceleration_scale)
    }

    /// Ticks that belong to the segment.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// θ̈ at the segment's end, from the left.
    pub(crate) fn landing(&self) -> T {
        self.landing
    }

    /// The moment of the border within the tick before, rad/s².
    pub(crate) fn entry(&self) -> T {
        self.entry
    }

    /// The same segment, ending `count` ticks after its beginning.
    pub(crate) fn cut(self, count: u32) -> Self {
        Self { count, ..self }
    }

    /// The same cruise, beginning at another angle.
    pub(crate) fn moved(self, origin: Angle<T>) -> Self {
        Self { origin, ..self }
    }
}

/// By repeated synthetic division: value, slope and half the curvature out of one chain, without
/// multiplying coefficients by their powers.
#[inline(always)]
fn cubic<T: Scalar>([c1, c2, c3]: [T; 3], u: T) -> Derivatives<T> {
    let p = c3 * u;
    let p2 = p + c2;
    let p1 = p2 * u + c1;
    let q2 = p2 + p;
    (p1 * u, q2 * u + p1, q2 + p)
}

/// As [`cubic`].
#[inline(always)]
fn quintic<T: Scalar>([c1, c2, c3, c4, c5]: [T; 5], u: T) -> Derivatives<T> {
    let p = c5 * u;
    let p4 = p + c4;
    let p3 = p4 * u + c3;
    let p2 = p3 * u + c2;
    let p1 = p2 * u + c1;
    let q4 = p4 + p;
    let q3 = q4 * u + p3;
    let q2 = q3 * u + p2;
    let r3 = (q4 + p) * u + q3;
    (p1 * u, q2 * u + p1, r3 * u + q2)
}

#[inline(always)]
fn harmonic<T: Scalar>([c1, c2]: [T; 2], a: T, b: T, u: T) -> Derivatives<T> {
    let (sin, cos) = (T::HALF * u).sin_cos_turns();
    let (pi, half_pi2) = (T::from_f64(PI), T::from_f64(0.5 * PI * PI));
    let p2 = c2 * u;
    let p1 = p2 + c1;
    (
        p1 * u + a * sin + b * (cos - T::ONE),
        p1 + p2 + pi * (a * cos - b * sin),
        c2 - half_pi2 * (a * sin + b * cos),
    )
}

impl<T: Scalar> Angle<T> {
    /// The angle `k` steps of `step / 2⁶⁴` turns on, rounded once.
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

impl Shape<f64> {
    /// `Δ(−1)`, `Δ(1)` and `d²Δ/du²(1)`.
    fn ends(&self) -> [f64; 3] {
        let (odd, even, bend) = match *self {
            Self::Cubic([c1, c2, c3]) => (c1 + c3, c2, 2.0 * c2 + 6.0 * c3),
            Self::Quintic([c1, c2, c3, c4, c5]) => {
                (c1 + c3 + c5, c2 + c4, 2.0 * c2 + 6.0 * c3 + 12.0 * c4 + 20.0 * c5)
            }
            Self::Harmonic { c: [c1, c2], b, .. } => (c1, c2 - 2.0 * b, 2.0 * c2 + PI * PI * b),
            Self::Cruise { .. } => (0.0, 0.0, 0.0),
        };
        [even - odd, even + odd, bend]
    }
}

impl Segment<f64> {
    /// A segment of `length` ticks (not whole in general) that begins `before` ticks, 0 to 1,
    /// before the first tick that belongs to it.
    pub(crate) fn new(
        start: Angle<f64>,
        shape: Shape<f64>,
        length: f64,
        before: f64,
        count: u32,
        tick: f64,
    ) -> Self {
        let half = 0.5 * length * tick;
        let mut segment = Self {
            origin: start,
            count,
            offset: 2.0 * before / length - 1.0,
            advance: 2.0 / length,
            rate_scale: TAU / half,
            acceleration_scale: 2.0 * TAU / (half * half),
            landing: 0.0,
            entry: 0.0,
            shape,
        };
        let [begin, _, landing] = segment.shape.ends();
        segment.origin = start.plus(-begin);
        segment.landing = 0.5 * landing * segment.acceleration_scale;
        segment
    }

    /// Constant `rate` (rad/s) for `count` ticks.
    pub(crate) fn cruise(start: Angle<f64>, rate: f64, count: u32, tick: f64) -> Self {
        // At most ½ turn a tick by the rate check of `Plan`, so the product fits an i64.
        let step = libm::round(rate * tick / TAU * 18_446_744_073_709_551_616.0) as i64;
        Self {
            origin: start,
            count,
            offset: 0.0,
            advance: 0.0,
            rate_scale: 0.0,
            acceleration_scale: 0.0,
            landing: 0.0,
            entry: 0.0,
            shape: Shape::Cruise { rate, step },
        }
    }

    /// The hub any real number of ticks after the segment's first, for solvers that choose their
    /// own steps. May be negative down to the segment's true beginning.
    pub fn hub_at(&self, ticks: f64) -> Hub<f64> {
        let (angle, rate, acceleration) = match self.shape {
            Shape::Cruise { rate, step } => {
                let turns = step as f64 / 18_446_744_073_709_551_616.0 * ticks;
                (self.origin.plus(turns), rate, 0.0)
            }
            _ => self.scaled(self.derivatives(self.offset + ticks * self.advance)),
        };
        let (sin, cos) = angle.sin_cos();
        Hub { angle, rate, acceleration, sin, cos }
    }

    /// Behind `before`, whose last tick is the one before this segment's first, `tick` s apart.
    ///
    /// `m = (Δθ − hθ̇₀)/h²`, and of the parabola that the tick takes, up to the left-hand value at
    /// the border, `ū/2 + (u₀ − u₁)/12`.
    pub(crate) fn behind(self, before: &Self, tick: f64) -> Self {
        if self.ticks_before() == 0.0 {
            return self;
        }
        let (from, to) = (before.hub_at(f64::from(before.count) - 1.0), self.hub_at(0.0));
        let turned = to.angle.radians() - from.angle.radians();
        let moment = (turned / tick - from.rate) / tick;
        let mean = (to.rate - from.rate) / tick;
        let parabola = 0.5 * mean + (from.acceleration - before.landing) / 12.0;
        Self { entry: moment - parabola, ..self }
    }

    /// The angle at `u = 1`.
    pub(crate) fn end(&self) -> Angle<f64> {
        self.origin.plus(self.shape.ends()[1])
    }

    /// Ticks from the segment's true beginning to its first tick, 0 to 1.
    pub fn ticks_before(&self) -> f64 {
        if self.advance == 0.0 { 0.0 } else { (self.offset + 1.0) / self.advance }
    }

    /// Rounds to the scalar of the tick.
    pub fn cast<T: Scalar>(&self) -> Segment<T> {
        let f = T::from_f64;
        Segment {
            origin: self.origin.cast(),
            count: self.count,
            offset: f(self.offset),
            advance: f(self.advance),
            rate_scale: f(self.rate_scale),
            acceleration_scale: f(self.acceleration_scale),
            landing: f(self.landing),
            entry: f(self.entry),
            shape: match self.shape {
                Shape::Cubic(c) => Shape::Cubic(c.map(f)),
                Shape::Quintic(c) => Shape::Quintic(c.map(f)),
                Shape::Harmonic { c, a, b } => Shape::Harmonic { c: c.map(f), a: f(a), b: f(b) },
                Shape::Cruise { rate, step } => Shape::Cruise { rate: f(rate), step },
            },
        }
    }
}
