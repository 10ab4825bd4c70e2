//! Symmetric band matrices and their LDLᵀ factors.

use super::{Each, Scalar, array, dot, words};

/// Symmetric `N × N` matrix with `W − 1` sub-diagonals, row-wise: `rows[i][d] = A[i][i − d]`.
///
/// A chain of beam elements couples neighbouring nodes only, so eight of them need `W = 4` of 16
/// columns; `W = N` is a dense matrix. Entries with `d > i` do not exist and stay zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band<T, const N: usize, const W: usize> {
    rows: [[T; W]; N],
}

impl<T: Scalar, const N: usize, const W: usize> Band<T, N, W> {
    /// The zero matrix.
    pub const ZERO: Self = {
        assert!(1 <= W, "a band holds the diagonal");
        Self { rows: [[T::ZERO; W]; N] }
    };

    /// `A[i][j]`; zero outside the band.
    ///
    /// # Panics
    /// If `i` or `j` is not below `N`. Set-up only.
    pub fn get(&self, i: usize, j: usize) -> T {
        let (row, distance) = (i.max(j), i.abs_diff(j));
        if distance < W { self.rows[row][distance] } else { T::ZERO }
    }

    /// Adds `value` to `A[i][j]` and, being symmetric, to `A[j][i]`.
    ///
    /// # Panics
    /// If `(i, j)` lies outside the band. Set-up only.
    pub(crate) fn add(&mut self, i: usize, j: usize, value: T) {
        self.rows[i.max(j)][i.abs_diff(j)] += value;
    }

    /// Row `i`, beginning with its diagonal: entry `d` is `A[i][i − d]`.
    ///
    /// # Panics
    /// If `i` is not below `N`. Set-up only.
    #[inline(always)]
    pub(crate) fn row_mut(&mut self, i: usize) -> &mut [T; W] {
        &mut self.rows[i]
    }

    /// Applies `f` to each stored entry.
    pub fn map<U: Scalar>(&self, mut f: impl FnMut(T) -> U) -> Band<U, N, W> {
        Band { rows: self.rows.each(|row| row.each(&mut f)) }
    }

    /// `A + s B`.
    #[inline(always)]
    pub fn plus(&self, s: T, other: &Self) -> Self {
        let mut sum = *self;
        for i in 0..N {
            for d in 0..W {
                sum.rows[i][d] += s * other.rows[i][d];
            }
        }
        sum
    }

    /// `A x`.
    #[inline(always)]
    pub fn times(&self, x: &[T; N]) -> [T; N] {
        let mut y = [T::ZERO; N];
        for i in 0..N {
            // Rows above have only added to those above them: nothing is overwritten, and nothing
            // is added to zero, which the compiler could not leave out.
            y[i] = self.rows[i][0] * x[i];
            for d in 1..W {
                if d <= i {
                    y[i] += self.rows[i][d] * x[i - d];
                    y[i - d] += self.rows[i][d] * x[i];
                }
            }
        }
        y
    }

    /// The diagonal.
    #[inline(always)]
    pub(crate) fn diagonal(&self) -> [T; N] {
        self.rows.each(|row| row[0])
    }

    /// `A x` of a diagonal matrix, whatever its band could hold.
    #[inline(always)]
    pub(crate) fn diagonal_times(&self, x: &[T; N]) -> [T; N] {
        let mut y = *x;
        for i in 0..N {
            y[i] = self.rows[i][0] * x[i];
        }
        y
    }

    /// `A + diag(d)`.
    #[inline(always)]
    pub(crate) fn plus_diagonal(&self, d: &[T; N]) -> Self {
        let mut sum = *self;
        for i in 0..N {
            sum.rows[i][0] += d[i];
        }
        sum
    }

    /// `vᵢᵀA vⱼ` for the vectors `vᵢ`, as far as the band of the result holds it. Set-up only.
    #[inline(never)]
    pub(crate) fn onto<const K: usize, const V: usize>(
        &self,
        vectors: &[[T; N]; K],
    ) -> Band<T, K, V> {
        let mut reduced = Band::ZERO;
        for i in 0..K {
            let column = self.times(&vectors[i]);
            for j in (i + 1).saturating_sub(V)..=i {
                reduced.add(i, j, dot(&vectors[j], &column));
            }
        }
        reduced
    }

