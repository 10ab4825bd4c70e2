//! Complex numbers of the tick's scalar, and the symmetric factors of a matrix of them.

use core::ops::{Add, Mul, Sub};

use super::Scalar;

/// `re + i im`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Complex<T> {
    pub re: T,
    pub im: T,
}

impl<T: Scalar> Complex<T> {
    pub const ZERO: Self = Self { re: T::ZERO, im: T::ZERO };

    pub const fn new(re: T, im: T) -> Self {
        Self { re, im }
    }

    #[inline(always)]
    pub fn scaled(self, factor: T) -> Self {
        Self { re: self.re * factor, im: self.im * factor }
    }

    /// `1/z`, with one division.
    #[inline(always)]
    pub fn inverse(self) -> Self {
        let factor = T::ONE / (self.re * self.re + self.im * self.im);
        Self { re: self.re * factor, im: -self.im * factor }
    }
}

impl Complex<f64> {
    pub fn cast<T: Scalar>(self) -> Complex<T> {
        Complex::new(T::from_f64(self.re), T::from_f64(self.im))
    }
}

impl<T: Scalar> Add for Complex<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<T: Scalar> Sub for Complex<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<T: Scalar> Mul for Complex<T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}
