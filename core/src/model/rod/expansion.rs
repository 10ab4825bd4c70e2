//! The rod's equations of motion, expanded in its modal coordinates.
//!
//! With `T = ½vᵀMv + ω hᵀv + ½ω² T_θθ`, `v = ȧ`, the first mode is described by its momentum
//! `p = ∂T/∂v₁` and the others by their velocities (Routh's function): with `z = (p, v₂, …)`
//!
//! `R(a, z, ω) = p v₁ − T + V = ½(zᵀCz − 2ω dᵀz + ω²e) + V`,
//! `v₁ = ∂R/∂p`, `ṗ = −∂R/∂a₁`, `Pₖ = −∂R/∂vₖ`, `Ṗₖ = −∂R/∂aₖ`,
//!
//! and `t = −∂R/∂ω = dᵀz − ωe` is the angular momentum about the axis. Written with `M`, `h`,
//! `T_θθ`: `C₁₁ = 1/M₁₁`, `Cₖ₁ = −Mₖ₁/M₁₁`, `Cₖⱼ = −(Mₖⱼ − Mₖ₁M₁ⱼ/M₁₁)`, `d₁ = h₁/M₁₁`,
//! `dₖ = hₖ − Mₖ₁h₁/M₁₁`, `e = h₁²/M₁₁ − T_θθ`. `C`, `d`, `e` and `X` are even in `a`, `Y` is odd.
//! No coefficient has a small denominator where the link is bent far, as `M⁻¹` has with a heavy
//! payload: the polynomials converge up to bends of 1.5 rad.

use super::Rod;
use super::monomials::{EVEN, MAX_EVEN, MAX_ODD, ODD};
use crate::math::{Each, LeastSquares, array, dot};

/// Even quantities of three modes: `C`, `d`, `e` and two of `X`.
const MAX_QUANTITIES: usize = 15;

/// Samples along a coordinate: Chebyshev points over `−1..1`, and for the first mode over `0..1`,
/// which symmetry allows.
const SAMPLES: [f64; 5] = [-0.951, -0.588, 0.0, 0.588, 0.951];
const HALF_SAMPLES: [f64; 4] = [0.195, 0.556, 0.831, 0.981];

/// Coefficients of one even monomial in each even quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Even<T, const K: usize> {
    /// Coefficients in `C`.
    pub c: [[T; K]; K],
    /// Coefficients in `d`.
    pub d: [T; K],
    /// Coefficient in `e`.
    pub e: T,
    /// Coefficient in `∫ρA X dx + m_p X_L`.
    pub moment: T,
    /// Coefficient in the tip's X.
    pub tip: T,
}

/// Coefficients of one odd monomial in each odd quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Odd<T> {
    /// Coefficient in `∫ρA Y dx + m_p Y_L`.
    pub moment: T,
    /// Coefficient in the tip's Y.
    pub tip: T,
}

/// The expansion; at `a = 0`, `C` is `diag(1, −1, −1)`.
#[derive(Clone, Debug)]
pub(crate) struct Expansion<const K: usize> {
    /// `b = d(0)`.
    pub coupling: [f64; K],
    /// `e(0)`.
    pub e: f64,
    /// X parts at `a = 0`.
    pub moment: f64,
    pub tip: f64,
    /// Linear Y parts.
    pub linear: [Odd<f64>; K],
    pub even: [Even<f64, K>; MAX_EVEN],
    pub odd: [Odd<f64>; MAX_ODD],
}

impl<const K: usize> Even<f64, K> {
    /// Returns the coefficients one after the other, for the fit.
    fn flat(&self) -> [f64; MAX_QUANTITIES] {
        let entries = self.c.iter().flatten().chain(&self.d);
        let mut flat = [0.0; MAX_QUANTITIES];
        for (place, &value) in
            flat.iter_mut().zip(entries.chain([&self.e, &self.moment, &self.tip]))
        {
            *place = value;
        }
        flat
    }

