//! Stops a turning hub. Planned in the tick's own precision, as a stop cannot wait for set-up.

use super::{End, Rest, Segment, Shape};
use crate::Error;
use crate::hub::{Angle, HubState};
use crate::math::{Each, Scalar};
use crate::motion::Limits;
use crate::motion::joiner::{Curve, Joiner};

/// Limits of a stop, in the scalar of the tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Braking<T> {
    acceleration: T,
    rate: Option<T>,
    jerk: Option<T>,
    tick: T,
    /// Turns in `rad/s × s`.
    turns: T,
}

/// A chord: `√(1 + x) ≥ 1 + (√2 − 1) x` on 0..1, so `2(1 − x) + 2√(1 + x)` is at least
/// `4 − 1.1716 x`.
const CHORD: f64 = 1.171_572_875_253_81;

/// Chord on 1..2: `2(1 − x) + 2√(1 + x)` is at least `4.1928 − 1.3643 x`.
const STEEP_CHORD: [f64; 2] = [4.192_752_634_354_62, 1.364_325_509_608_43];

/// Longest stop, ticks: counts up to here are exact in an f32.
const LONGEST: u32 = 1 << 20;

impl<T: Scalar> Braking<T> {
    /// Needs a limit of deceleration or of acceleration, and keeps the first if both are set; those
    /// of rate and jerk are kept where they are set. `tick` in s.
    ///
    /// # Errors
    /// No limit of acceleration, or one of torque or moment, which a stop cannot check.
    pub fn new(limits: &Limits, tick: f64) -> Result<Self, Error> {
        let limits = limits.validate()?.of_motion()?;
        let limit = limits.deceleration.or(limits.acceleration);
        let unlimited = limit.unwrap_or(f64::INFINITY);
        let acceleration = Error::check("limits.acceleration", unlimited, 1e-9, 1e12, "rad/s^2")?;
        Ok(Self {
            acceleration: T::from_f64(acceleration),
            rate: limits.rate.map(T::from_f64),
            jerk: limits.jerk.map(T::from_f64),
            tick: T::from_f64(tick),
            turns: T::from_f64(tick / core::f64::consts::TAU),
        })
    }

    /// The segment from `hub`, which is turning, to rest, the angle it ends at and the acceleration
    /// it begins with. Its tick 0 is `hub`'s own.
    ///
    /// `θ̇(s) = (1 − s)²[v + s(2v + aT)]`, `s = t/T`: from rate `v` and acceleration `a` to rest
    /// with no acceleration, never turning back. With `β = 6v/T` its peak is `(2a + β)²/4(3a + β)`,
    /// so `T = 1.5 v/A` while slowing down and at most 2.12 v/A while speeding up by `A` stays
    /// within the limit `A` of deceleration; the jerk limit stretches it. Where a hub that speeds
    /// up would pass the limit of rate on its way, or speeds up by more than `2A`, its acceleration
    /// drops to zero at once, as it jumps at the ends of a cubic. Order of precedence: angle and
    /// rate without a step, acceleration, rate, jerk.
    pub(crate) fn stop(&self, hub: &HubState<T>) -> (Segment<T>, Angle<T>, T) {
        let (a, ticks) = self.begin(hub.rate, hub.acceleration);
        let (segment, end) = self.segment(hub, a, ticks);
        (segment, end, a)
    }

    /// The acceleration with which the stop begins, and its ticks.
    fn begin(&self, rate: T, acceleration: T) -> (T, u32) {
        let sign = if rate < T::ZERO { -T::ONE } else { T::ONE };
        let (v, mut a) = (sign * rate, sign * acceleration);
        let steep = a > T::TWO * self.acceleration;
        let passes = |limit: T| self.peak_rate(v, a) > limit;
        if a > T::ZERO && (steep || self.rate.is_some_and(passes)) {
            a = T::ZERO;
        }
        let mut ticks = self.ticks(v, a);
        let three = T::TWO + T::ONE;
        if a < T::ZERO && three * v + a * T::from_u32(ticks) * self.tick < T::ZERO {
            a = T::ZERO;
            ticks = self.ticks(v, a);
        }
        (sign * a, ticks)
    }