    /// Solves `A x = b` for a matrix whose factors are used once: the last pivot divides.
    #[inline(always)]
    pub fn solve(&self, b: &[T; N]) -> [T; N] {
        let Ldl { lower, inverse } = self.factor();
        let mut x = *b;
        for i in 0..N {
            for d in 1..W {
                if d <= i {
                    x[i] -= lower[i][d] * x[i - d];
                }
            }
        }
        for i in 0..N - 1 {
            x[i] = x[i] * inverse[i];
        }
        x[N - 1] = x[N - 1] / lower[N - 1][0];
        for i in (0..N).rev() {
            for d in 1..W {
                if d <= i {
                    x[i - d] -= lower[i][d] * x[i];
                }
            }
        }
        x
    }

    /// `s A`.
    #[inline(always)]
    pub fn scaled(&self, s: T) -> Self {
        Self { rows: self.rows.each(|row| row.each(|entry| s * entry)) }
    }

    /// `½ xᵀA x` as a function of `x`.
    pub fn half_form(mut self) -> HalfForm<T, N, W> {
        for row in &mut self.rows {
            row[0] = T::HALF * row[0];
        }
        HalfForm { rows: self.rows }
    }

    /// `LDLᵀ` factors by symmetric elimination without pivoting, which a positive definite
    /// matrix does not need. Cost about `N W²/2` multiplications and `N` divisions.
    ///
    /// A matrix that is not positive definite gives factors for which
    /// [`Ldl::is_positive`] is false.
    #[inline(always)]
    pub fn factor(&self) -> Ldl<T, N, W> {
        let mut lower = self.rows;
        let mut inverse = [T::ZERO; N];
        for i in 0..N {
            // Turns row i of A into c[d] = L[i][i-d] D[i-d], then into L, collecting the pivot.
            let mut pivot = lower[i][0];
            for d in (1..W).rev() {
                if d <= i {
                    let j = i - d;
                    let mut c = lower[i][d];
                    for e in 1..W {
                        if e <= j && d + e < W {
                            c -= lower[i][d + e] * lower[j][e];
                        }
                    }
                    lower[i][d] = c;
                }
            }
            for d in 1..W {
                if d <= i {
                    let c = lower[i][d];
                    let l = c * inverse[i - d];
                    pivot -= c * l;
                    lower[i][d] = l;
                }
            }
            lower[i][0] = pivot;
            inverse[i] = T::ONE / pivot;
        }
        Ldl { lower, inverse }
    }
}

impl<T: Scalar, const N: usize, const W: usize> Band<T, N, W> {
    /// [`Self::factor`], once for all of set-up.
    #[inline(never)]
    pub(crate) fn factored(&self) -> Ldl<T, N, W> {
        self.factor()
    }
}

/// `½ xᵀA x`: the lower triangle of `A`, its diagonal halved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfForm<T, const N: usize, const W: usize> {
    rows: [[T; W]; N],
}

impl<T: Scalar, const N: usize, const W: usize> HalfForm<T, N, W> {
    /// Its value, at half the cost of the product `A x`.
    #[inline(always)]
    pub fn at(&self, x: &[T; N]) -> T {
        let row = |i: usize| {
            let mut sum = self.rows[i][0] * x[i];
            for d in 1..W {
                if d <= i {
                    sum += self.rows[i][d] * x[i - d];
                }
            }
            sum * x[i]
        };
        let mut form = row(0);
        for i in 1..N {
            form += row(i);
        }
        form
    }
}

/// `A = L D Lᵀ` with unit lower-triangular `L` of `A`'s band width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ldl<T, const N: usize, const W: usize> {
    /// `lower[i][d] = L[i][i − d]` for `d ≥ 1`; `lower[i][0]` is the pivot `Dᵢ`.
    lower: [[T; W]; N],
    /// `1/Dᵢ`: the solve multiplies, it does not divide.
    inverse: [T; N],
}

impl<T: Scalar, const N: usize, const W: usize> Ldl<T, N, W> {
    /// Applies `f` to each stored number, e.g. to round set-up's factors to the tick's scalar.
    pub fn map<U: Scalar>(&self, mut f: impl FnMut(T) -> U) -> Ldl<U, N, W> {
        Ldl { lower: self.lower.each(|row| row.each(&mut f)), inverse: self.inverse.each(&mut f) }
    }

