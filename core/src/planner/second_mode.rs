//! Brings the second mode to rest too, where it is left ringing.

use super::solve::clip;
use crate::math::{Band, Scalar, array, dot};
use crate::motion::BULGE;

/// Number of unknowns, and of the amplitudes that they bring to zero: both of two modes.
pub(super) const MISSES: usize = 4;

/// Most simulations.
const MAX_SIMULATIONS: u32 = 12;

/// Squared amplitude that needs no further search, of L.
const ENOUGH: f64 = 1e-8;

/// Change of an unknown that a derivative is taken over, of L, and the longest in one step.
const PROBE: f64 = 0.005;
const LONGEST: f64 = 0.05;

/// The best bulge of a search (turns), the amplitudes that it leaves, and the simulations it took.
pub(super) struct Found<T> {
    pub bulge: [T; BULGE],
    pub miss: [T; MISSES],
    pub simulations: u32,
}

/// Looks near `bulge`, which leaves the amplitudes `miss`, for a bulge that leaves none. It moves
/// along the first `count` of `along` (turns for an amplitude of L).
///
/// Levenberg and Marquardt's method. The derivatives are differences at first and are updated by
/// Broyden's rule. A step that does not make the miss smaller is taken back.
pub(super) fn solve<T: Scalar>(
    bulge: [T; BULGE],
    miss: [T; MISSES],
    along: &[[T; BULGE]; MISSES],
    count: usize,
    mut simulate: impl FnMut(&[T; BULGE]) -> [T; MISSES],
) -> Found<T> {
    let moved = |bulge: &[T; BULGE], by: &[T; MISSES]| -> [T; BULGE] {
        array(|k| {
            let mut sum = bulge[k];
            for i in 0..MISSES {
                sum += by[i] * along[i][k];
            }
            sum
        })
    };
    let mut best = Found { bulge, miss, simulations: 0 };
    // One column an unknown.
    let mut slopes = [[T::ZERO; MISSES]; MISSES];
    for i in 0..count {
        let mut step = [T::ZERO; MISSES];
        step[i] = T::from_f64(PROBE);
        let there = simulate(&moved(&bulge, &step));
        slopes[i] = array(|m| (there[m] - miss[m]) * T::from_f64(1.0 / PROBE));
    }
    best.simulations = count as u32;
    let mut size = dot(&miss, &miss);
    let mut damping = T::from_f64(1e-3);
    while best.simulations < MAX_SIMULATIONS && size > T::from_f64(ENOUGH) {
        let step = damped_step(&slopes, &best.miss, damping, count);
        let next = moved(&best.bulge, &step);
        let there = simulate(&next);
        best.simulations += 1;
        let found = dot(&there, &there);
        let squared = dot(&step, &step);
        if !found.is_finite() || squared == T::ZERO {
            break;
        }
        update(&mut slopes, &step, squared, &best.miss, &there, count);
        if found < size {
            (best.bulge, best.miss, size) = (next, there, found);
            damping = T::from_f64(0.1) * damping;
        } else {
            damping = T::from_f64(10.0) * damping;
        }
    }
    best
}

/// Solves `(JᵀJ + damping) step = −Jᵀ miss`, each element within ± [`LONGEST`].
fn damped_step<T: Scalar>(
    slopes: &[[T; MISSES]; MISSES],
    miss: &[T; MISSES],
    damping: T,
    count: usize,
) -> [T; MISSES] {
    let mut normal = Band::<T, MISSES, MISSES>::ZERO;
    let mut right = [T::ZERO; MISSES];
    for i in 0..MISSES {
        if i >= count {
            normal.add(i, i, T::ONE);
            continue;
        }
        for j in 0..=i {
            normal.add(i, j, dot(&slopes[i], &slopes[j]));
        }
        normal.add(i, i, damping);
        right[i] = -dot(&slopes[i], miss);
    }
    let mut step = normal.factor().solve(&right);
    clip(&mut step, T::from_f64(LONGEST));
    step
}

/// Broyden's update: the slopes explain the step from `before` to `after`. `squared` is `step ·
/// step`.
fn update<T: Scalar>(
    slopes: &mut [[T; MISSES]; MISSES],
    step: &[T; MISSES],
    squared: T,
    before: &[T; MISSES],
    after: &[T; MISSES],
    count: usize,
) {
    let scale = T::ONE / squared;
    let unexplained: [T; MISSES] = array(|m| {
        let mut sum = after[m] - before[m];
        for i in 0..count {
            sum -= step[i] * slopes[i][m];
        }
        scale * sum
    });
    for i in 0..count {
        for m in 0..MISSES {
            slopes[i][m] += step[i] * unexplained[m];
        }
    }
}
