//! Rates at the rows of a cubic spline with a continuous acceleration.

use heapless::Deque;

use super::{WINDOW, Waypoint};
use crate::hub::{Angle, HubState};

/// The way to one row from the row before.
#[derive(Clone, Copy)]
struct Span {
    /// s.
    length: f64,
    /// Mean rate, rad/s.
    mean: f64,
}

/// θ̇ at the next row, and θ̈ there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slope {
    /// rad/s.
    pub rate: f64,
    /// rad/s², the mean of the cubics on both sides; none at the last row of the window.
    pub acceleration: Option<f64>,
}

/// Rate and acceleration at the first row of the window, the hub being `here` at `border` s before
/// it.
///
/// The rates m of a cubic spline whose acceleration is continuous solve, with spans hₖ between the
/// rows and mean rates Δₖ over them,
/// `mₖ₋₁/hₖ + 2mₖ(1/hₖ + 1/hₖ₊₁) + mₖ₊₁/hₖ₊₁ = 3(Δₖ/hₖ + Δₖ₊₁/hₖ₊₁)`,
/// a tridiagonal system. What a row does to the rates before it falls by `2 − √3 = 0.27` a row, so
/// the rows beyond the window of 12 count for 1e-6 of the acceleration. A row that has a rate
/// separates what is before it from what is behind. If the path goes on beyond the window, the
/// spline has no acceleration at the window's end; else the path's last row is at rest.
pub(super) fn first_slope(
    here: &HubState<f64>,
    border: f64,
    rows: &Deque<Waypoint, WINDOW>,
    ends: bool,
) -> Slope {
    let spans = spans(here, border, rows);
    let count = rows.len();
    let given = |k: usize| rows.iter().nth(k).and_then(|row| row.rate);
    // mₖ = offset − factor mₖ₊₁, k = 0 for the hub itself.
    let (mut factors, mut offsets) = ([0.0; WINDOW + 1], [0.0; WINDOW + 1]);
    offsets[0] = here.rate;
    for k in 1..=count {
        let Span { length: h, mean } = spans[k - 1];
        let last = k == count;
        (factors[k], offsets[k]) = match given(k - 1) {
            Some(rate) => (0.0, rate),
            None if last && ends => (0.0, 0.0),
            None if last => (0.0, (3.0 * mean - offsets[k - 1]) / (2.0 - factors[k - 1])),
            None => {
                let next = spans[k];
                let pivot = 2.0 / h + 2.0 / next.length - factors[k - 1] / h;
                let load = 3.0 * (mean / h + next.mean / next.length) - offsets[k - 1] / h;
                (1.0 / (next.length * pivot), load / pivot)
            }
        };
    }
    let (mut rate, mut next_rate) = (0.0, 0.0);
    for k in (1..=count).rev() {
        next_rate = rate;
        rate = offsets[k] - factors[k] * rate;
    }
    let acceleration = (count > 1).then(|| {
        let [before, after] = [spans[0], spans[1]];
        let left = (2.0 * here.rate + 4.0 * rate - 6.0 * before.mean) / before.length;
        let right = (6.0 * after.mean - 4.0 * rate - 2.0 * next_rate) / after.length;
        0.5 * (left + right)
    });
    Slope { rate, acceleration }
}

fn spans(here: &HubState<f64>, border: f64, rows: &Deque<Waypoint, WINDOW>) -> [Span; WINDOW] {
    let mut spans = [Span { length: 1.0, mean: 0.0 }; WINDOW];
    let (mut angle, mut time) = (here.angle, border);
    for (span, row) in spans.iter_mut().zip(rows) {
        let next = Angle::from_radians(row.angle);
        let length = row.time - time;
        let mean = core::f64::consts::TAU * next.since(angle) / length;
        *span = Span { length, mean };
        (angle, time) = (next, row.time);
    }
    spans
}
