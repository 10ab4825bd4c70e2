//! The second mode, brought to rest too where it is left ringing.

use super::aiming::clip;
use crate::math::{Band, Scalar, dot};
use crate::motion::BULGE;

/// Unknowns, and what they are to bring to zero: both amplitudes of two modes.
pub(super) const MISSES: usize = 4;

/// Most flights.
const MOST: u32 = 12;

/// Squared amplitude that needs no further search, of L.
const ENOUGH: f64 = 1e-8;

/// Change of an aim that a derivative is taken over, of L, and the longest in one step.
const PROBE: f64 = 0.005;
const LONGEST: f64 = 0.05;

/// What was found: the bulge (turns), what is missed with it, and the flights it took.
pub(super) struct Found<T> {
    pub bulge: [T; BULGE],
    pub miss: [T; MISSES],
    pub flights: u32,
}

/// Looks for a bulge near `bulge`, which misses by `miss`, that misses by nothing, going along the
/// first `aims` of `along` (turns for an amplitude of L).
///
/// Levenberg and Marquardt's method on derivatives by differences, kept up by Broyden's. A step that
/// makes the miss no smaller is taken back.
pub(super) fn find<T: Scalar>(
    bulge: [T; BULGE],
    miss: [T; MISSES],
    along: &[[T; BULGE]; MISSES],
    aims: usize,
    mut fly: impl FnMut(&[T; BULGE]) -> [T; MISSES],
) -> Found<T> {
    let moved = |bulge: &[T; BULGE], by: &[T; MISSES]| -> [T; BULGE] {
        core::array::from_fn(|k| {
            let mut sum = bulge[k];
            for i in 0..MISSES {
                sum += by[i] * along[i][k];
            }
            sum
        })
    };
    let mut best = Found { bulge, miss, flights: 0 };
    // One column an aim.
    let mut slopes = [[T::ZERO; MISSES]; MISSES];
    for i in 0..aims {
        let mut step = [T::ZERO; MISSES];
        step[i] = T::from_f64(PROBE);
        let there = fly(&moved(&bulge, &step));
        slopes[i] = core::array::from_fn(|m| (there[m] - miss[m]) * T::from_f64(1.0 / PROBE));
    }
    best.flights = aims as u32;
    let mut size = dot(&miss, &miss);
    let mut damping = T::from_f64(1e-3);
    while best.flights < MOST && size > T::from_f64(ENOUGH) {
        let mut normal = Band::<T, MISSES, MISSES>::ZERO;
        let mut right = [T::ZERO; MISSES];
        for i in 0..MISSES {
            if i >= aims {
                normal.add(i, i, T::ONE);
                continue;
            }
            for j in 0..=i {
                normal.add(i, j, dot(&slopes[i], &slopes[j]));
            }
            normal.add(i, i, damping);
            right[i] = -dot(&slopes[i], &best.miss);
        }
        let mut step = normal.factor().solve(&right);
        clip(&mut step, T::from_f64(LONGEST));
        let next = moved(&best.bulge, &step);
        let there = fly(&next);
        best.flights += 1;
        let found = dot(&there, &there);
        let squared = dot(&step, &step);
        if !found.is_finite() || squared == T::ZERO {
            break;
        }
        // Broyden: the slopes explain the step just seen.
        let scale = T::ONE / squared;
        let unexplained: [T; MISSES] = core::array::from_fn(|m| {
            let mut sum = there[m] - best.miss[m];
            for i in 0..aims {
                sum -= step[i] * slopes[i][m];
            }
            scale * sum
        });
        for i in 0..aims {
            for m in 0..MISSES {
                slopes[i][m] += step[i] * unexplained[m];
            }
        }
        if found < size {
            (best.bulge, best.miss, size) = (next, there, found);
            damping = T::from_f64(0.1) * damping;
        } else {
            damping = T::from_f64(10.0) * damping;
        }
    }
    best
}
