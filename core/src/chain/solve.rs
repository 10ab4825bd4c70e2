//! Factors and solutions of the stage equations: symmetric, complex on the diagonal, with rows left
//! out that have no unknown.

use crate::math::{Complex, Scalar};

/// One value of each coordinate.
pub(super) type Values<T, const LINKS: usize, const W: usize> = [[Complex<T>; W]; LINKS];

/// `LDLᵀ` of a complex symmetric matrix, without pivoting, in blocks of a link's coordinates. A
/// block's loops have fixed lengths: they unroll.
///
/// Coordinates below `FROM` of each link have no row: with 1, the joints of a chain whose joints
/// are all driven.
#[derive(Clone, Copy, Debug)]
pub(super) struct Factors<T, const LINKS: usize, const W: usize, const FROM: usize> {
    /// `L` below the diagonal, `blocks[i][p][k][c]` of row `k` of link `i` and column `c` of link
    /// `p ≤ i`. A block above it, `blocks[p][i]`, holds `L D` of the same rows and columns.
    blocks: [[[[Complex<T>; W]; W]; LINKS]; LINKS],
    /// `1/D`, 0 in rows without an unknown: a column of theirs then changes nothing.
    inverse: Values<T, LINKS, W>,
}

impl<T: Scalar, const LINKS: usize, const W: usize, const FROM: usize> Factors<T, LINKS, W, FROM> {
    /// Factors `matrix + diag(diagonal)`, of which the lower triangle is read, in the rows and
    /// columns that are `free`.
    #[inline(always)]
    pub fn new<const C: usize>(
        matrix: &[[T; C]; C],
        diagonal: &Values<T, LINKS, W>,
        free: &[bool; C],
    ) -> Self {
        const { assert!(C == LINKS * W, "a row a coordinate") }
        let mut factors = Self {
            blocks: [[[[Complex::ZERO; W]; W]; LINKS]; LINKS],
            inverse: [[Complex::ZERO; W]; LINKS],
        };
        factors.factor(matrix, diagonal, free);
        factors
    }

    #[inline(never)]
    fn factor<const C: usize>(
        &mut self,
        matrix: &[[T; C]; C],
        diagonal: &Values<T, LINKS, W>,
        free: &[bool; C],
    ) {
        for i in 0..LINKS {
            for p in 0..i {
                self.factor_beside(matrix, i, p);
            }
            self.factor_diagonal(matrix, diagonal, free, i);
        }
    }

    /// Rows of link `i` in the columns of link `p`.
    #[inline(always)]
    fn factor_beside<const C: usize>(&mut self, matrix: &[[T; C]; C], i: usize, p: usize) {
        let mut block = [[Complex::ZERO; W]; W];
        for k in FROM..W {
            for c in FROM..W {
                block[k][c] = Complex::new(matrix[i * W + k][p * W + c], T::ZERO);
            }
        }
        for r in 0..p {
            let (left, right) = (&self.blocks[r][i], &self.blocks[p][r]);
            for k in FROM..W {
                for c in FROM..W {
                    for s in FROM..W {
                        block[k][c] = block[k][c] - left[k][s] * right[c][s];
                    }
                }
            }
        }
        for k in FROM..W {
            for c in FROM..W {
                for s in FROM..c {
                    block[k][c] = block[k][c] - block[k][s] * self.blocks[p][p][c][s];
                }
                self.blocks[i][p][k][c] = block[k][c] * self.inverse[p][c];
            }
        }
        self.blocks[p][i] = block;
    }

    /// Rows of link `i` in its own columns.
    #[inline(always)]
    fn factor_diagonal<const C: usize>(
        &mut self,
        matrix: &[[T; C]; C],
        diagonal: &Values<T, LINKS, W>,
        free: &[bool; C],
        i: usize,
    ) {
        let mut block = [[Complex::ZERO; W]; W];
        for k in FROM..W {
            for c in FROM..=k {
                block[k][c] = Complex::new(matrix[i * W + k][i * W + c], T::ZERO);
            }
            block[k][k] = block[k][k] + diagonal[i][k];
        }
        for r in 0..i {
            let (left, right) = (&self.blocks[r][i], &self.blocks[i][r]);
            for k in FROM..W {
                for c in FROM..=k {
                    for s in FROM..W {
                        block[k][c] = block[k][c] - left[k][s] * right[c][s];
                    }
                }
            }
        }
        for k in FROM..W {
            let mut pivot = block[k][k];
            for c in FROM..k {
                for s in FROM..c {
                    block[k][c] = block[k][c] - block[k][s] * self.blocks[i][i][c][s];
                }
                let scaled = block[k][c] * self.inverse[i][c];
                pivot = pivot - block[k][c] * scaled;
                self.blocks[i][i][k][c] = scaled;
            }
            self.inverse[i][k] = if free[i * W + k] { pivot.inverse() } else { Complex::ZERO };
        }
    }

