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
use super::kinetics::Bent;
use super::monomials::{EVEN, Exponents, MAX_EVEN, MAX_ODD, ODD, values_of};
use crate::math::{LeastSquares, Normal, Scalar, array, cast, dot};

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

/// The expansion; at `a = 0`, `C` is `diag(1, −1, −1)`. The monomials are those of `aₖ/range[k]`:
/// their coefficients are of the size of the quantities, whatever the arm's.
#[derive(Clone, Debug)]
pub(crate) struct Expansion<T, const K: usize> {
    /// `b = d(0)`.
    pub coupling: [f64; K],
    /// `e(0)`.
    pub e: f64,
    /// X parts at `a = 0`.
    pub moment: f64,
    pub tip: f64,
    /// Linear Y parts.
    pub linear: [Odd<f64>; K],
    pub even: [Even<T, K>; MAX_EVEN],
    pub odd: [Odd<T>; MAX_ODD],
}

impl<T: Scalar, const K: usize> Even<T, K> {
    /// Returns the coefficients one after the other, for the fit.
    fn flat(&self) -> [T; MAX_QUANTITIES] {
        let entries = self.c.iter().flatten().chain(&self.d);
        let mut flat = [T::ZERO; MAX_QUANTITIES];
        for (place, &value) in
            flat.iter_mut().zip(entries.chain([&self.e, &self.moment, &self.tip]))
        {
            *place = value;
        }
        flat
    }

    /// Inverse of [`Self::flat`].
    fn from_flat(flat: [T; MAX_QUANTITIES]) -> Self {
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
fn sample<T: Scalar, const K: usize>(rod: &Bent<T, K>, a: &[T; K]) -> (Even<T, K>, Odd<T>) {
    let kinetics = rod.kinetics(a);
    let (m, h) = (&kinetics.mass, &kinetics.coupling);
    let inverse = T::ONE / m[0][0];
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

impl<T: Scalar, const K: usize> Expansion<T, K> {
    /// Fits the monomials by least squares over the box `|aₖ| ≤ range[k]`; values and, for Y,
    /// slopes at `a = 0` are exact. `K` is 1 to 3.
    ///
    /// Samples and fit are in the scalar of the tick, the values at rest in f64: what rounding
    /// adds to a change is a rounding of the quantity.
    pub(crate) fn fit(rod: &Rod<K>, range: &[f64; K]) -> Self {
        const { assert!(1 <= K && K <= 3, "1 to 3 modes") }
        let straight = rod.straight();
        let linear: [Odd<f64>; K] = core::array::from_fn(|k| Odd {
            moment: straight.moment_slope[k],
            tip: straight.tip_slope[k],
        });
        let slopes: [[T; K]; 2] = [cast(&straight.moment_slope), cast(&straight.tip_slope)];
        let mut even = LeastSquares::<T, MAX_EVEN, MAX_QUANTITIES>::new();
        let mut odd = LeastSquares::<T, MAX_ODD, 2>::new();
        let bent = Bent::new(rod);
        let at_rest = sample(&bent, &[T::ZERO; K]).0.flat();
        for place in 0..samples::<K>() {
            let unit = unit::<K>(place);
            let a: [T; K] = array(|k| T::from_f64(unit[k] * range[k]));
            let unit: [T; K] = cast(&unit);
            let (at, y) = sample(&bent, &a);
            let at = at.flat();
            even.add(&EVEN.values(&unit), &array(|q| at[q] - at_rest[q]));
            let beyond = [y.moment - dot(&slopes[0], &a), y.tip - dot(&slopes[1], &a)];
            odd.add(&ODD.values(&unit), &beyond);
        }
        let coupling = straight.coupling;
        Self {
            coupling,
            e: coupling[0] * coupling[0] - straight.inertia,
            moment: straight.moment,
            tip: straight.tip,
            linear,
            even: even.solve(const { &normal::<K, MAX_EVEN>(EVEN.exponents) }).map(Even::from_flat),
            odd: odd
                .solve(const { &normal::<K, MAX_ODD>(ODD.exponents) })
                .map(|[moment, tip]| Odd { moment, tip }),
        }
    }
}

/// Number of sample points: `a₁ > 0` by symmetry.
const fn samples<const K: usize>() -> usize {
    HALF_SAMPLES.len() * SAMPLES.len().pow(K as u32 - 1)
}

/// A point of the sample grid in the unit box.
const fn unit<const K: usize>(place: usize) -> [f64; K] {
    let mut unit = [HALF_SAMPLES[place % HALF_SAMPLES.len()]; K];
    let mut rest = place / HALF_SAMPLES.len();
    let mut k = 1;
    while k < K {
        unit[k] = SAMPLES[rest % SAMPLES.len()];
        rest /= SAMPLES.len();
        k += 1;
    }
    unit
}

/// The normal equations of the monomials over the grid, the same for every arm.
const fn normal<const K: usize, const M: usize>(monomials: [Exponents; M]) -> Normal<M> {
    let mut matrix = [[0.0; M]; M];
    let mut place = 0;
    while place < samples::<K>() {
        let values = values_of(&monomials, &unit::<K>(place));
        let mut i = 0;
        while i < M {
            let mut j = 0;
            while j < M {
                matrix[i][j] += values[i] * values[j];
                j += 1;
            }
            i += 1;
        }
        place += 1;
    }
    Normal::of(matrix)
}
