//! The monomials in the modal coordinates that the exact kinematics are expanded in.

use crate::math::{Each, Scalar};

/// Exponents of `a₁, a₂, a₃`.
pub(crate) type Exponents = [usize; 3];

/// A list of monomials.
pub(crate) struct Table<const N: usize> {
    pub(crate) exponents: [Exponents; N],
}

/// Monomials of the quantities that are even in `a`.
pub(crate) const EVEN: Table<MAX_EVEN> =
    Table { exponents: [[2, 0, 0], [1, 1, 0], [0, 2, 0], [1, 0, 1], [0, 1, 1], [4, 0, 0]] };
pub(crate) const MAX_EVEN: usize = 6;

/// Monomials of the quantities that are odd in `a`, beyond the linear.
pub(crate) const ODD: Table<MAX_ODD> =
    Table { exponents: [[3, 0, 0], [2, 1, 0], [1, 2, 0], [0, 3, 0], [2, 0, 1], [5, 0, 0]] };
pub(crate) const MAX_ODD: usize = 6;

impl<const N: usize> Table<N> {
    /// Calls `f` with the place and the exponents of each monomial of the first `K` modes.
    #[inline(always)]
    pub(crate) fn each<const K: usize>(&self, mut f: impl FnMut(usize, Exponents)) {
        for n in 0..N {
            if of_modes::<K>(self.exponents[n]) {
                f(n, self.exponents[n]);
            }
        }
    }

    /// The values of the monomials; zero for those that take no part.
    pub(crate) fn values<T: Scalar, const K: usize>(&self, a: &[T; K]) -> [T; N] {
        let powers = Powers::new(a);
        let mut values = [T::ZERO; N];
        self.each::<K>(|n, e| values[n] = powers.of(e));
        values
    }
}

/// [`Table::values`] for constants.
pub(crate) const fn values_of<const K: usize, const N: usize>(
    exponents: &[Exponents; N],
    a: &[f64; K],
) -> [f64; N] {
    let mut values = [0.0; N];
    let mut n = 0;
    while n < N {
        if of_modes::<K>(exponents[n]) {
            values[n] = 1.0;
            let mut k = 0;
            while k < K {
                let mut e = 0;
                while e < exponents[n][k] {
                    values[n] *= a[k];
                    e += 1;
                }
                k += 1;
            }
        }
        n += 1;
    }
    values
}

/// Highest exponent.
const DEGREE: usize = 5;

/// True if it is a monomial of the first `K` modes.
#[inline(always)]
const fn of_modes<const K: usize>(e: Exponents) -> bool {
    (K > 1 || e[1] == 0) && (K > 2 || e[2] == 0)
}

/// Powers of the coordinates, from which monomials are made.
pub(crate) struct Powers<T, const K: usize>([[T; DEGREE + 1]; K]);

impl<T: Scalar, const K: usize> Powers<T, K> {
    #[inline(always)]
    pub(crate) fn new(a: &[T; K]) -> Self {
        Self(a.each(|a| {
            let mut powers = [T::ONE; DEGREE + 1];
            powers[1] = a;
            for e in 2..=DEGREE {
                powers[e] = powers[e / 2] * powers[e - e / 2];
            }
            powers
        }))
    }

    /// The monomial.
    #[inline(always)]
    pub(crate) fn of(&self, e: Exponents) -> T {
        let mut product: Option<T> = None;
        for k in 0..K {
            if e[k] > 0 {
                let power = self.0[k][e[k]];
                product = Some(product.map_or(power, |p| p * power));
            }
        }
        product.unwrap_or(T::ONE)
    }
}
