//! Constants of the two-stage Radau IIA step.

use crate::math::{Complex, Scalar};
use crate::scene::Damping;

/// Constants of the step for one tick length and damping.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights<T> {
    /// `h`, and shares of it.
    pub(super) h: T,
    pub(super) half: T,
    pub(super) third: T,
    pub(super) sixth: T,
    pub(super) three_quarters: T,
    pub(super) quarter: T,
    pub(super) half_square: T,
    pub(super) per_tick: T,
    /// `1/(1 + hαλ)`, and its inverse.
    pub(super) mass: Complex<T>,
    pub(super) undamped: Complex<T>,
    /// `(hβλ + h²λ²)/(1 + hαλ)`.
    pub(super) stiffness: Complex<T>,
    /// `1/h(λ + λ²)`: of the pin's condition.
    pub(super) pin: Complex<T>,
    /// `2√2` and its inverse.
    pub(super) root: T,
    pub(super) inverse_root: T,
}

impl<T: Scalar> Weights<T> {
    pub fn new(tick: f64, damping: &Damping) -> Self {
        let lambda = Complex::new(1.0 / 3.0, 1.0 / crate::math::sqrt(18.0));
        let one = Complex::new(1.0, 0.0);
        let damped = one + lambda.scaled(tick * damping.alpha);
        let mass = damped.inverse();
        let square = lambda * lambda;
        let stiffness = lambda.scaled(tick * damping.beta) + square.scaled(tick * tick);
        let f = T::from_f64;
        Self {
            h: f(tick),
            half: f(0.5 * tick),
            third: f(tick / 3.0),
            sixth: f(tick / 6.0),
            three_quarters: f(0.75 * tick),
            quarter: f(0.25 * tick),
            half_square: f(0.5 * tick * tick),
            per_tick: f(1.0 / tick),
            mass: mass.cast(),
            undamped: damped.cast(),
            stiffness: (stiffness * mass).cast(),
            pin: (lambda + square).scaled(tick).inverse().cast(),
            root: f(crate::math::sqrt(8.0)),
            inverse_root: f(1.0 / crate::math::sqrt(8.0)),
        }
    }

    /// `−R₁ + i(R₁ − R₂)/2√2`.
    #[inline(always)]
    pub fn forward(&self, first: T, second: T) -> Complex<T> {
        Complex::new(-first, self.inverse_root * (first - second))
    }

    /// The two stages' changes from the solution.
    #[inline(always)]
    pub fn back(&self, y: Complex<T>) -> [T; 2] {
        [y.re, y.re + self.root * y.im]
    }
}
