//! The linear part of a still move: of all bulges that leave a given amplitude, the one of least
//! effort.

use core::f64::consts::TAU;

use crate::math::{Band, Ldl, Scalar, dot};
use crate::motion::{BULGE, curve_peaks};

/// Most amplitudes that are aimed at: two of each of three arms.
pub(crate) const MAX_AIMS: usize = 6;

/// Intervals of the trapezoidal rule; what is integrated vanishes at both ends.
const NODES: usize = 48;

/// Most of them in the response of a mode to a long move.
const MOST_NODES: usize = 2048;

/// Rounds of re-weighting towards the least greatest acceleration.
const ROUNDS: usize = 2;

/// A mode of one arm, as the effort sees it.
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

/// Amplitudes of the tip's deflection and its rate over ω, of L, at the end by the linear model, one
/// row an aim, and their dependence on the bulge.
pub(crate) struct Linear<T> {
    pub rows: [[T; BULGE]; MAX_AIMS],
    /// Without a bulge, less what is aimed at.
    pub offset: [T; MAX_AIMS],
    pub aims: usize,
}

/// How much more a robust move may peak for its middle arm's sake.
const PRICE: f64 = 2.0;

/// What a move spares where it can: the greatest of
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Manner {
    /// the rate,
    Rate,
    /// the acceleration,
    Acceleration,
    /// the jerk;
    Jerk,
    /// or the jerk in the mean, not its greatest: what excites the second mode least.
    Smooth,
}

impl Manner {
    /// Order of the derivative that is spared.
    fn order(self) -> usize {
        match self {
            Self::Rate => 0,
            Self::Acceleration => 1,
            Self::Jerk | Self::Smooth => 2,
        }
    }
}

/// What the bulge is for any aim: `base + Σ zᵢ vᵢ` (turns) leaves the amplitudes `z`.
pub(crate) struct LeastEffort<T> {
    pub base: [T; BULGE],
    pub towards: [[T; BULGE]; MAX_AIMS],
    /// Of the effort itself.
    factors: Ldl<T, BULGE, BULGE>,
}

/// `d/du`, `d²/du²` and `d³/du³` of `(1 − u²)³uᵏ`.
fn bulges<T: Scalar>(u: T) -> [[T; BULGE]; 3] {
    let n = |k: u32| T::from_u32(k);
    let square = u * u;
    let w = T::ONE - square;
    let w2 = w * w;
    let b = w2 * w;
    let b1 = -(n(6) * u * w2);
    let b2 = n(6) * w * (n(4) * square - w);
    let b3 = n(24) * u * (n(3) * w - T::TWO * square);
    // u^(k−3) … u^k, nothing below u⁰.
    let mut powers = [T::ZERO, T::ZERO, T::ZERO, T::ONE];
    let mut out = [[T::ZERO; BULGE]; 3];
    for k in 0..BULGE {
        let k_ = k as u32;
        let q = powers[3];
        let q1 = n(k_) * powers[2];
        let q2 = n(k_ * k_.saturating_sub(1)) * powers[1];
        let q3 = n(k_ * k_.saturating_sub(1) * k_.saturating_sub(2)) * powers[0];
        out[0][k] = b1 * q + b * q1;
        out[1][k] = b2 * q + T::TWO * b1 * q1 + b * q2;
        out[2][k] = b3 * q + n(3) * (b2 * q1 + b1 * q2) + b * q3;
        powers = [powers[1], powers[2], powers[3], powers[3] * u];
    }
    out
}

/// `d/du`, `d²/du²` and `d³/du³` of the quintic.
fn quintic<T: Scalar>(c: &[T; 5], u: T) -> [T; 3] {
    let n = |k: u32| T::from_u32(k);
    [
        (((n(5) * c[4] * u + n(4) * c[3]) * u + n(3) * c[2]) * u + n(2) * c[1]) * u + c[0],
        ((n(20) * c[4] * u + n(12) * c[3]) * u + n(6) * c[2]) * u + n(2) * c[1],
        (n(60) * c[4] * u + n(24) * c[3]) * u + n(6) * c[2],
    ]
}

impl<T: Scalar> Linear<T> {
    pub fn new() -> Self {
        Self { rows: [[T::ZERO; BULGE]; MAX_AIMS], offset: [T::ZERO; MAX_AIMS], aims: 0 }
    }

    /// Adds the aims of an arm whose mode begins with the amplitudes `begin`: both amplitudes
    /// at the end, or with `half` the one in the middle that an odd motion brings to rest by.
    pub fn add(
        &mut self,
        mode: &Oscillation<T>,
        quintic_c: &[T; 5],
        begin: [T; 2],
        duration: f64,
        half: bool,
    ) {
        // As many a period in a long move.
        let periods = mode.damped * duration / TAU;
        let nodes = NODES.max((12.0 * periods) as usize).min(MOST_NODES);
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
        if half {
            let (sin, cos) = T::from_f64(0.5 * mode.damped * duration / TAU).sin_cos_turns();
            let middle = |a: T, p: T| T::HALF * (cos * a - sin * p);
            let k = self.aims;
            self.rows[k] = core::array::from_fn(|j| middle(rows[0][j], rows[1][j]));
            self.offset[k] = middle(offset[0], offset[1]);
            self.aims += 1;
        } else {
            for r in 0..2 {
                (self.rows[self.aims], self.offset[self.aims]) = (rows[r], offset[r]);
                self.aims += 1;
            }
        }
    }

