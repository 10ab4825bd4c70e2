//! Finds where to aim so that nothing is left: Broyden's method on a few unknowns.

use super::effort::MAX_AIMS;
use crate::math::{self, Scalar, dot};

/// What was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Found<T> {
    /// Where to aim, of L.
    pub aim: [T; MAX_AIMS],
    /// What is missed there, and its square.
    pub miss: [T; MAX_AIMS],
    pub squared: T,
    /// Evaluations it took.
    pub evaluations: u32,
}

/// Longest change of an aim in one step, of L.
const LONGEST: f64 = 0.3;

/// Looks for `miss(aim) = 0` from `aim = 0`, where the miss of a linear arm would be the aim itself.
///
/// Broyden's first method from the unit matrix: no derivative is ever evaluated. A step that
/// doubles the miss, or whose miss is not finite, is halved. The best aim is returned, after at
/// most `most` evaluations or once its squared miss is below `enough`.
pub(crate) fn find<T: Scalar>(
    aims: usize,
    enough: T,
    most: u32,
    mut miss: impl FnMut(&[T; MAX_AIMS]) -> [T; MAX_AIMS],
) -> Found<T> {
    let zero = [T::ZERO; MAX_AIMS];
    let mut aim = zero;
    let mut left = miss(&aim);
    let mut best = Found { aim, miss: left, squared: dot(&left, &left), evaluations: 1 };
    // The inverse Jacobian.
    let mut inverse = [zero; MAX_AIMS];
    for i in 0..MAX_AIMS {
        inverse[i][i] = T::ONE;
    }
    let mut step = zero;
    let mut size = best.squared;
    while best.evaluations < most && best.squared > enough {
        let doubled = T::TWO * T::TWO * best.squared;
        if size > doubled || !size.is_finite() {
            step = step.map(|x| T::HALF * x);
            aim = best.aim;
        } else {
            step = core::array::from_fn(|i| -dot(&inverse[i], &left));
            clip(&mut step, T::from_f64(LONGEST));
        }
        let next = core::array::from_fn(|i| aim[i] + step[i]);
        let after = miss(&next);
        best.evaluations += 1;
        let found = dot(&after, &after);
        if found.is_finite() && size.is_finite() {
            let change = core::array::from_fn(|i| after[i] - left[i]);
            update(&mut inverse, aims, &step, &change);
        }
        if found < best.squared {
            (best.aim, best.miss, best.squared) = (next, after, found);
        }
        (aim, left, size) = (next, after, found);
    }
    best
}

/// `B += (s − B y) sᵀB / (sᵀB y)`.
fn update<T: Scalar>(
    inverse: &mut [[T; MAX_AIMS]; MAX_AIMS],
    aims: usize,
    step: &[T; MAX_AIMS],
    change: &[T; MAX_AIMS],
) {
    let by = inverse.map(|row| dot(&row, change));
    let slope = dot(step, &by);
    let squared = dot(step, step);
    // A change at right angles to the step says nothing, and divides by nothing.
    if slope.to_f64().abs() < 0.1 * squared.to_f64() {
        return;
    }
    let sb: [T; MAX_AIMS] = core::array::from_fn(|j| {
        let mut sum = T::ZERO;
        for i in 0..aims {
            sum += step[i] * inverse[i][j];
        }
        sum
    });
    let scale = T::ONE / slope;
    for i in 0..aims {
        let excess = scale * (step[i] - by[i]);
        for j in 0..aims {
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
