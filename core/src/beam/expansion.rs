//! The rod's momentum form, expanded in its modal coordinates.
//!
//! With `p = Mȧ + hω`, `G = M⁻¹`, `g = Gh`, `s = hᵀGh − T_θθ` the motion is
//! `ȧ = Gp − gω`, `ṗ = −∂/∂a [½(pᵀGp − 2ω gᵀp + ω²s) + V]`, and `t = gᵀp − sω` is the angular
//! momentum about the axis. `G`, `g`, `s` and `X` are even in `a`, `Y` is odd.

use super::rod::Rod;
use crate::math::{Band, LeastSquares, dot};

/// Most monomials, with three modes: see [`even_monomials`] and [`odd_monomials`].
pub(crate) const MAX_EVEN: usize = 6;
pub(crate) const MAX_ODD: usize = 5;

/// Even quantities of three modes: `G`, `g`, `s` and two of `X`.
const MAX_QUANTITIES: usize = 15;

/// Samples along a coordinate: Chebyshev points over `−1..1`, and for the first mode over `0..1`,
/// which symmetry allows.
const SAMPLES: [f64; 5] = [-0.951, -0.588, 0.0, 0.588, 0.951];
const HALF_SAMPLES: [f64; 4] = [0.195, 0.556, 0.831, 0.981];

/// What one even monomial multiplies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Even<T, const K: usize> {
    /// Of `G`.
    pub c: [[T; K]; K],
    /// Of `g`.
    pub d: [T; K],
    /// Of `s`.
    pub e: T,
    /// Of `∫ρA X dx + m_p X_L`.
    pub moment: T,
    /// Of the tip's X.
    pub tip: T,
}

/// What one odd monomial multiplies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Odd<T> {
    /// Of `∫ρA Y dx + m_p Y_L`.
    pub moment: T,
    /// Of the tip's Y.
    pub tip: T,
}

/// The expansion; at `a = 0`, `G` is the unit matrix.
#[derive(Clone, Debug)]
pub(crate) struct Expansion<const K: usize> {
    /// `b = g(0)`.
    pub coupling: [f64; K],
    /// `s(0)`.
    pub s: f64,
    /// X parts at `a = 0`.
    pub moment: f64,
    pub tip: f64,
    /// Linear Y parts.
    pub linear: [Odd<f64>; K],
    pub even: [Even<f64, K>; MAX_EVEN],
    pub odd: [Odd<f64>; MAX_ODD],
}

/// Is `aᵢaⱼ`, `i ≤ j`, among the even monomials? All but the third mode's square.
#[inline(always)]
pub(crate) const fn is_even_pair(i: usize, j: usize) -> bool {
    i < 2 || j < 2
}

/// Is `aᵢaⱼaₖ`, `i ≤ j ≤ k`, among the odd monomials? Those of two modes, and `a₁²a₃`.
#[inline(always)]
pub(crate) const fn is_odd_triple(i: usize, j: usize, k: usize) -> bool {
    k < 2 || (i == 0 && j == 0)
}

/// Even monomials in their order: `aᵢaⱼ`, `i ≤ j`, row by row, then `a₁⁴`.
fn even_monomials<const K: usize>(a: &[f64; K]) -> [f64; MAX_EVEN] {
    let mut m = [0.0; MAX_EVEN];
    let mut n = 0;
    for i in 0..K {
        for j in i..K {
            if is_even_pair(i, j) {
                m[n] = a[i] * a[j];
                n += 1;
            }
        }
    }
    m[n] = a[0] * a[0] * a[0] * a[0];
    m
}

/// Cubic monomials `aᵢaⱼaₖ`, `i ≤ j ≤ k`.
fn odd_monomials<const K: usize>(a: &[f64; K]) -> [f64; MAX_ODD] {
    let mut m = [0.0; MAX_ODD];
    let mut n = 0;
    for i in 0..K {
        for j in i..K {
            for k in j..K {
                if is_odd_triple(i, j, k) {
                    m[n] = a[i] * a[j] * a[k];
                    n += 1;
                }
            }
        }
    }
    m
}

impl<const K: usize> Even<f64, K> {
    /// One after the other, for the fit.
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

    /// Back from [`Self::flat`].
    fn from_flat(flat: [f64; MAX_QUANTITIES]) -> Self {
        let scalars = K * K + K;
        Self {
            c: core::array::from_fn(|i| core::array::from_fn(|j| flat[K * i + j])),
            d: core::array::from_fn(|i| flat[K * K + i]),
            e: flat[scalars],
            moment: flat[scalars + 1],
            tip: flat[scalars + 2],
        }
    }
}

/// Everything that is expanded, at one shape.
fn sample<const K: usize>(rod: &Rod<K>, a: &[f64; K]) -> (Even<f64, K>, Odd<f64>) {
    let kinetics = rod.kinetics(a);
    // M and h of the first two modes; the third, if there is one, cut off.
    let mut mass = Band::<f64, K, K>::ZERO;
    let mut coupling = kinetics.coupling;
    for i in 0..K {
        for j in 0..=i {
            match (i < 2, i == j) {
                (true, _) => mass.add(i, j, kinetics.mass[i][j]),
                (false, true) => mass.add(i, j, 1.0),
                (false, false) => {}
            }
        }
        if i >= 2 {
            coupling[i] = 0.0;
        }
    }
    let factors = mass.factor();
    let mut d = factors.solve(&coupling);
    let e = dot(&coupling, &d) - kinetics.inertia;
    let mut c = core::array::from_fn(|i| {
        let mut unit = [0.0; K];
        unit[i] = 1.0;
        factors.solve(&unit)
    });
    for k in 2..K {
        let mut across = kinetics.mass[k];
        across[k] = 0.0;
        d[k] = kinetics.coupling[k] - dot(&across, &d);
        c[k] = factors.solve(&across).map(|x| -x);
        c[k][k] = 1.0;
    }
    let even = Even { c, d, e, moment: kinetics.moment[0], tip: kinetics.tip[0] };
    (even, Odd { moment: kinetics.moment[1], tip: kinetics.tip[1] })
}

impl<const K: usize> Expansion<K> {
    /// Fits the monomials by least squares over the box `|aₖ| ≤ range[k]`; values and, for Y, slopes
    /// at `a = 0` are exact. `K` is 1 to 3.
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
            let a: [f64; K] = core::array::from_fn(|k| unit[k] * range[k]);
            let (at, y) = sample(rod, &a);
            let mut change = at.flat();
            for (value, at_rest) in change.iter_mut().zip(&straight) {
                *value -= at_rest;
            }
            even.add(&even_monomials(unit), &change);
            let beyond = |y: f64, slope: [f64; K]| y - dot(&slope, &a);
            let moment = beyond(y.moment, linear.map(|term| term.moment));
            odd.add(&odd_monomials(unit), &[moment, beyond(y.tip, linear.map(|term| term.tip))]);
        });
        Self {
            coupling: rest.d,
            s: rest.e,
            moment: rest.moment,
            tip: rest.tip,
            linear,
            even: even.solve(&even_monomials(range)).map(Even::from_flat),
            odd: odd.solve(&odd_monomials(range)).map(|[moment, tip]| Odd { moment, tip }),
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
