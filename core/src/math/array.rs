//! Arrays from functions, in less code than the standard library's.
//!
//! `core::array::from_fn` and `map` are ready for a function that panics half-way and for elements
//! that must be dropped. Each call compiles to some 200 lines of intermediate code, which was two
//! fifths of all that the methods compiled to; the loops below to a part of that. The tick of a
//! chain keeps the standard ones, with which two links take 2 % fewer instructions.

use super::{Complex, Scalar};

/// What stands in an array until its elements are computed.
pub(crate) trait Blank: Copy {
    /// Any value.
    const BLANK: Self;
}

impl<T: Scalar> Blank for T {
    const BLANK: Self = T::ZERO;
}

impl<T: Scalar> Blank for Complex<T> {
    const BLANK: Self = Complex::ZERO;
}

impl Blank for usize {
    const BLANK: Self = 0;
}

impl Blank for bool {
    const BLANK: Self = false;
}

impl<T: Blank, const N: usize> Blank for [T; N] {
    const BLANK: Self = [T::BLANK; N];
}

impl<A: Blank, B: Blank> Blank for (A, B) {
    const BLANK: Self = (A::BLANK, B::BLANK);
}

/// `[f(0), f(1), …, f(N − 1)]`, computed in this order.
#[inline]
pub(crate) fn array<T: Blank, const N: usize>(mut f: impl FnMut(usize) -> T) -> [T; N] {
    let mut array = [T::BLANK; N];
    for i in 0..N {
        array[i] = f(i);
    }
    array
}

/// Arrays, mapped in place of [`array::map`].
pub(crate) trait Each<T, const N: usize> {
    /// `[f(a₀), f(a₁), …]`, computed in this order.
    fn each<U: Blank>(self, f: impl FnMut(T) -> U) -> [U; N];
}

impl<T: Copy, const N: usize> Each<T, N> for [T; N] {
    #[inline]
    fn each<U: Blank>(self, mut f: impl FnMut(T) -> U) -> [U; N] {
        array(|i| f(self[i]))
    }
}