    /// Least pivot of the free rows, of a matrix that is real: negative of one that is not
    /// definite.
    pub fn least_pivot<const C: usize>(&self, free: &[bool; C]) -> T {
        let mut least = T::from_f64(f64::INFINITY);
        for i in (0..C).filter(|&i| free[i]) {
            let pivot = T::ONE / self.inverse[i / W][i % W].re;
            least = if pivot < least { pivot } else { least };
        }
        least
    }

    /// Solves for one right side, which is 0 below `FROM`. Rows without an unknown get 0.
    #[inline(always)]
    pub fn solve(&self, right: &Values<T, LINKS, W>) -> Values<T, LINKS, W> {
        let mut sides = [*right];
        self.forward(&mut sides);
        let [mut x] = sides;
        for i in 0..LINKS {
            for k in FROM..W {
                x[i][k] = x[i][k] * self.inverse[i][k];
            }
        }
        self.backward(&mut x);
        x
    }

    /// `D⁻¹`.
    #[inline(always)]
    pub fn inverse(&self) -> &Values<T, LINKS, W> {
        &self.inverse
    }

    /// Changes each of `sides` to `L⁻¹` of it. A factor is loaded once for all of them.
    #[inline(never)]
    pub fn forward<const N: usize>(&self, sides: &mut [Values<T, LINKS, W>; N]) {
        for i in 0..LINKS {
            for p in 0..i {
                let block = &self.blocks[i][p];
                for k in FROM..W {
                    for c in FROM..W {
                        for x in sides.iter_mut() {
                            x[i][k] = x[i][k] - block[k][c] * x[p][c];
                        }
                    }
                }
            }
            let block = &self.blocks[i][i];
            for k in FROM..W {
                for c in FROM..k {
                    for x in sides.iter_mut() {
                        x[i][k] = x[i][k] - block[k][c] * x[i][c];
                    }
                }
            }
        }
    }

    /// Changes `x` to `L⁻ᵀx`.
    #[inline(never)]
    pub fn backward(&self, x: &mut Values<T, LINKS, W>) {
        for i in (0..LINKS).rev() {
            let mut row = x[i];
            // Column k of the lower factor is row k of the upper one.
            for p in i + 1..LINKS {
                let (block, below) = (&self.blocks[p][i], &x[p]);
                for k in FROM..W {
                    for c in FROM..W {
                        row[k] = row[k] - block[c][k] * below[c];
                    }
                }
            }
            for k in (FROM..W).rev() {
                for c in k + 1..W {
                    row[k] = row[k] - self.blocks[i][i][c][k] * row[c];
                }
            }
            x[i] = row;
        }
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
    use super::Factors;
    use crate::math::Complex;

    /// A matrix of three links with two unknowns left out: the solution fits the free rows.
    #[test]
    fn a_solution_fits_its_equations() {
        const C: usize = 9;
        let matrix: [[f64; C]; C] = core::array::from_fn(|i| {
            core::array::from_fn(|p| {
                let (i, p) = (i.max(p) as f64, i.min(p) as f64);
                if i == p { 4.0 + 0.3 * i } else { 1.0 / (1.0 + i + 2.0 * p) }
            })
        });
        let diagonal = core::array::from_fn(|i| {
            core::array::from_fn(|k| Complex::new(0.1 * i as f64, 0.5 + 0.2 * k as f64))
        });
        let free: [bool; C] = core::array::from_fn(|i| i != 3 && i != 7);
        let right = core::array::from_fn(|i| {
            core::array::from_fn(|k| Complex::new(1.0 - 0.4 * k as f64, 0.3 * i as f64))
        });
        let x = Factors::<f64, 3, 3, 0>::new(&matrix, &diagonal, &free).solve(&right);
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
}
