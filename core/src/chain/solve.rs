//! Solutions of the stage equations by their factors.

use super::factors::{Factors, Values};
use crate::math::{Complex, Scalar};

impl<T: Scalar, const LINKS: usize, const N: usize> Factors<T, LINKS, N> {
    /// Least pivot of the free rows, of a matrix that is real: negative of one that is not
    /// definite.
    pub fn least_pivot<const C: usize>(&self, free: &[bool; C]) -> T {
        let mut least = T::from_f64(f64::INFINITY);
        for i in (0..C).filter(|&i| free[i]) {
            let pivot = T::ONE / self.inverse[i / N][i % N].re;
            least = if pivot < least { pivot } else { least };
        }
        least
    }

    /// Solves for one right side. Rows without an unknown get 0.
    #[inline(always)]
    pub fn solve(&self, right: &Values<T, LINKS, N>) -> Values<T, LINKS, N> {
        let mut sides = [*right];
        self.forward(&mut sides);
        let [mut x] = sides;
        for i in 0..LINKS {
            for k in 0..N {
                x[i][k] = x[i][k] * self.inverse[i][k];
            }
        }
        self.backward(&mut x);
        x
    }

    /// `D⁻¹`.
    #[inline(always)]
    pub fn inverse(&self) -> &Values<T, LINKS, N> {
        &self.inverse
    }

    /// Changes each of `sides` to `L⁻¹` of it. A factor is loaded once for all of them.
    #[inline(always)]
    pub fn forward<const SIDES: usize>(&self, sides: &mut [Values<T, LINKS, N>; SIDES]) {
        if self.begins_later {
            self.forward_from::<1, SIDES>(sides);
        } else {
            self.forward_from::<0, SIDES>(sides);
        }
    }

    #[inline(never)]
    fn forward_from<const START: usize, const SIDES: usize>(
        &self,
        sides: &mut [Values<T, LINKS, N>; SIDES],
    ) {
        self.forward_within::<START, SIDES>(sides, 0);
        for i in 1..LINKS {
            self.forward_beside::<START, SIDES>(sides, i, 0);
            for p in 1..i {
                self.forward_beside::<0, SIDES>(sides, i, p);
            }
            self.forward_within::<0, SIDES>(sides, i);
        }
    }

    /// Takes columns of link `p` from `START` on from the rows of link `i`.
    #[inline(always)]
    fn forward_beside<const START: usize, const SIDES: usize>(
        &self,
        sides: &mut [Values<T, LINKS, N>; SIDES],
        i: usize,
        p: usize,
    ) {
        let block = &self.blocks[i][p];
        for k in 0..N {
            for c in START..N {
                for x in sides.iter_mut() {
                    x[i][k] = x[i][k] - block[k][c] * x[p][c];
                }
            }
        }
    }

    /// Takes a link's own columns from `START` on from its rows.
    #[inline(always)]
    fn forward_within<const START: usize, const SIDES: usize>(
        &self,
        sides: &mut [Values<T, LINKS, N>; SIDES],
        i: usize,
    ) {
        let block = &self.blocks[i][i];
        for k in START..N {
            for c in START..k {
                for x in sides.iter_mut() {
                    x[i][k] = x[i][k] - block[k][c] * x[i][c];
                }
            }
        }
    }

    /// Changes `x` to `L⁻ᵀx`.
    #[inline(always)]
    pub fn backward(&self, x: &mut Values<T, LINKS, N>) {
        if self.begins_later {
            self.backward_from::<1>(x);
        } else {
            self.backward_from::<0>(x);
        }
    }

    #[inline(never)]
    fn backward_from<const START: usize>(&self, x: &mut Values<T, LINKS, N>) {
        for i in (1..LINKS).rev() {
            self.backward_row::<0>(x, i);
        }
        self.backward_row::<START>(x, 0);
    }

    #[inline(always)]
    fn backward_row<const START: usize>(&self, x: &mut Values<T, LINKS, N>, i: usize) {
        let mut row = x[i];
        // Column k of the lower factor is row k of the upper one.
        for p in i + 1..LINKS {
            let (block, below) = (&self.blocks[p][i], &x[p]);
            for k in START..N {
                for c in 0..N {
                    row[k] = row[k] - block[c][k] * below[c];
                }
            }
        }
        for k in (START..N).rev() {
            for c in k + 1..N {
                row[k] = row[k] - self.blocks[i][i][c][k] * row[c];
            }
        }
        x[i] = row;
    }
}

/// Solves two symmetric equations of two unknowns.
#[inline(always)]
pub(super) fn solve_pair<T: Scalar>(
    [a, b, d]: [Complex<T>; 3],
    [u, v]: [Complex<T>; 2],
) -> [Complex<T>; 2] {
    let inverse = (a * d - b * b).inverse();
    [(d * u - b * v) * inverse, (a * v - b * u) * inverse]
}

#[cfg(test)]
mod tests {
    use crate::chain::factors::{Factors, Values};
    use crate::math::Complex;

    const C: usize = 9;

    /// The solution of three links with the unknowns in `free` fits their rows.
    fn assert_fits(free: [bool; C]) {
        let matrix: [[f64; C]; C] = core::array::from_fn(|i| {
            core::array::from_fn(|p| {
                let (i, p) = (i.max(p) as f64, i.min(p) as f64);
                if i == p { 4.0 + 0.3 * i } else { 1.0 / (1.0 + i + 2.0 * p) }
            })
        });
        let diagonal: Values<f64, 3, 3> = core::array::from_fn(|i| {
            core::array::from_fn(|k| Complex::new(0.1 * i as f64, 0.5 + 0.2 * k as f64))
        });
        let right: Values<f64, 3, 3> = core::array::from_fn(|i| {
            core::array::from_fn(|k| Complex::new(1.0 - 0.4 * k as f64, 0.3 * i as f64))
        });
        let x = Factors::<f64, 3, 3>::new(&matrix, &diagonal, &free).solve(&right);
        for i in 0..C {
            let mut sum = diagonal[i / 3][i % 3] * x[i / 3][i % 3] - right[i / 3][i % 3];
            for p in 0..C {
                sum = sum + x[p / 3][p % 3].scaled(matrix[i][p]);
            }
            if free[i] {
                assert!(sum.re.abs() + sum.im.abs() < 1e-13, "row {i}: {sum:?}");
            } else {
                assert_eq!(x[i / 3][i % 3], Complex::ZERO);
            }
        }
    }

    #[test]
    fn a_solution_fits_its_equations() {
        assert_fits(core::array::from_fn(|i| i != 3 && i != 7));
    }

    #[test]
    fn a_first_row_without_an_unknown_is_passed_over() {
        assert_fits(core::array::from_fn(|i| i != 0 && i != 7));
    }
}
