//! A planned move with a piecewise-linear acceleration, and its rows.

use crate::motion::{Peaks, Waypoint};
use crate::planner::Prediction;

/// The fastest move from rest to rest after which the arm is at rest.
///
/// θ̈ is linear between `N` equidistant knots and zero behind the last of them, which is in the
/// middle of the move or where a cruise begins. The second half is the first one backwards, with
/// the other sign. [`Self::waypoints`] are the rows of a cubic
/// [`Path`](crate::motion::Path), whose pieces cost a tick what those of a cubic profile do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FastestMove<const N: usize> {
    /// Hub angle where the move begins, rad.
    pub from: f64,
    /// Hub angle where the move ends, rad.
    pub to: f64,
    /// Duration in whole ticks.
    pub ticks: u32,
    /// Control period h, s.
    pub tick: f64,
    /// Duration of the part up to the knot behind the last, s.
    pub ramp: f64,
    /// θ̈ at the knots, rad/s².
    pub knots: [f64; N],
    /// Greatest magnitudes of the hub's motion, between the ticks too; exact.
    pub peaks: Peaks,
    /// The arm's answer, by the planner's model.
    pub prediction: Prediction,
    /// Number of simulations of half a move that the search took.
    pub simulations: u32,
}

impl<const N: usize> FastestMove<N> {
    /// Duration T, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        f64::from(self.ticks) * self.tick
    }

    /// Returns the rows of a [`Spline::Cubic`](crate::motion::Spline::Cubic) path, first to last:
    /// one at the end of each interval, at most `2 N + 1`.
    pub fn waypoints(&self) -> impl Iterator<Item = Waypoint> + '_ {
        let cruise = self.duration() - 2.0 * self.ramp;
        let interval = self.ramp / N as f64;
        let cruises = cruise > 1e-6 * self.tick;
        let count = 2 * N + usize::from(cruises);
        let (mut angle, mut rate, mut time) = (self.from, 0.0, 0.0);
        (0..count).map(move |i| {
            let last = i + 1 == count;
            let span = if cruises && i == N { cruise } else { interval };
            let [begin, end] = [i, i + 1].map(|i| self.knot(i, count));
            angle += span * (rate + span * (2.0 * begin + end) / 6.0);
            rate += 0.5 * span * (begin + end);
            time += span;
            if last {
                // The sum of all the others rounds.
                return Waypoint::at(self.duration(), self.to).turning(0.0);
            }
            Waypoint::at(time, angle).turning(rate)
        })
    }

    /// θ̈ at border `i` of `count` pieces.
    fn knot(&self, i: usize, count: usize) -> f64 {
        let from_end = count - i;
        if i < N {
            self.knots[i]
        } else if from_end < N {
            -self.knots[from_end]
        } else {
            0.0
        }
    }
}
