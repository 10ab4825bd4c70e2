//! The linear model of a still move: the amplitudes that it leaves, as a function of its bulge.

use core::f64::consts::TAU;

use super::Objective;
use super::curve::{bulges, quintic};
use crate::math::{Scalar, array, dot, words};
use crate::motion::{BULGE, curve_peaks};

/// Most amplitudes that a move has to bring to zero: two of each of three arms.
pub(crate) const MAX_AMPLITUDES: usize = 6;

/// Intervals of the trapezoidal rule; what is integrated vanishes at both ends.
pub(super) const NODES: usize = 48;

/// Most intervals in the response of a mode to a long move.
const MAX_NODES: usize = 2048;

/// A mode of one arm, as the linear model sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Oscillation<T> {
    /// `γ = (α + βω²)/2`, 1/s.
    pub decay: f64,
    /// `√(ω² − γ²)`, rad/s, at least a tenth of ω.
    pub damped: f64,
    /// `γ / √(ω² − γ²)`, `ω / √(ω² − γ²)`.
    pub ratio: [T; 2],
    /// `∂Y/∂a b/(ω L)`: tip deflection to come of an impulse of `θ̇`, of L.
    pub gain: T,
    pub alpha: T,
}

/// Amplitudes at the end of the move, by the linear model: `offset + rows · bulge`. They are the
/// tip's deflection and its rate over ω, of L, by one mode.
pub(crate) struct Linear<T> {
    pub rows: [[T; BULGE]; MAX_AMPLITUDES],
    /// Amplitudes without a bulge, less the amplitudes that are to be left.
    pub offset: [T; MAX_AMPLITUDES],
    /// Rows in use.
    pub count: usize,
}

/// Largest ratio by which a robust move may peak higher so that its middle arm comes to rest too.
const PRICE: f64 = 2.0;

impl<T: Scalar> Linear<T> {
    pub fn new() -> Self {
        Self {
            rows: [[T::ZERO; BULGE]; MAX_AMPLITUDES],
            offset: [T::ZERO; MAX_AMPLITUDES],
            count: 0,
        }
    }

    /// Adds the amplitudes of a mode that begins with `begin`: both of them at the end, or with
    /// `half` the one in the middle that has to be zero for an odd motion to end at rest.
    pub fn add(
        &mut self,
        mode: &Oscillation<T>,
        quintic_c: &[T; 5],
        begin: [T; 2],
        duration: f64,
        half: bool,
    ) {
        let Response { rows, offset } = Response::new(mode, quintic_c, begin, duration);
        if half {
            let (sin, cos) = T::from_f64(0.5 * mode.damped * duration / TAU).sin_cos_turns();
            let middle = |a: T, p: T| T::HALF * (cos * a - sin * p);
            let k = self.count;
            self.rows[k] = array(|j| middle(rows[0][j], rows[1][j]));
            self.offset[k] = middle(offset[0], offset[1]);
            self.count += 1;
        } else {
            for r in 0..2 {
                (self.rows[self.count], self.offset[self.count]) = (rows[r], offset[r]);
                self.count += 1;
            }
        }
    }

    /// Finds the amplitudes that the first arm has to keep, `each` of them, so that the objective's
    /// peak is at most [`PRICE`] times what the other arms alone need, and aims at them from now
    /// on.
    pub fn tolerate(
        &mut self,
        each: usize,
        quintic_c: &[T; 5],
        objective: Objective,
        duration: f64,
    ) -> [T; 2] {
        let peak = |bulge: &[T; BULGE]| {
            let peaks = curve_peaks(quintic_c, bulge, duration);
            match objective {
                Objective::Rate => peaks.rate,
                Objective::Acceleration | Objective::Effort => peaks.acceleration,
                Objective::Jerk | Objective::Smooth => peaks.jerk,
            }
        };
        let all = self.least_effort(quintic_c, objective).base;
        let mut others = Self::new();
        others.count = self.count - each;
        for i in 0..others.count {
            (others.rows[i], others.offset[i]) = (self.rows[i + each], self.offset[i + each]);
        }
        let alone = others.least_effort(quintic_c, objective).base;
        let (low, high) = (peak(&alone), peak(&all));
        let mut kept = [T::ZERO; 2];
        if high <= PRICE * low {
            return kept;
        }
        // The peak falls about evenly from one to the other.
        let share = T::from_f64((high - PRICE * low) / (high - low));
        for i in 0..each {
            kept[i] = share * (self.offset[i] + dot(&self.rows[i], &alone));
            self.offset[i] -= kept[i];
        }
        kept
    }
}

/// Response of one mode at the end of the move: both amplitudes, as [`Linear`] gives them.
struct Response<T> {
    rows: [[T; BULGE]; 2],
    offset: [T; 2],
}

impl<T: Scalar> Response<T> {
    /// Integrates `∫ kernel (θ̈ + αθ̇) dt` by the trapezoidal rule, from the end backwards, and
    /// adds the free response to the amplitudes `begin`.
    fn new(mode: &Oscillation<T>, quintic_c: &[T; 5], begin: [T; 2], duration: f64) -> Self {
        // A long move gets 12 nodes a period.
        let periods = mode.damped * duration / TAU;
        let nodes = NODES.max((12.0 * periods) as usize).min(MAX_NODES);
        let step = duration / nodes as f64;
        let radians = mode.damped * step / TAU;
        let (sin, cos) = T::from_f64(radians).sin_cos_turns();
        let loss = T::from_f64(libm::exp(-mode.decay * step));
        let per_u = 2.0 / duration;
        // ∫ (θ̈ + αθ̇) dt with dt = step, θ̈ = 2π (2/T)² d²/du².
        let second = T::from_f64(-TAU * per_u * per_u * step) * mode.gain;
        let first = T::from_f64(-TAU * per_u * step) * mode.gain * mode.alpha;
        let mut rows = [[T::ZERO; BULGE]; 2];
        let mut offset = [T::ZERO; 2];
        // From the end backwards: (e sin, e cos) of the time to go.
        let (mut s, mut c) = (T::ZERO, T::ONE);
        let turned = |s: T, c: T| (loss * (s * cos + c * sin), loss * (c * cos - s * sin));
        for node in (1..nodes).rev() {
            (s, c) = turned(s, c);
            let u = T::from_f64(2.0 / nodes as f64) * T::from_u32(node as u32) - T::ONE;
            let kernel = [mode.ratio[1] * s, c - mode.ratio[0] * s];
            let ([b1, b2, _], [q1, q2, _]) = (bulges(u), quintic(quintic_c, u));
            for r in 0..2 {
                let (second, first) = (second * kernel[r], first * kernel[r]);
                for k in 0..BULGE {
                    rows[r][k] += second * b2[k] + first * b1[k];
                }
                offset[r] += second * q2 + first * q1;
            }
        }
        let (s, c) = turned(s, c);
        let [g, w] = mode.ratio;
        let free = [
            begin[0] * (c + g * s) + begin[1] * (w * s),
            begin[1] * (c - g * s) - begin[0] * (w * s),
        ];
        for r in 0..2 {
            offset[r] += free[r];
        }
        Self { rows, offset }
    }
}

words! {
    [T: Scalar] Oscillation<T>: decay, damped, ratio, gain, alpha;
}