    /// `T` that the acceleration allows, s.
    fn duration(&self, v: T, a: T) -> T {
        let x = if a > T::ZERO { a / self.acceleration } else { T::ZERO };
        let chord = if x > T::ONE {
            let [at_zero, slope] = STEEP_CHORD.each(T::from_f64);
            at_zero - slope * x
        } else {
            T::from_u32(4) - T::from_f64(CHORD) * x
        };
        T::from_u32(6) * v / (self.acceleration * chord)
    }

    /// Peak of the rate while it still grows, `a > 0`.
    fn peak_rate(&self, v: T, a: T) -> T {
        let duration = T::from_u32(self.ticks(v, a)) * self.tick;
        let s = a / ((T::TWO + T::ONE) * a + T::from_u32(6) * v / duration);
        (T::ONE - s) * (T::ONE - s) * (v + s * (T::TWO * v + a * duration))
    }

    /// Whole ticks, at least two, that acceleration and jerk allow.
    fn ticks(&self, v: T, a: T) -> u32 {
        let mut ticks = ceil(self.duration(v, a) / self.tick).clamp(2, LONGEST);
        // 1.25^64 = 1.6e6: by then it is as long as it may be.
        for _ in 0..64 {
            let duration = T::from_u32(ticks) * self.tick;
            let steady = T::from_u32(6) * v / duration;
            let (first, last) = (T::from_u32(4) * a + steady, T::TWO * a + steady);
            let fits = |jerk: T| {
                let bound = jerk * duration;
                -bound <= first && first <= bound && last <= bound
            };
            if self.jerk.is_none_or(fits) || ticks >= LONGEST {
                break;
            }
            ticks = (ticks + ticks / 4 + 1).min(LONGEST);
        }
        ticks
    }

    /// The rate's cubic as a quartic of the angle about the segment's middle: `c₁ … c₄`, turns.
    fn quartic(&self, rate: T, a: T, ticks: u32) -> [T; 4] {
        let n = T::from_u32(ticks);
        // vT and aT², turns.
        let p = rate * self.turns * n;
        let q = a * self.turns * self.tick * n * n;
        let (four, six) = (T::from_u32(4), T::from_u32(6));
        let c1 = (four * p + q) / T::from_u32(16);
        let c2 = -(six * p + q) / T::from_u32(32);
        let c3 = -q / T::from_u32(48);
        let c4 = (T::TWO * p + q) / T::from_u32(64);
        [c1, c2, c3, c4]
    }

    fn segment(&self, hub: &HubState<T>, a: T, ticks: u32) -> (Segment<T>, Angle<T>) {
        let [c1, c2, c3, c4] = self.quartic(hub.rate, a, ticks);
        let n = T::from_u32(ticks);
        let half = T::HALF * n * self.tick;
        let origin = hub.angle.plus(c1 - c2 + c3 - c4);
        let tau = T::from_f64(core::f64::consts::TAU);
        let segment = Segment {
            origin,
            count: ticks,
            begin: End { angle: hub.angle, rate: hub.rate, acceleration: a },
            offset: -T::ONE,
            advance: T::TWO / n,
            rate_scale: tau / half,
            acceleration_scale: T::TWO * tau / (half * half),
            end_acceleration: T::ZERO,
            kink_moment: T::ZERO,
            low: [c1, c2, c3],
            rest: Rest::Quintic([c4, T::ZERO]),
        };
        (segment, origin.plus(c1 + c2 + c3 + c4))
    }
}

impl Braking<f64> {
    /// The stop from the end of a motion that is laid curve by curve, which turns.
    pub(crate) fn curve(&self, joiner: &Joiner) -> Curve {
        let here = joiner.here();
        let (a, ticks) = self.begin(here.rate, here.acceleration);
        let [c1, c2, c3, c4] = self.quartic(here.rate, a, ticks);
        Curve {
            shape: Shape::Quintic([c1, c2, c3, c4, 0.0]),
            until: joiner.border() + f64::from(ticks),
            end: HubState::at_rest(here.angle.plus(2.0 * (c1 + c3))),
            begin_acceleration: a,
        }
    }
}

/// The least whole number from `x` on, for `0 ≤ x`, with 1e-4 for rounding; `LONGEST` above that.
fn ceil<T: Scalar>(x: T) -> u32 {
    // NaN is not below it either.
    if x < T::from_u32(LONGEST) {
        let (whole, rest) = x.split();
        whole.max(0) as u32 + u32::from(rest > T::from_f64(1e-4))
    } else {
        LONGEST
    }
}
