//! The rod's momentum form, expanded in its modal coordinates.
//!
//! With `p = Mȧ + hω`, `G = M⁻¹`, `g = Gh`, `s = hᵀGh − T_θθ` the motion is
//! `ȧ = Gp − gω`, `ṗ = −∂/∂a [½(pᵀGp − 2ω gᵀp + ω²s) + V]`, and `t = gᵀp − sω` is the angular
//! momentum about the axis. `G`, `g`, `s` and `X` are even in `a`, `Y` is odd.

use super::rod::Rod;
use crate::math::Band;

/// Even monomials: all `aᵢaⱼ`, and `a₁⁴`. Odd ones beyond the linear: all `aᵢaⱼaₖ`.
pub(crate) const MAX_EVEN: usize = 7;
pub(crate) const MAX_ODD: usize = 10;

/// Samples along one coordinate, over `−1..1` (the first one over `0..1`, by symmetry).
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

/// Number of even monomials.
pub(crate) const fn evens(modes: usize) -> usize {
    modes * (modes + 1) / 2 + 1
}

/// Number of cubic monomials.
pub(crate) const fn odds(modes: usize) -> usize {
    modes * (modes + 1) * (modes + 2) / 6
}

/// Even monomials in their order: `aᵢaⱼ`, `i ≤ j`, row by row, then `a₁⁴`.
fn even_monomials<const K: usize>(a: &[f64; K]) -> [f64; MAX_EVEN] {
    let mut m = [0.0; MAX_EVEN];
    let mut n = 0;
    for i in 0..K {
        for j in i..K {
            m[n] = a[i] * a[j];
            n += 1;
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
                m[n] = a[i] * a[j] * a[k];
                n += 1;
            }
        }
    }
    m
}

/// Everything that is expanded, at one shape.
struct Sample<const K: usize> {
    even: Even<f64, K>,
    odd: Odd<f64>,
}

fn sample<const K: usize>(rod: &Rod<K>, a: &[f64; K]) -> Sample<K> {
    let kinetics = rod.kinetics(a);
    let mut mass = Band::<f64, K, K>::ZERO;
    for i in 0..K {
        for j in 0..=i {
            mass.add(i, j, kinetics.mass[i][j]);
        }
    }
    let factors = mass.factor();
    let c = core::array::from_fn(|i| {
        let mut unit = [0.0; K];
        unit[i] = 1.0;
        factors.solve(&unit)
    });
    let d = factors.solve(&kinetics.coupling);
    Sample {
        even: Even {
            c,
            d,
            e: crate::math::dot(&kinetics.coupling, &d) - kinetics.inertia,
            moment: kinetics.moment[0],
            tip: kinetics.tip[0],
        },
        odd: Odd { moment: kinetics.moment[1], tip: kinetics.tip[1] },
    }
}

impl<const K: usize> Expansion<K> {
    /// Fits the monomials by least squares over the box `|aₖ| ≤ range[k]`; values and, for Y, slopes
    /// at `a = 0` are exact.
    pub(crate) fn fit(rod: &Rod<K>, range: &[f64; K]) -> Self {
        let rest = sample(rod, &[0.0; K]);
        let linear: [Odd<f64>; K] = core::array::from_fn(|k| {
            // A central difference of an odd function; its error is cubic, and fitted with the rest.
            let mut a = [0.0; K];
            a[k] = 1e-4 * range[k];
            let at = sample(rod, &a).odd;
            Odd { moment: at.moment / a[k], tip: at.tip / a[k] }
        });
        let mut fit = Self {
            coupling: rest.even.d,
            s: rest.even.e,
            moment: rest.even.moment,
            tip: rest.even.tip,
            linear,
            even: [Even { c: [[0.0; K]; K], d: [0.0; K], e: 0.0, moment: 0.0, tip: 0.0 }; MAX_EVEN],
            odd: [Odd { moment: 0.0, tip: 0.0 }; MAX_ODD],
        };
        fit.least_squares(rod, range, &rest.even);
        fit
    }

