//! Finds the linear target with which the simulated arm arrives at rest: Broyden's method on a few
//! unknowns.

use super::linear::MAX_AMPLITUDES;
use crate::math::{self, Each, Scalar, array, dot};

/// The best target of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found<T> {
    /// Amplitudes for the linear model to leave, of L.
    pub target: [T; MAX_AMPLITUDES],
    /// Amplitudes that the simulated arm is left with, of L, and their squared sum.
    pub miss: [T; MAX_AMPLITUDES],
    pub squared: T,
    /// Simulations that it took.
    pub simulations: u32,
}

/// Longest change of a target in one step, of L.
const LONGEST: f64 = 0.3;

/// Solves `miss(target) = 0`, beginning with `target = 0`. The miss of a linear arm would be the
/// target itself.
///
/// Broyden's first method from the unit matrix: no derivative is evaluated. A step that
/// doubles the miss, or whose miss is not finite, is halved. The best target is returned, after at
/// most `most` simulations or once its squared miss is below `enough`.
pub(super) fn solve<T: Scalar>(
    count: usize,
    enough: T,
    most: u32,
    mut miss: impl FnMut(&[T; MAX_AMPLITUDES]) -> [T; MAX_AMPLITUDES],
) -> Found<T> {
    let zero = [T::ZERO; MAX_AMPLITUDES];
    let mut target = zero;
    let mut left = miss(&target);
    let mut best = Found { target, miss: left, squared: dot(&left, &left), simulations: 1 };
    // The inverse Jacobian.
    let mut inverse = [zero; MAX_AMPLITUDES];
    for i in 0..MAX_AMPLITUDES {
        inverse[i][i] = T::ONE;
    }
    let mut step = zero;
    let mut size = best.squared;
    while best.simulations < most && best.squared > enough {
        let doubled = T::TWO * T::TWO * best.squared;
        if size > doubled || !size.is_finite() {
            step = step.each(|x| T::HALF * x);
            target = best.target;
        } else {
            step = array(|i| -dot(&inverse[i], &left));
            clip(&mut step, T::from_f64(LONGEST));
        }
        let next = array(|i| target[i] + step[i]);
        let after = miss(&next);
        best.simulations += 1;
        let found = dot(&after, &after);
        if found.is_finite() && size.is_finite() {
            let change = array(|i| after[i] - left[i]);
            update(&mut inverse, count, &step, &change);
        }
        if found < best.squared {
            (best.target, best.miss, best.squared) = (next, after, found);
        }
        (target, left, size) = (next, after, found);
    }
    best
}

/// `B += (s − B y) sᵀB / (sᵀB y)`.
pub(super) fn update<T: Scalar>(
    inverse: &mut [[T; MAX_AMPLITUDES]; MAX_AMPLITUDES],
    count: usize,
    step: &[T; MAX_AMPLITUDES],
    change: &[T; MAX_AMPLITUDES],
) {
    let by = inverse.each(|row| dot(&row, change));
    let slope = dot(step, &by);
    let squared = dot(step, step);
    // A change at right angles to the step says nothing, and divides by nothing.
    if slope.to_f64().abs() < 0.1 * squared.to_f64() {
        return;
    }
    let sb: [T; MAX_AMPLITUDES] = array(|j| {
        let mut sum = T::ZERO;
        for i in 0..count {
            sum += step[i] * inverse[i][j];
        }
        sum
    });
    let scale = T::ONE / slope;
    for i in 0..count {
        let excess = scale * (step[i] - by[i]);
        for j in 0..count {
            inverse[i][j] += excess * sb[j];
        }
    }
}

/// Each element within `± most`.
pub(super) fn clip<T: Scalar, const N: usize>(step: &mut [T; N], most: T) {
    for x in step {
        *x = math::clip(*x, most);
    }
}
