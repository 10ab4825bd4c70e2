//! The polynomials that the remainder is made of, in the scaled coordinates `xₖ = ωₖaₖ`.

use crate::math::{Scalar, array, words};
use crate::model::rod::monomials::{Exponents, Table};

/// A shape of the arm, with the powers that every polynomial needs.
#[derive(Clone, Copy)]
pub(super) struct Shape<T, const K: usize> {
    pub x: [T; K],
    square: T,
    cube: T,
    /// `½x₁⁴`.
    fourth: T,
}

impl<T: Scalar, const K: usize> Shape<T, K> {
    #[inline(always)]
    pub(super) fn new(x: [T; K]) -> Self {
        let square = x[0] * x[0];
        let half = T::HALF * square;
        Self { x, square, cube: square * x[0], fourth: half * square }
    }
}

/// Highest degree in the modes beyond the first of the monomials of a quantity.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    Second,
    First,
}

/// `f = Σ qⱼₖxⱼxₖ + ½q₄x₁⁴`, `q` symmetric: an even quantity without its value at `x = 0`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Even<T, const K: usize> {
    q: [[T; K]; K],
    q4: T,
}

/// An even quantity at one shape.
#[derive(Clone, Copy)]
pub(super) struct Local<T, const K: usize> {
    pub value: T,
    /// `½∂f/∂xₖ`.
    pub half_slope: [T; K],
}

impl<T: Scalar, const K: usize> Even<T, K> {
    /// From the coefficients of the monomials in `xₖ` over its `scale`.
    pub(super) fn new<const N: usize>(
        table: &Table<N>,
        scale: &[f64; K],
        coefficient: impl Fn(usize) -> f64,
    ) -> Self {
        let mut even = Self { q: [[T::ZERO; K]; K], q4: T::ZERO };
        table.each::<K>(|n, e| {
            let scaled = coefficient(n) / power(scale, e);
            if e[0] == 4 {
                even.q4 = T::from_f64(2.0 * scaled);
                return;
            }
            for j in 0..K {
                for k in 0..K {
                    if j == k && e[k] == 2 {
                        even.q[k][k] = T::from_f64(scaled);
                    } else if j != k && e[j] == 1 && e[k] == 1 {
                        even.q[j][k] = T::from_f64(0.5 * scaled);
                    }
                }
            }
        });
        even
    }

    #[inline(always)]
    pub(super) fn at(&self, shape: &Shape<T, K>, order: Order) -> Local<T, K> {
        let x = &shape.x;
        // `fx + ½·(slope of the rest)`, by Euler's relation for what is quadratic.
        let half_slope: [T; K] = array(|k| {
            let mut sum = self.q[0][k] * x[0];
            for j in 1..K {
                let pair = (j.min(k), j.max(k));
                if k == 0 || order == Order::Second && (pair == (1, 1) || pair == (1, 2)) {
                    sum += self.q[j][k] * x[j];
                }
            }
            if k == 0 { sum + self.q4 * shape.cube } else { sum }
        });
        let mut value = half_slope[0] * x[0] - self.q4 * shape.fourth;
        for k in 1..K {
            value += half_slope[k] * x[k];
        }
        Local { value, half_slope }
    }
}

/// `f = q x₁² + ½q₄x₁⁴`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axial<T> {
    q: T,
    q4: T,
}

impl<T: Scalar> Axial<T> {
    /// The part of `even` that holds the first mode only.
    pub(super) fn of<const K: usize>(even: &Even<T, K>) -> Self {
        Self { q: even.q[0][0], q4: even.q4 }
    }

    /// The value and `½∂f/∂x₁`.
    #[inline(always)]
    pub(super) fn at<const K: usize>(&self, shape: &Shape<T, K>) -> (T, T) {
        let value = self.q * shape.square + self.q4 * shape.fourth;
        (value, self.q * shape.x[0] + self.q4 * shape.cube)
    }
}

/// `f = Σ xₖ(lₖ + sₖx₁²) + c x₁x₂² + d x₂³ + f x₁⁵`: what is odd.
#[derive(Clone, Copy, Debug)]
pub(super) struct Odd<T, const K: usize> {
    linear: [T; K],
    square: [T; K],
    /// Coefficients of `x₁x₂²` and `x₂³`.
    second: [T; 2],
    fifth: T,
}

impl<T: Scalar, const K: usize> Odd<T, K> {
    /// From the coefficients of `xₖ`, and of the monomials in it over its `scale`.
    pub(super) fn new<const N: usize>(
        table: &Table<N>,
        scale: &[f64; K],
        linear: impl Fn(usize) -> f64,
        coefficient: impl Fn(usize) -> f64,
    ) -> Self {
        let mut odd = Self {
            linear: array(|k| T::from_f64(linear(k))),
            square: [T::ZERO; K],
            second: [T::ZERO; 2],
            fifth: T::ZERO,
        };
        table.each::<K>(|n, e| {
            let scaled = T::from_f64(coefficient(n) / power(scale, e));
            match e {
                [5, 0, 0] => odd.fifth = scaled,
                [1, 2, 0] => odd.second[0] = scaled,
                [0, 3, 0] => odd.second[1] = scaled,
                _ => {
                    let other = (1..K).find(|&k| e[k] == 1).unwrap_or(0);
                    odd.square[other] = scaled;
                }
            }
        });
        odd
    }

    #[inline(always)]
    pub(super) fn value(&self, shape: &Shape<T, K>) -> T {
        let x = &shape.x;
        let mut factor: [T; K] = array(|k| self.linear[k] + self.square[k] * shape.square);
        factor[0] += self.fifth * (shape.square * shape.square);
        if K > 1 {
            let square = x[1] * x[1];
            factor[0] += self.second[0] * square;
            factor[1] += self.second[1] * square;
        }
        crate::math::dot(&factor, x)
    }

    /// `∂f/∂xₖ`.
    #[inline(always)]
    pub(super) fn slope(&self, shape: &Shape<T, K>) -> [T; K] {
        let x = &shape.x;
        let n = |n: u32| T::from_u32(n);
        let mut slope: [T; K] = array(|k| self.linear[k] + self.square[k] * shape.square);
        slope[0] += T::TWO * (self.square[0] * shape.square)
            + n(5) * (self.fifth * (shape.square * shape.square));
        for k in 1..K {
            slope[0] += T::TWO * (x[0] * (self.square[k] * x[k]));
        }
        if K > 1 {
            slope[0] += self.second[0] * (x[1] * x[1]);
            slope[1] +=
                T::TWO * (self.second[0] * (x[0] * x[1])) + n(3) * (self.second[1] * (x[1] * x[1]));
        }
        slope
    }
}

/// `Π scaleₖ^eₖ`.
fn power<const K: usize>(scale: &[f64; K], exponents: Exponents) -> f64 {
    let mut product = 1.0;
    for k in 0..K {
        for _ in 0..exponents[k] {
            product *= scale[k];
        }
    }
    product
}

words! {
    [T: Scalar, const K: usize] Even<T, K>: q, q4;
    [T: Scalar] Axial<T>: q, q4;
    [T: Scalar, const K: usize] Odd<T, K>: linear, square, second, fifth;
}
