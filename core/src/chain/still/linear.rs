//! The linear equations between bulges and what they leave.

use super::search::Search;
use super::{Bulges, Left, TERMS};
use crate::chain::factors::Factors;
use crate::math::{Complex, Scalar, array, sqrt};

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Search<'_, T, LINKS, W, C, Q>
{
    /// The bulges of least effort that leave nothing, as far as the derivative tells: with the
    /// derivative `D`, the effort `bᵀEb` and what is left `l`, `b = E⁻¹Dᵀ(DE⁻¹Dᵀ)⁻¹(Db₀ − l)`.
    pub(super) fn solve(
        &self,
        derivative: &[[Left<LINKS>; TERMS]; LINKS],
        bulges: &Bulges<LINKS>,
        left: &Left<LINKS>,
    ) -> Bulges<LINKS> {
        let effort = self.cheapness();
        let mut matrix = [[0.0; C]; C];
        let mut right = [[Complex::ZERO; W]; LINKS];
        // C is at least three times the number of links, of which two a mode are used.
        let used: [bool; C] = array(|i| i < 2 * LINKS && self.modes.frequency[i / 2].is_finite());
        let d = |j: usize, term: usize, row: usize| derivative[j][term][row / 2][row % 2];
        for row in (0..C).filter(|&row| used[row]) {
            right[row / W][row % W].re = -left[row / 2][row % 2];
            for j in 0..LINKS {
                for term in 0..TERMS {
                    right[row / W][row % W].re += d(j, term, row) * bulges[j][term];
                    for other in 0..TERMS {
                        let cheap = effort[j][term][other];
                        for column in (0..=row).filter(|&column| used[column]) {
                            matrix[row][column] += d(j, term, row) * cheap * d(j, other, column);
                        }
                    }
                }
            }
        }
        let none = [[Complex::ZERO; W]; LINKS];
        let factors = Factors::<f64, LINKS, W>::new(&matrix, &none, &used);
        let multipliers = factors.solve(&right);
        array(|j| {
            array(|term| {
                let mut sum = 0.0;
                for row in (0..C).filter(|&row| used[row]) {
                    for other in 0..TERMS {
                        sum += effort[j][term][other]
                            * d(j, other, row)
                            * multipliers[row / W][row % W].re;
                    }
                }
                sum
            })
        })
    }

    /// Inverse of the effort of each joint's bulge: of the integrals of the products of the terms'
    /// second derivatives. A joint counts with the square of the inertia that it turns.
    fn cheapness(&self) -> [[[f64; TERMS]; TERMS]; LINKS] {
        let curvature = |u: f64| {
            let w = 1.0 - u * u;
            // Second derivatives of w³, u w³ and u² w³.
            let (b, b1, b2) = (w * w * w, -6.0 * u * w * w, 24.0 * u * u * w - 6.0 * w * w);
            [b2, u * b2 + 2.0 * b1, u * u * b2 + 4.0 * u * b1 + 2.0 * b]
        };
        let mut gram = [[0.0; TERMS]; TERMS];
        for (xi, weight) in crate::math::gauss_points() {
            let c = curvature(2.0 * xi - 1.0);
            for i in 0..TERMS {
                for p in 0..TERMS {
                    gram[i][p] += weight * c[i] * c[p];
                }
            }
        }
        // The middle term is odd, the others even.
        let [[a, _, b], [_, m, _], [_, _, c]] = gram;
        let det = a * c - b * b;
        let inverse = [[c / det, 0.0, -b / det], [0.0, 1.0 / m, 0.0], [-b / det, 0.0, a / det]];
        let inertia = self.planner.chain.inertias(&self.end);
        array(|j| {
            let square = inertia[0] / inertia[j];
            inverse.map(|row| row.map(|entry| entry * square * square))
        })
    }
}

/// Length of what is left.
pub(super) fn amplitude<const LINKS: usize>(left: &Left<LINKS>) -> f64 {
    let sum: f64 = left.iter().flatten().map(|part| part * part).sum();
    // What is no number is no progress.
    if sum.is_finite() { sqrt(sum) } else { f64::INFINITY }
}

/// Broyden's change of the derivative by what a step has shown.
pub(super) fn broyden<const LINKS: usize>(
    derivative: &mut [[Left<LINKS>; TERMS]; LINKS],
    from: &Bulges<LINKS>,
    to: &Bulges<LINKS>,
    before: &Left<LINKS>,
    after: &Left<LINKS>,
) {
    let step = |j: usize, term: usize| to[j][term] - from[j][term];
    let pairs = || (0..LINKS).flat_map(|j| (0..TERMS).map(move |term| (j, term)));
    let square: f64 = pairs().map(|(j, term)| step(j, term) * step(j, term)).sum();
    if square == 0.0 || !square.is_finite() {
        return;
    }
    for mode in 0..LINKS {
        for part in 0..2 {
            let expected: f64 =
                pairs().map(|(j, term)| derivative[j][term][mode][part] * step(j, term)).sum();
            let missed = after[mode][part] - before[mode][part] - expected;
            if missed.is_finite() {
                for (j, term) in pairs() {
                    derivative[j][term][mode][part] += missed * step(j, term) / square;
                }
            }
        }
    }
}
