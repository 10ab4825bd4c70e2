//! Greatest magnitude of a polynomial over −1 … 1, found from its stationary points.

use crate::math::Scalar;

/// Coefficients of the longest polynomial: the rate of a quintic has five.
const TERMS: usize = 5;

/// Greatest `|c₀ + c₁u + … + c₄u⁴|` over `u = −1..1`.
///
/// The stationary points of a polynomial are the roots of its derivative, which is monotone between
/// its own stationary points: so the roots of each derivative, from the last one up, are bisected
/// between those of the next. Error: the scalar's rounding, because a value at a stationary point
/// differs in second order only. Not finite where a coefficient is not.
pub(crate) fn greatest<T: Scalar>(c: &[T; TERMS]) -> T {
    let mut derivatives = [*c; TERMS];
    for order in 1..TERMS {
        for k in 1..TERMS {
            derivatives[order][k - 1] = derivatives[order - 1][k] * T::from_u32(k as u32);
        }
        derivatives[order][TERMS - 1] = T::ZERO;
    }
    let mut roots = Roots::NONE;
    for derivative in derivatives[1..TERMS - 1].iter().rev() {
        roots = roots.next(derivative);
    }
    let mut most = larger(value(c, -T::ONE).abs(), value(c, T::ONE).abs());
    for &root in roots.found() {
        most = larger(most, value(c, root).abs());
    }
    // A coefficient that is no number may be lost in a comparison, but not in this sum.
    let sum = c.iter().fold(T::ZERO, |sum, &c| sum + c.abs());
    if sum.is_finite() { most } else { sum }
}

/// Roots of a polynomial strictly inside −1 … 1, in rising order.
struct Roots<T> {
    at: [T; TERMS],
    count: usize,
}

impl<T: Scalar> Roots<T> {
    const NONE: Self = Self { at: [T::ZERO; TERMS], count: 0 };

    fn found(&self) -> &[T] {
        &self.at[..self.count]
    }

    /// Returns the roots of `c`, these being the roots of its derivative.
    fn next(&self, c: &[T; TERMS]) -> Self {
        let mut next = Self::NONE;
        let mut from = -T::ONE;
        for &to in self.found().iter().chain(&[T::ONE]) {
            // A polynomial of degree three, the steepest that is asked, has three roots at most.
            if let Some(root) = crossing(c, from, to)
                && next.count < TERMS
            {
                next.at[next.count] = root;
                next.count += 1;
            }
            from = to;
        }
        next
    }
}

/// The place in `from..to` at which a monotone polynomial changes its sign.
fn crossing<T: Scalar>(c: &[T; TERMS], mut from: T, mut to: T) -> Option<T> {
    let rises = value(c, from) < T::ZERO;
    if rises == (value(c, to) < T::ZERO) {
        return None;
    }
    // Half of the scalar's digits: the value there is then right in all of them.
    let halvings = if T::EPSILON.to_f64() < 1e-12 { 30 } else { 14 };
    for _ in 0..halvings {
        let middle = T::HALF * (from + to);
        if (value(c, middle) < T::ZERO) == rises {
            from = middle;
        } else {
            to = middle;
        }
    }
    Some(T::HALF * (from + to))
}

fn value<T: Scalar>(c: &[T; TERMS], u: T) -> T {
    c.iter().rev().fold(T::ZERO, |sum, &c| sum * u + c)
}

fn larger<T: Scalar>(a: T, b: T) -> T {
    if a < b { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::greatest;

    /// `1 − 2u² + u⁴` has its peak in the middle, `u − u³` at ±1/√3, `8u⁴ − 8u² + 1` (Chebyshev) is
    /// 1 at five places.
    #[test]
    fn known_peaks_are_found() {
        let near = |c: [f64; 5], most: f64| {
            let found = greatest(&c);
            assert!((found - most).abs() < 1e-14, "{found} is not {most}");
        };
        near([1.0, 0.0, -2.0, 0.0, 1.0], 1.0);
        near([0.0, 1.0, 0.0, -1.0, 0.0], 2.0 / 27.0_f64.sqrt());
        near([1.0, 0.0, -8.0, 0.0, 8.0], 1.0);
        near([0.0; 5], 0.0);
        near([-3.0, 0.0, 0.0, 0.0, 0.0], 3.0);
        assert!(!greatest(&[0.0, f64::NAN, 0.0, 0.0, 0.0]).is_finite());
    }

    /// No value on a grid exceeds the peak, and the peak is reached to the grid's own resolution.
    #[test]
    fn no_value_exceeds_the_peak() {
        let mut seed = 1u32;
        let mut random = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(seed >> 8) / f64::from(1 << 23) - 1.0
        };
        // Interpreted, each case takes a second.
        for _ in 0..if cfg!(miri) { 1 } else { 500 } {
            let c: [f64; 5] = core::array::from_fn(|_| random());
            let peak = greatest(&c);
            let single = greatest(&c.map(|c| c as f32));
            let grid = (0..=4000).map(|i| f64::from(i) / 2000.0 - 1.0);
            let most = grid.map(|u| super::value(&c, u).abs()).fold(0.0, f64::max);
            assert!(most <= peak * (1.0 + 1e-14) && peak < most + 1e-5, "{c:?}: {most} {peak}");
            assert!((f64::from(single) - peak).abs() < 1e-5 * (1.0 + peak), "{c:?}: {single}");
        }
    }
}