    /// `Dᵢᵢ`.
    pub(crate) fn pivot(&self, i: usize) -> T {
        self.lower[i][0]
    }

    /// `1/Dᵢᵢ`.
    pub(crate) fn inverse_pivots(&self) -> &[T; N] {
        &self.inverse
    }

    /// `S⁻¹ b` of `A = S Sᵀ`, given the roots of the inverse pivots. Set-up only.
    #[inline(never)]
    pub(crate) fn forth_half(&self, roots: &[T; N], b: &[T; N]) -> [T; N] {
        let mut x = *b;
        self.substitute_forth(&mut x);
        array(|i| roots[i] * x[i])
    }

    /// `S⁻ᵀ b`, likewise.
    #[inline(never)]
    pub(crate) fn back_half(&self, roots: &[T; N], b: &[T; N]) -> [T; N] {
        let mut x = array(|i| roots[i] * b[i]);
        self.substitute_back(&mut x);
        x
    }

    /// True if every pivot is positive and finite, so that `A` is positive definite.
    pub fn is_positive(&self) -> bool {
        self.lower.iter().all(|row| row[0] > T::ZERO && row[0].is_finite())
    }

    /// Solves `A x = b`: one forward and one back substitution.
    #[inline(always)]
    pub fn solve(&self, b: &[T; N]) -> [T; N] {
        let mut x = *b;
        self.substitute_forth(&mut x);
        for i in 0..N {
            x[i] = x[i] * self.inverse[i];
        }
        self.substitute_back(&mut x);
        x
    }

    /// `x ← L⁻¹ x`.
    #[inline(always)]
    fn substitute_forth(&self, x: &mut [T; N]) {
        for i in 0..N {
            for d in 1..W {
                if d <= i {
                    x[i] -= self.lower[i][d] * x[i - d];
                }
            }
        }
    }

    /// `x ← L⁻ᵀ x`.
    #[inline(always)]
    fn substitute_back(&self, x: &mut [T; N]) {
        for i in (0..N).rev() {
            for d in 1..W {
                if d <= i {
                    x[i - d] -= self.lower[i][d] * x[i];
                }
            }
        }
    }
}

words! {
    [T: Scalar, const N: usize, const W: usize] Band<T, N, W>: rows;
    [T: Scalar, const N: usize, const W: usize] HalfForm<T, N, W>: rows;
    [T: Scalar, const N: usize, const W: usize] Ldl<T, N, W>: lower, inverse;
}

#[cfg(test)]
mod tests {
    use super::Band;

    /// A chain of three: positive definite, two sub-diagonals, the outermost entry zero.
    fn chain() -> Band<f64, 3, 3> {
        let mut chain = Band::ZERO;
        for (i, j, value) in [(0, 0, 4.0), (1, 1, 5.0), (2, 2, 6.0), (1, 0, -1.0), (2, 1, 2.0)] {
            chain.add(i, j, value);
        }
        chain
    }

    #[test]
    fn a_product_takes_both_triangles() {
        assert_eq!(chain().times(&[1.0, 2.0, 3.0]), [2.0, 15.0, 22.0]);
        assert_eq!(chain().half_form().at(&[1.0, 2.0, 3.0]), 49.0, "half of 1·2 + 2·15 + 3·22");
    }

    #[test]
    fn solutions_satisfy_the_equations() {
        let x = [1.0, -2.0, 0.5];
        let b = chain().times(&x);
        for found in [chain().solve(&b), chain().factor().solve(&b)] {
            for i in 0..3 {
                assert!((found[i] - x[i]).abs() < 1e-15, "{found:?}");
            }
        }
    }

    #[test]
    fn an_indefinite_matrix_is_told_by_its_factors() {
        let positive = chain().factor();
        assert!(positive.is_positive());
        assert!((positive.pivot(1) - 4.75).abs() < 1e-15, "5 − 1/4: {}", positive.pivot(1));
        let mut indefinite = chain();
        indefinite.add(2, 2, -6.0);
        assert!(!indefinite.factor().is_positive());
    }
}