    /// What the first arm has to keep, for the peak of what is spared to be no more than
    /// [`PRICE`] times what the other arms alone need. Aims at that from now on.
    pub fn tolerate(
        &mut self,
        each: usize,
        quintic_c: &[T; 5],
        manner: Manner,
        duration: f64,
    ) -> [T; 2] {
        let peak = |bulge: &[T; BULGE]| {
            let peaks = curve_peaks(quintic_c, bulge, duration);
            match manner {
                Manner::Rate => peaks.rate,
                Manner::Acceleration => peaks.acceleration,
                Manner::Jerk | Manner::Smooth => peaks.jerk,
            }
        };
        let all = self.least_effort(quintic_c, manner).base;
        let mut others = Self::new();
        others.aims = self.aims - each;
        for i in 0..others.aims {
            (others.rows[i], others.offset[i]) = (self.rows[i + each], self.offset[i + each]);
        }
        let alone = others.least_effort(quintic_c, manner).base;
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

    /// Least `∫ weight x² dt`, the weights moved towards the least greatest `|x|` (Lawson's rule)
    /// but for a smooth move, where `x` is what the manner spares.
    pub fn least_effort(&self, quintic_c: &[T; 5], manner: Manner) -> LeastEffort<T> {
        let order = manner.order();
        let rounds = if manner == Manner::Smooth { 0 } else { ROUNDS };
        let mut weights = [T::ONE; NODES + 1];
        let mut found = self.weighted(quintic_c, order, &weights);
        for _ in 0..rounds {
            let mut most = T::ZERO;
            let mut efforts = [T::ZERO; NODES + 1];
            for node in 0..=NODES {
                let u = node_at(node);
                let x = quintic(quintic_c, u)[order] + dot(&found.base, &bulges(u)[order]);
                efforts[node] = if x < T::ZERO { -x } else { x };
                most = if efforts[node] > most { efforts[node] } else { most };
            }
            if most == T::ZERO {
                break;
            }
            for node in 0..=NODES {
                weights[node] = weights[node] * (T::from_f64(0.05) + efforts[node] / most);
            }
            found = self.weighted(quintic_c, order, &weights);
        }
        found
    }

    fn weighted(
        &self,
        quintic_c: &[T; 5],
        order: usize,
        weights: &[T; NODES + 1],
    ) -> LeastEffort<T> {
        let mut normal = Band::<T, BULGE, BULGE>::ZERO;
        let mut right = [T::ZERO; BULGE];
        for node in 0..=NODES {
            let u = node_at(node);
            let (b, q) = (bulges(u)[order], quintic(quintic_c, u)[order]);
            for i in 0..BULGE {
                let weighted = weights[node] * b[i];
                right[i] -= weighted * q;
                for j in 0..=i {
                    normal.add(i, j, weighted * b[j]);
                }
            }
        }
        let factors = normal.factor();
        let free = factors.solve(&right);
        let across: [[T; BULGE]; MAX_AIMS] = core::array::from_fn(|i| {
            if i < self.aims { factors.solve(&self.rows[i]) } else { [T::ZERO; BULGE] }
        });
        let mut gram = Band::<T, MAX_AIMS, MAX_AIMS>::ZERO;
        for i in 0..MAX_AIMS {
            if i >= self.aims {
                gram.add(i, i, T::ONE);
                continue;
            }
            for j in 0..=i {
                gram.add(i, j, dot(&self.rows[i], &across[j]));
            }
            gram.add(i, i, gram.get(i, i) * T::EPSILON * T::from_f64(16.0));
        }
        let gram = gram.factor();
        let towards: [[T; BULGE]; MAX_AIMS] = core::array::from_fn(|aim| {
            let mut unit = [T::ZERO; MAX_AIMS];
            unit[aim] = T::ONE;
            let share = gram.solve(&unit);
            core::array::from_fn(|k| {
                let mut sum = T::ZERO;
                for i in 0..MAX_AIMS {
                    sum += share[i] * across[i][k];
                }
                sum
            })
        });
        let mut base = free;
        for aim in 0..self.aims {
            let miss = self.offset[aim] + dot(&self.rows[aim], &free);
            for k in 0..BULGE {
                base[k] -= miss * towards[aim][k];
            }
        }
        LeastEffort { base, towards, factors }
    }
}

fn node_at<T: Scalar>(node: usize) -> T {
    T::from_f64(2.0 / NODES as f64) * T::from_u32(node as u32) - T::ONE
}

impl<T: Scalar> LeastEffort<T> {
    /// Bulges (turns) that change one amplitude of `others` by 1 each and none of `own`, those that
    /// this was made for; of least effort. `others` has one or two aims.
    pub fn aside(&self, own: &Linear<T>, others: &Linear<T>) -> [[T; BULGE]; 2] {
        let free: [[T; BULGE]; 2] = core::array::from_fn(|j| {
            let mut v = self.factors.solve(&others.rows[j]);
            let on = own.rows.map(|row| dot(&row, &v));
            for i in 0..own.aims {
                for k in 0..BULGE {
                    v[k] -= on[i] * self.towards[i][k];
                }
            }
            v
        });
        let mut gram = Band::<T, 2, 2>::ZERO;
        for i in 0..2 {
            for j in 0..=i {
                gram.add(i, j, dot(&others.rows[i], &free[j]));
            }
        }
        if others.aims == 1 {
            gram.add(1, 1, T::ONE);
        }
        let gram = gram.factor();
        [[T::ONE, T::ZERO], [T::ZERO, T::ONE]].map(|unit| {
            let share = gram.solve(&unit);
            core::array::from_fn(|k| share[0] * free[0][k] + share[1] * free[1][k])
        })
    }

    /// The bulge for an aim.
    pub fn bulge(&self, aim: &[T; MAX_AIMS]) -> [T; BULGE] {
        core::array::from_fn(|k| {
            let mut sum = self.base[k];
            for i in 0..MAX_AIMS {
                sum += aim[i] * self.towards[i][k];
            }
            sum
        })
    }
}
