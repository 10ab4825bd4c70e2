//! Cubics end to end whose borders may lie between the ticks: trapezoid and S-curve.

use core::f64::consts::TAU;

use super::Segment;
use super::segment::Shape;
use super::shapes::Piece;
use crate::hub::Angle;
use crate::math::{Each, Scalar};

/// Hands the segments of cubics end to end over `ticks` ticks to `sink`. Where a stretch holds no
/// tick, the kink of the next one that does makes up for it.
pub(super) fn lay_cubics<T: Scalar>(
    pieces: &[Piece],
    turn: f64,
    start: Angle<f64>,
    ticks: u32,
    tick: f64,
    sink: &mut dyn FnMut(&Segment<T>),
) {
    let share = pieces.len() as u32;
    // Of another number an inner border may be a tick behind a stretch that holds none.
    debug_assert!(matches!(share, 1 | 3 | 7), "a prime number of stretches");
    let length = T::from_u32(ticks) / T::from_u32(share);
    let shares = |n: u32| T::from_u32(n) / T::from_u32(share);
    // Borders are multiples of a tick's share, counted in integers: at most 7 × 2²⁴ of them.
    // 2π/D and 2π/D²: rates and accelerations at the borders, rounded once.
    let duration = f64::from(ticks) * tick;
    let rate_scale = TAU * turn / duration;
    let acceleration_scale = rate_scale / duration;
    let (mut first, mut border, mut kink_moment) = (0, 0, T::ZERO);
    for piece in pieces {
        let end = border + ticks;
        let next = end.div_ceil(share);
        let (before, after) = (shares(first * share - border), shares(next * share - end));
        let shape = Shape::Cubic(piece.cubic.each(|c| T::from_f64(c) * T::from_f64(turn)));
        let start = start.plus(piece.start * turn);
        let [begin, end_acceleration] =
            piece.accelerations.each(|a| T::from_f64(acceleration_scale * a));
        let mut segment =
            Segment::new(start, shape, length, before, next - first, tick).ending(end_acceleration);
        if before == T::ZERO {
            segment = segment.beginning(T::from_f64(rate_scale * piece.rate), begin);
        }
        let [at_first, at_last] = segment.accelerations();
        if next == first {
            kink_moment += moment(T::ONE - before, T::ONE - after, begin, end_acceleration);
            segment.set_kink_moment(if after == T::ZERO { kink_moment } else { T::ZERO });
        } else {
            if before == T::ZERO {
                kink_moment = T::ZERO;
            }
            kink_moment += moment(T::ONE - before, T::ONE, begin, at_first);
            segment.set_kink_moment(kink_moment);
            // The tick's parabola goes up to the left-hand value at the border.
            let parabola = T::from_f64(1.0 / 12.0) * (at_last - end_acceleration);
            kink_moment = moment(T::ZERO, T::ONE - after, at_last, end_acceleration) - parabola;
        }
        sink(&segment);
        (first, border) = (next, end);
    }
}

/// `∫ (½ − x) θ̈ dx` over the part `a..b` of a tick `0..1`, in which θ̈ goes straight from `from`
/// to `to`.
fn moment<T: Scalar>(a: T, b: T, from: T, to: T) -> T {
    let n = T::from_f64;
    let length = b - a;
    length * (n(0.25) * (T::ONE - a - b) * (from + to) - n(1.0 / 12.0) * length * (to - from))
}
