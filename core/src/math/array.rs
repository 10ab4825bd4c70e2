//! Arrays from functions, in less code than the standard library's where that code is compiled
//! often.
//!
//! `core::array::from_fn` is ready for a function that panics half-way and for elements that must
//! be dropped. Each call compiles to some 200 lines of intermediate code, two fifths of all that
//! the methods compile to; the loop below to a part of that. A desktop instantiates every method
//! many times and takes the loop. A processor takes the standard function: inlined always, the loop
//! makes set-up a tenth larger, and inlined as the compiler likes, a tick that is compiled for size
//! 3.5 % slower.

use super::{Complex, Scalar};

/// A value for elements that are not computed yet.
pub(crate) trait Blank: Copy {
    /// Any value.
    #[cfg_attr(
        not(any(unix, windows)),
        allow(dead_code, reason = "the standard functions need none")
    )]
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
#[cfg(any(unix, windows))]
#[inline]
pub(crate) fn array<T: Blank, const N: usize, F: FnMut(usize) -> T>(mut f: F) -> [T; N] {
    let mut array = [T::BLANK; N];
    for i in 0..N {
        array[i] = f(i);
    }
    array
}

#[cfg(not(any(unix, windows)))]
pub(crate) use core::array::from_fn as array;

/// Arrays, mapped in place of `array::map`, whose code is as long.
pub(crate) trait Each<T, const N: usize> {
    /// `[f(a₀), f(a₁), …]`, computed in this order.
    fn each<U: Blank>(self, f: impl FnMut(T) -> U) -> [U; N];
}

impl<T: Copy, const N: usize> Each<T, N> for [T; N] {
    #[cfg(any(unix, windows))]
    #[inline]
    fn each<U: Blank>(self, mut f: impl FnMut(T) -> U) -> [U; N] {
        array(|i| f(self[i]))
    }

    #[cfg(not(any(unix, windows)))]
    #[inline(always)]
    fn each<U: Blank>(self, f: impl FnMut(T) -> U) -> [U; N] {
        self.map(f)
    }
}
