//! Response of the linear arm to one knot of the acceleration.

use core::f64::consts::TAU;

use super::grid::Nodes;
use crate::math::{Scalar, array};

/// A natural mode without damping: `ä + ω²a = −b θ̈`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mode<T> {
    /// ω, rad/s.
    pub frequency: T,
    /// b, the coupling to the hub.
    pub coupling: T,
}

/// Response of a mode to a hat: θ̈ goes from 0 to 1 within an interval and back within the next.
///
/// All knots but the first are hats, shifted by whole intervals, so one response serves them all.
/// The first knot is the falling half of a hat.
#[derive(Clone, Copy, Debug)]
pub(super) struct Response<T, const N: usize> {
    /// a at the nodes after the beginning of a hat, and of the falling half.
    pub hat: Nodes<T, N>,
    pub half: Nodes<T, N>,
    /// `ȧ/ω` at the ends of the intervals.
    pub hat_rate: [T; N],
    pub half_rate: [T; N],
}

impl<T: Scalar, const N: usize> Response<T, N> {
    /// Computes the response for intervals of `interval` s, exactly but for rounding.
    pub fn new(mode: &Mode<T>, interval: f64) -> Self {
        let hat = |knot: usize| if knot == 1 { T::ONE } else { T::ZERO };
        let half = |knot: usize| if knot == 0 { T::ONE } else { T::ZERO };
        let (hat, hat_rate) = respond(mode, interval, hat);
        let (half, half_rate) = respond(mode, interval, half);
        Self { hat, half, hat_rate, half_rate }
    }

    /// a at the end of the last interval by each knot.
    pub fn deflections(&self) -> [T; N] {
        at_end(&self.hat[1], &self.half[1])
    }

    /// `ȧ/ω` at the end of the last interval by each knot.
    pub fn rates(&self) -> [T; N] {
        at_end(&self.hat_rate, &self.half_rate)
    }
}

/// Values at the end of the last interval by each knot, from those after the beginning of a hat.
fn at_end<T: Scalar, const N: usize>(hat: &[T; N], half: &[T; N]) -> [T; N] {
    array(|k| if k == 0 { half[N - 1] } else { hat[N - k] })
}

/// Advances a mode from rest over `N` intervals of a piecewise-linear acceleration: a at the nodes,
/// `ȧ/ω` at the ends of the intervals.
fn respond<T: Scalar, const N: usize>(
    mode: &Mode<T>,
    interval: f64,
    knot: impl Fn(usize) -> T,
) -> (Nodes<T, N>, [T; N]) {
    let omega = mode.frequency;
    let node = T::from_f64(0.5 * interval);
    let (sin, cos) = (T::from_f64(0.5 * interval / TAU) * omega).sin_cos_turns();
    // About the moving equilibrium `g u` the mode turns freely.
    let at_rest = -(mode.coupling / (omega * omega));
    let (mut a, mut v) = (T::ZERO, T::ZERO);
    let mut values = [[T::ZERO; N]; 2];
    let mut rates = [T::ZERO; N];
    for i in 0..N {
        let (begin, end) = (knot(i), knot(i + 1));
        let middle = T::HALF * (begin + end);
        for (side, [from, to]) in [[begin, middle], [middle, end]].into_iter().enumerate() {
            let slope = at_rest * (to - from) / (node * omega);
            let (x, y) = (a - at_rest * from, v - slope);
            a = cos * x + sin * y + at_rest * to;
            v = cos * y - sin * x + slope;
            values[side][i] = a;
        }
        rates[i] = v;
    }
    (values, rates)
}

#[cfg(test)]
mod tests {
    use super::{Mode, Response};

    /// `a = −(b/ω²)(t − sin(ωt)/ω)/h` on the ramp, the second difference of it behind the hat.
    #[test]
    fn a_hat_is_answered_as_the_formula_says() {
        let (omega, b, h) = (7.3_f64, 0.4, 0.11);
        let response = Response::<f64, 5>::new(&Mode { frequency: omega, coupling: b }, h);
        let ramp = |t: f64| {
            let t = t.max(0.0);
            -b / (omega * omega) * (t - (omega * t).sin() / omega) / h
        };
        for i in 0..5 {
            for side in 0..2 {
                let t = h * (i as f64 + 0.5 * (side + 1) as f64);
                let hat = ramp(t) - 2.0 * ramp(t - h) + ramp(t - 2.0 * h);
                assert!((response.hat[side][i] - hat).abs() < 1e-15);
                // The falling half: a step less a ramp, and the ramp back.
                let step = -b / (omega * omega) * (1.0 - (omega * t).cos());
                let half = step - ramp(t) + ramp(t - h);
                assert!((response.half[side][i] - half).abs() < 1e-15);
            }
        }
    }
}