    fn least_squares(&mut self, rod: &Rod<K>, range: &[f64; K], rest: &Even<f64, K>) {
        let (n_even, n_odd) = (evens(K), odds(K));
        let mut normal = Band::<f64, MAX_EVEN, MAX_EVEN>::ZERO;
        let mut normal_odd = Band::<f64, MAX_ODD, MAX_ODD>::ZERO;
        let mut right =
            [Even { c: [[0.0; K]; K], d: [0.0; K], e: 0.0, moment: 0.0, tip: 0.0 }; MAX_EVEN];
        let mut right_odd = [Odd { moment: 0.0, tip: 0.0 }; MAX_ODD];
        for_each_sample::<K>(|unit| {
            let a: [f64; K] = core::array::from_fn(|k| unit[k] * range[k]);
            let at = sample(rod, &a);
            let m = even_monomials(unit);
            let q = odd_monomials(unit);
            for i in 0..n_even {
                for j in 0..=i {
                    normal.add(i, j, m[i] * m[j]);
                }
                let r = &mut right[i];
                for x in 0..K {
                    for y in 0..K {
                        r.c[x][y] += m[i] * (at.even.c[x][y] - rest.c[x][y]);
                    }
                    r.d[x] += m[i] * (at.even.d[x] - rest.d[x]);
                }
                r.e += m[i] * (at.even.e - rest.e);
                r.moment += m[i] * (at.even.moment - rest.moment);
                r.tip += m[i] * (at.even.tip - rest.tip);
            }
            let straight = |of: fn(&Odd<f64>) -> f64| -> f64 {
                (0..K).map(|k| of(&self.linear[k]) * a[k]).sum()
            };
            for i in 0..n_odd {
                for j in 0..=i {
                    normal_odd.add(i, j, q[i] * q[j]);
                }
                right_odd[i].moment += q[i] * (at.odd.moment - straight(|o| o.moment));
                right_odd[i].tip += q[i] * (at.odd.tip - straight(|o| o.tip));
            }
        });
        for i in n_even..MAX_EVEN {
            normal.add(i, i, 1.0);
        }
        for i in n_odd..MAX_ODD {
            normal_odd.add(i, i, 1.0);
        }
        let (factors, factors_odd) = (normal.factor(), normal_odd.factor());
        let scale = even_monomials(range);
        let scale_odd = odd_monomials(range);
        let solve = |of: &dyn Fn(&Even<f64, K>) -> f64| -> [f64; MAX_EVEN] {
            let x = factors.solve(&right.map(|r| of(&r)));
            core::array::from_fn(|i| if i < n_even { x[i] / scale[i] } else { 0.0 })
        };
        for x in 0..K {
            for y in 0..K {
                let fitted = solve(&|r| r.c[x][y]);
                (0..n_even).for_each(|i| self.even[i].c[x][y] = fitted[i]);
            }
            let fitted = solve(&|r| r.d[x]);
            (0..n_even).for_each(|i| self.even[i].d[x] = fitted[i]);
        }
        let (e, moment, tip) = (solve(&|r| r.e), solve(&|r| r.moment), solve(&|r| r.tip));
        for i in 0..n_even {
            (self.even[i].e, self.even[i].moment, self.even[i].tip) = (e[i], moment[i], tip[i]);
        }
        let solve_odd = |of: &dyn Fn(&Odd<f64>) -> f64| -> [f64; MAX_ODD] {
            let x = factors_odd.solve(&right_odd.map(|r| of(&r)));
            core::array::from_fn(|i| if i < n_odd { x[i] / scale_odd[i] } else { 0.0 })
        };
        let (moment, tip) = (solve_odd(&|r| r.moment), solve_odd(&|r| r.tip));
        for i in 0..n_odd {
            (self.odd[i].moment, self.odd[i].tip) = (moment[i], tip[i]);
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
