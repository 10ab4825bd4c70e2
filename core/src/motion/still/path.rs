//! Where a still move begins, the curve it follows, and the greatest values on it.

use core::f64::consts::TAU;

use crate::math::Scalar;
use crate::motion::segment::Shape;
use crate::motion::{Angle, BULGE, Hub, Peaks, Segment};

/// The hub where a move begins, turning or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Origin {
    /// θ.
    pub angle: Angle<f64>,
    /// θ̇, rad/s.
    pub rate: f64,
    /// θ̈, rad/s².
    pub acceleration: f64,
}

impl Origin {
    /// At rest.
    pub fn at_rest(angle: Angle<f64>) -> Self {
        Self { angle, rate: 0.0, acceleration: 0.0 }
    }

    /// As the hub is at one instant.
    pub fn of<T: Scalar>(hub: &Hub<T>) -> Self {
        Self {
            angle: Angle { turns: hub.angle.turns, part: hub.angle.part.to_f64() },
            rate: hub.rate.to_f64(),
            acceleration: hub.acceleration.to_f64(),
        }
    }
}

/// A quintic from a departure to rest at `to`, angle, rate and acceleration continuous at both
/// ends, to be bulged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Path {
    pub from: Origin,
    /// rad.
    pub to: f64,
    pub ticks: u32,
    /// s.
    pub tick: f64,
}

/// Sixteenths of `u … u⁵` of the quintics that turn by 1; that begin with a rate of 1 and end where
/// they began; that begin with an acceleration of 1 likewise. Per `u`.
const TURN: [f64; 5] = [15.0, 0.0, -10.0, 0.0, 3.0];
const RATE: [f64; 5] = [-7.0, -6.0, 10.0, 1.0, -3.0];
const ACCELERATION: [f64; 5] = [-1.0, -2.0, 2.0, 1.0, -1.0];

impl Path {
    /// T, s.
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
        let acceleration = self.from.acceleration * half * half / TAU;
        core::array::from_fn(|k| {
            (TURN[k] * turn + RATE[k] * rate + ACCELERATION[k] * acceleration) / 16.0
        })
    }

    /// The curve with a bulge in rad.
    pub fn segment(&self, bulge: &[f64; BULGE]) -> Segment<f64> {
        let shape = Shape::Bulged { c: self.quintic(), d: bulge.map(|b| b / TAU) };
        let length = f64::from(self.ticks);
        Segment::new(self.from.angle, shape, length, 0.0, self.ticks, self.tick)
            .beginning(self.from.rate, self.from.acceleration)
            .landing_with(0.0)
    }
}

/// Coefficients of `u … u¹¹`.
const DEGREE: usize = BULGE + 5;

/// Nodes at which [`peaks`] looks.
const NODES: u32 = 128;

/// Greatest magnitudes on the quintic `c` with the bulge `d`, both in turns, over `duration` s: the
/// largest of 129 nodes, dense at the ends where a curve may be steep, refined by the parabola through
/// its neighbours. Error 1e-4 of a peak. Not finite where a coefficient is not.
pub(crate) fn peaks<T: Scalar>(c: &[T; 5], d: &[T; BULGE], duration: f64) -> Peaks {
    let mut derivative = monomials(c, d);
    let mut scale = TAU;
    let [rate, acceleration, jerk] = [1, 2, 3].map(|order: usize| {
        // Coefficient k is that of u^k from here on, the first `order` of them gone.
        for k in 0..DEGREE {
            let power = (k + 2).saturating_sub(order);
            derivative[k] = derivative[k] * T::from_u32(power as u32);
        }
        scale *= 2.0 / duration;
        scale * greatest(&derivative, order - 1)
    });
    Peaks { rate, acceleration, jerk }
}

/// `c₁u + … + c₅u⁵ + (1 − 3u² + 3u⁴ − u⁶)(d₀ + … + d₅u⁵)`, the constant left out.
fn monomials<T: Scalar>(c: &[T; 5], d: &[T; BULGE]) -> [T; DEGREE] {
    let three = T::TWO + T::ONE;
    let mut all = [T::ZERO; DEGREE];
    all[..5].copy_from_slice(c);
    for (power, factor) in [(0, T::ONE), (2, -three), (4, three), (6, -T::ONE)] {
        for k in 0..BULGE {
            // d₀'s own constant is left out.
            if k + power > 0 {
                all[k + power - 1] += factor * d[k];
            }
        }
    }
    all
}

/// Greatest `|Σ cₖ u^(k − skipped)|` over −1 … 1.
fn greatest<T: Scalar>(c: &[T; DEGREE], skipped: usize) -> f64 {
    let at = |node: u32| {
        let x = T::from_u32(node) * T::from_f64(2.0 / f64::from(NODES)) - T::ONE;
        let u = T::HALF * x * (T::TWO + T::ONE - x * x);
        let mut sum = c[DEGREE - 1];
        for k in (skipped..DEGREE - 1).rev() {
            sum = sum * u + c[k];
        }
        sum
    };
    let magnitude = |value: T| if value < T::ZERO { -value } else { value };
    let (mut before, mut here) = (at(0), at(0));
    let mut most = T::ZERO;
    for node in 0..=NODES {
        let after = at((node + 1).min(NODES));
        let mut peak = magnitude(here);
        if (here - before) * (after - here) < T::ZERO {
            let (bend, tilt) = (before - T::TWO * here + after, after - before);
            peak = magnitude(here - tilt * tilt / (T::TWO * T::TWO * T::TWO * bend));
        }
        // What is no number stays: whoever compares it then refuses.
        if peak > most || !peak.is_finite() {
            most = peak;
        }
        (before, here) = (here, after);
    }
    most.to_f64()
}
