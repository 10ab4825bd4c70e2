//! Factors of the stage equations: symmetric, complex on the diagonal, with rows left out that have
//! no unknown.

use crate::math::{Complex, Scalar};

/// One value of each coordinate.
pub(super) type Values<T, const LINKS: usize, const W: usize> = [[Complex<T>; W]; LINKS];

/// `LDLᵀ` of a complex symmetric matrix, without pivoting, in blocks of a link's coordinates. A
/// block's loops have fixed lengths: they unroll.
///
/// Of each link's coordinates the last `N` have a row: without the first of them, the joints, those
/// of a chain whose joints are all driven.
#[derive(Clone, Copy, Debug)]
pub(super) struct Factors<T, const LINKS: usize, const N: usize> {
    /// `L` below the diagonal, `blocks[i][p][k][c]` of row `k` of link `i` and column `c` of link
    /// `p ≤ i`. A block above it, `blocks[p][i]`, holds `L D` of the same rows and columns.
    pub(super) blocks: [[[[Complex<T>; N]; N]; LINKS]; LINKS],
    /// `1/D`, 0 in rows without an unknown: a column of theirs then changes nothing.
    pub(super) inverse: Values<T, LINKS, N>,
    /// True if the very first row has no unknown, as in a chain whose first joint is driven.
    pub(super) begins_later: bool,
}

impl<T: Scalar, const LINKS: usize, const N: usize> Factors<T, LINKS, N> {
    /// Room for factors.
    pub const NONE: Self = Self {
        blocks: [[[[Complex::ZERO; N]; N]; LINKS]; LINKS],
        inverse: [[Complex::ZERO; N]; LINKS],
        begins_later: false,
    };

    /// Factors `matrix + diag(diagonal)`, of which the lower triangle is read, in the rows and
    /// columns that are `free`.
    pub fn new<const W: usize, const C: usize>(
        matrix: &[[T; C]; C],
        diagonal: &Values<T, LINKS, W>,
        free: &[bool; C],
    ) -> Self {
        let mut factors = Self::NONE;
        factors.factor(matrix, diagonal, free);
        factors
    }

    /// Writes the factors of `matrix + diag(diagonal)`: see [`Self::new`].
    #[inline(always)]
    pub fn factor<const W: usize, const C: usize>(
        &mut self,
        matrix: &[[T; C]; C],
        diagonal: &Values<T, LINKS, W>,
        free: &[bool; C],
    ) {
        const { assert!(C == LINKS * W && N <= W, "a row a coordinate") }
        self.begins_later = N == W && !free[0];
        if self.begins_later {
            self.factor_from::<1, W, C>(matrix, diagonal, free);
        } else {
            self.factor_from::<0, W, C>(matrix, diagonal, free);
        }
    }

    /// Does the work of [`Self::factor`] from row `START` of the first link on.
    #[inline(never)]
    fn factor_from<const START: usize, const W: usize, const C: usize>(
        &mut self,
        matrix: &[[T; C]; C],
        diagonal: &Values<T, LINKS, W>,
        free: &[bool; C],
    ) {
        for i in 0..LINKS {
            if i > 0 {
                let block = Self::block_of::<W, C>(matrix, i, 0);
                self.scale_beside::<START, true>(block, i, 0);
            }
            for p in 1..i {
                let mut block = Self::block_of::<W, C>(matrix, i, p);
                self.subtract::<START, true, false>(&mut block, i, p, 0);
                for r in 1..p {
                    self.subtract::<START, false, false>(&mut block, i, p, r);
                }
                self.scale_beside::<START, false>(block, i, p);
            }
            let mut block = Self::block_of::<W, C>(matrix, i, i);
            for k in 0..N {
                block[k][k] = block[k][k] + diagonal[i][W - N + k];
            }
            let free = core::array::from_fn(|k| free[i * W + W - N + k]);
            if i == 0 {
                self.factor_diagonal::<START, true>(block, &free, 0);
            } else {
                self.subtract::<START, true, true>(&mut block, i, i, 0);
                for r in 1..i {
                    self.subtract::<START, false, true>(&mut block, i, i, r);
                }
                self.factor_diagonal::<START, false>(block, &free, i);
            }
        }
    }

    /// Rows of link `i` and columns of link `p` of the matrix.
    #[inline(always)]
    fn block_of<const W: usize, const C: usize>(
        matrix: &[[T; C]; C],
        i: usize,
        p: usize,
    ) -> [[Complex<T>; N]; N] {
        let (row, column) = (i * W + W - N, p * W + W - N);
        let mut block = [[Complex::ZERO; N]; N];
        for k in 0..N {
            for c in 0..N {
                block[k][c].re = matrix[row + k][column + c];
            }
        }
        block
    }

    /// `L D × L` of column `s` of a link. That of the matrix's first column is real.
    #[inline(always)]
    fn product<const START: usize, const FIRST: bool>(
        scaled: Complex<T>,
        lower: Complex<T>,
        s: usize,
    ) -> Complex<T> {
        if FIRST && s == START { lower.scaled(scaled.re) } else { scaled * lower }
    }

    /// Takes the part of link `r`, which is the `FIRST` or not, from rows of link `i` in columns of
    /// link `p`; `LOWER` says that those of the lower triangle are enough.
    #[inline(always)]
    fn subtract<const START: usize, const FIRST: bool, const LOWER: bool>(
        &self,
        block: &mut [[Complex<T>; N]; N],
        i: usize,
        p: usize,
        r: usize,
    ) {
        let (left, right) = (&self.blocks[r][i], &self.blocks[p][r]);
        for k in 0..N {
            for c in 0..(if LOWER { k + 1 } else { N }) {
                for s in (if FIRST { START } else { 0 })..N {
                    let product = Self::product::<START, FIRST>(left[k][s], right[c][s], s);
                    block[k][c] = block[k][c] - product;
                }
            }
        }
    }

    /// Rows of link `i` in the columns of link `p`, which is the `FIRST` or not.
    #[inline(always)]
    fn scale_beside<const START: usize, const FIRST: bool>(
        &mut self,
        mut block: [[Complex<T>; N]; N],
        i: usize,
        p: usize,
    ) {
        let start = if FIRST { START } else { 0 };
        for k in 0..N {
            for c in start..N {
                for s in start..c {
                    let lower = self.blocks[p][p][c][s];
                    let product = Self::product::<START, FIRST>(block[k][s], lower, s);
                    block[k][c] = block[k][c] - product;
                }
                self.blocks[i][p][k][c] =
                    Self::product::<START, FIRST>(block[k][c], self.inverse[p][c], c);
            }
        }
        self.blocks[p][i] = block;
    }

    /// Rows of link `i`, which is the `FIRST` or not, in its own columns.
    #[inline(always)]
    fn factor_diagonal<const START: usize, const FIRST: bool>(
        &mut self,
        mut block: [[Complex<T>; N]; N],
        free: &[bool; N],
        i: usize,
    ) {
        let start = if FIRST { START } else { 0 };
        for k in start..N {
            let mut pivot = block[k][k];
            for c in start..k {
                for s in start..c {
                    let lower = self.blocks[i][i][c][s];
                    let product = Self::product::<START, FIRST>(block[k][s], lower, s);
                    block[k][c] = block[k][c] - product;
                }
                let scaled = Self::product::<START, FIRST>(block[k][c], self.inverse[i][c], c);
                pivot = pivot - Self::product::<START, FIRST>(block[k][c], scaled, c);
                self.blocks[i][i][k][c] = scaled;
            }
            self.inverse[i][k] = if free[k] { pivot.inverse() } else { Complex::ZERO };
        }
    }
}
