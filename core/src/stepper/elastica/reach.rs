//! Keeps the remainder's arguments where its polynomials are bounded.

use crate::math::{Each, Scalar, array, words};

/// Largest weighted sum of the arguments' absolute values, in fitted ranges of the first mode.
///
/// A move of peak acceleration `A` swings the first mode by at most one range. If `A` changes its
/// sign at the worst moment, the mode turns by `3c` about `−c`, `c` half a range, and
/// `|ωa| + |p̃|` reaches `(1 + 3√2)c`, 2.6 ranges. What is fitted is therefore left as it is.
const REACH: f64 = 3.0;

/// Factor by which the other modes may go further, in their own ranges. Their reach is less well
/// known, and their polynomials are of second degree only.
const LOOSER: f64 = 4.0;

/// Scales `y = (ωa, p̃)` down to `Σ wₖ|yₖ| ≤ 3 ω₁r₁`, `r` the fitted ranges of the coordinates.
///
/// The weights are `w₁ = 1` and `wₖ = ω₁r₁/(4 ωₖrₖ)`. The third mode's `p̃` is scaled, but does not
/// count: the remainder does not depend on it. Within the bound the arguments are unchanged, to the
/// last bit. Beyond it they keep their ratios, so that each argument alone is a continuous function
/// of itself that never falls and is at most 3 (first mode) or 12 (others) ranges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach<T, const K: usize> {
    /// `3 ω₁r₁`, m √kg/s.
    most: T,
    weight: [T; K],
}

impl<T: Scalar, const K: usize> Reach<T, K> {
    /// For modes of `omega` rad/s whose coordinates are fitted up to `range`, m √kg.
    pub(super) fn new(omega: &[f64; K], range: &[f64; K]) -> Self {
        let first = omega[0] * range[0];
        Self {
            most: T::from_f64(REACH * first),
            weight: array(|k| T::from_f64(first / (LOOSER * omega[k] * range[k]))),
        }
    }

    /// `ωa` and `p̃` within reach. The same instructions for every `y`.
    #[inline(always)]
    pub(super) fn of(&self, y: &[[T; 2]; K]) -> ([T; K], [T; K]) {
        let mut sum = y[0][0].abs() + y[0][1].abs();
        for k in 1..K {
            let mut own = y[k][0].abs();
            if k == 1 {
                own += y[k][1].abs();
            }
            sum += self.weight[k] * own;
        }
        let scale = self.most / if sum > self.most { sum } else { self.most };
        (y.each(|y| scale * y[0]), y.each(|y| scale * y[1]))
    }
}

words! {
    [T: Scalar, const K: usize] Reach<T, K>: most, weight;
}

#[cfg(test)]
mod tests {
    use super::*;

    const OMEGA: [f64; 3] = [7.0, 45.0, 130.0];
    const RANGE: [f64; 3] = [0.03, 0.002, 0.0004];

    /// Magnitudes over the whole of `f32`: zero, then halves of powers of two down to subnormals
    /// and up to a quarter of the largest, so that no sum of five overflows.
    fn magnitudes() -> impl Iterator<Item = f32> {
        let powers = (-149..=125).map(|n: i32| libm::ldexpf(1.0, n));
        core::iter::once(0.0).chain(powers.flat_map(|power| [power, 1.5 * power]))
    }

    /// Largest value of argument `r` of mode `k` within reach, all others 0.
    fn bound(k: usize) -> f32 {
        let looser = if k == 0 { 1.0 } else { LOOSER };
        (REACH * looser * OMEGA[k] * RANGE[k]) as f32
    }

    fn with(others: &[[f32; 2]; 3], k: usize, r: usize, value: f32) -> [[f32; 2]; 3] {
        let mut y = *others;
        y[k][r] = value;
        y
    }

    const OTHERS: [[[f32; 2]; 3]; 3] = [
        [[0.0; 2]; 3],
        [[0.05, -0.02], [-0.03, 0.01], [0.02, 0.0]],
        [[-4.0, 30.0], [0.1, -7e3], [1e6, 0.0]],
    ];

    /// Along each argument, whatever the others are: it never falls, keeps its sign and is bounded.
    fn never_falls_and_is_bounded(k: usize, r: usize) {
        let reach = Reach::<f32, 3>::new(&OMEGA, &RANGE);
        for others in &OTHERS {
            let mut before = 0.0;
            for magnitude in magnitudes() {
                let [plus, minus] = [magnitude, -magnitude].map(|value| {
                    let (x, p) = reach.of(&with(others, k, r, value));
                    [x, p][r][k]
                });
                assert_eq!(plus, -minus, "odd: mode {k}, argument {r}, {magnitude}");
                // A rounding of the scale and one of the product.
                let least = before * (1.0 - 2.0 * f32::EPSILON);
                assert!(
                    plus >= least,
                    "mode {k}, argument {r}: {magnitude} gives {plus} < {before}"
                );
                assert!(plus <= bound(k) * (1.0 + 4.0 * f32::EPSILON), "mode {k}: {plus}");
                before = plus;
            }
        }
    }

    #[test]
    fn each_argument_is_clipped_without_falling() {
        for (k, r) in [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0)] {
            never_falls_and_is_bounded(k, r);
        }
    }

    /// An argument alone is clipped to the bound, not to less: just beyond it and far out.
    #[test]
    fn far_out_an_argument_alone_is_at_its_bound() {
        let reach = Reach::<f32, 3>::new(&OMEGA, &RANGE);
        for (k, r) in [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0)] {
            for value in [1.01 * bound(k), 1e6 * bound(k), 1e30] {
                let (x, p) = reach.of(&with(&OTHERS[0], k, r, value));
                let off = ([x, p][r][k] / bound(k) - 1.0).abs();
                assert!(off < 1e-6, "mode {k}, argument {r}, {value}: off by {off}");
            }
        }
    }

    /// Within reach every bit is kept, in `f32` and `f64`.
    #[test]
    fn within_reach_nothing_changes() {
        unchanged::<f32>();
        unchanged::<f64>();
    }

    fn unchanged<T: Scalar>() {
        let reach = Reach::<T, 3>::new(&OMEGA, &RANGE);
        let steps = [-1.0, -0.7, -0.001, 0.0, 0.3, 0.99];
        for a in steps {
            for b in steps {
                for c in steps {
                    // One range of every mode at once: the first's swing and rate together 2.
                    let y: [[T; 2]; 3] = array(|k| {
                        let range = OMEGA[k] * RANGE[k];
                        [[a, b][k.min(1)] * range, c * range].map(T::from_f64)
                    });
                    assert_eq!(reach.of(&y), (y.map(|y| y[0]), y.map(|y| y[1])));
                }
            }
        }
    }

    /// In one and two modes too, what is far out keeps its direction.
    #[test]
    fn ratios_are_kept_beyond_reach() {
        let reach = Reach::<f64, 2>::new(&[OMEGA[0], OMEGA[1]], &[RANGE[0], RANGE[1]]);
        let y = [[8.0, -4.0], [2.0, 16.0]];
        let (x, p) = reach.of(&y);
        for (clipped, given) in [(p[0], -4.0), (x[1], 2.0), (p[1], 16.0)] {
            assert!((clipped / x[0] - given / 8.0).abs() < 1e-15, "{clipped} of {}", x[0]);
        }
        let alone = Reach::<f64, 1>::new(&[OMEGA[0]], &[RANGE[0]]).of(&[[-1e9, 0.0]]);
        assert!((alone.0[0] / (-REACH * OMEGA[0] * RANGE[0]) - 1.0).abs() < 1e-15);
    }
}