    /// Inverse of [`Self::flat`].
    fn from_flat(flat: [f64; MAX_QUANTITIES]) -> Self {
        let scalars = K * K + K;
        Self {
            c: array(|i| array(|j| flat[K * i + j])),
            d: array(|i| flat[K * K + i]),
            e: flat[scalars],
            moment: flat[scalars + 1],
            tip: flat[scalars + 2],
        }
    }
}

/// Everything that is expanded, at one shape.
fn sample<const K: usize>(rod: &Rod<K>, a: &[f64; K]) -> (Even<f64, K>, Odd<f64>) {
    let kinetics = rod.kinetics(a);
    let (m, h) = (&kinetics.mass, &kinetics.coupling);
    let inverse = 1.0 / m[0][0];
    let even = Even {
        c: array(|i| {
            array(|j| match (i, j) {
                (0, 0) => inverse,
                (0, k) | (k, 0) => -m[k][0] * inverse,
                _ => m[i][0] * m[0][j] * inverse - m[i][j],
            })
        }),
        d: array(|k| match k {
            0 => h[0] * inverse,
            _ => h[k] - m[k][0] * h[0] * inverse,
        }),
        e: h[0] * h[0] * inverse - kinetics.inertia,
        moment: kinetics.moment[0],
        tip: kinetics.tip[0],
    };
    (even, Odd { moment: kinetics.moment[1], tip: kinetics.tip[1] })
}

impl<const K: usize> Expansion<K> {
    /// Fits the monomials by least squares over the box `|aₖ| ≤ range[k]`; values and, for Y,
    /// slopes at `a = 0` are exact. `K` is 1 to 3.
    pub(crate) fn fit(rod: &Rod<K>, range: &[f64; K]) -> Self {
        const { assert!(1 <= K && K <= 3, "1 to 3 modes") }
        let (rest, _) = sample(rod, &[0.0; K]);
        let linear: [Odd<f64>; K] = core::array::from_fn(|k| {
            // Y is odd: a difference of 1e-4 of the range errs by 1e-8 of it, cubically.
            let mut a = [0.0; K];
            a[k] = 1e-4 * range[k];
            let (_, at) = sample(rod, &a);
            Odd { moment: at.moment / a[k], tip: at.tip / a[k] }
        });
        let mut even = LeastSquares::<MAX_EVEN, MAX_QUANTITIES>::new();
        let mut odd = LeastSquares::<MAX_ODD, 2>::new();
        let straight = rest.flat();
        for_each_sample::<K>(|unit| {
            let a: [f64; K] = array(|k| unit[k] * range[k]);
            let (at, y) = sample(rod, &a);
            let mut change = at.flat();
            for (value, at_rest) in change.iter_mut().zip(&straight) {
                *value -= at_rest;
            }
            even.add(&EVEN.values(unit), &change);
            let beyond = |y: f64, slope: [f64; K]| y - dot(&slope, &a);
            let moment = beyond(y.moment, linear.each(|term| term.moment));
            odd.add(&ODD.values(unit), &[moment, beyond(y.tip, linear.each(|term| term.tip))]);
        });
        Self {
            coupling: rest.d,
            e: rest.e,
            moment: rest.moment,
            tip: rest.tip,
            linear,
            even: even.solve(&EVEN.values(range)).map(Even::from_flat),
            odd: odd.solve(&ODD.values(range)).map(|[moment, tip]| Odd { moment, tip }),
        }
    }
}

/// Calls `f` with every point of the sample grid in the unit box; `a₁ > 0` by symmetry.
fn for_each_sample<const K: usize>(mut f: impl FnMut(&[f64; K])) {
    let others = SAMPLES.len().pow(K as u32 - 1);
    for first in HALF_SAMPLES {
        for index in 0..others {
            let mut unit = [first; K];
            let mut rest = index;
            for k in 1..K {
                unit[k] = SAMPLES[rest % SAMPLES.len()];
                rest /= SAMPLES.len();
            }
            f(&unit);
        }
    }
}
