//! The first half of a move: a piecewise-linear acceleration from rest.

use super::grid::Nodes;
use crate::hub::HubState;
use crate::math::Scalar;

/// Acceleration that is linear between equidistant knots, zero behind the last interval.
#[derive(Clone, Copy, Debug)]
pub(super) struct Half<T, const N: usize> {
    /// θ̈ where each interval begins, rad/s².
    pub knots: [T; N],
    /// θ̇ where each interval begins, rad/s, and at the end of the last one.
    pub rates: [T; N],
    pub end_rate: T,
    /// Duration of an interval, s.
    pub interval: T,
}

impl<T: Scalar, const N: usize> Half<T, N> {
    /// Integrates the knots.
    pub fn new(knots: [T; N], interval: T) -> Self {
        let mut rates = [T::ZERO; N];
        let mut rate = T::ZERO;
        for i in 0..N {
            rates[i] = rate;
            let next = if i + 1 < N { knots[i + 1] } else { T::ZERO };
            rate += T::HALF * interval * (knots[i] + next);
        }
        Self { knots, rates, end_rate: rate, interval }
    }

    /// Turn of a move of `duration` s, rad: both halves and the cruise between them.
    pub fn turn(&self, duration: T) -> T {
        let mut turned = T::ZERO;
        let third = T::from_f64(1.0 / 3.0);
        for i in 0..N {
            let bend = third * self.interval * (self.knots[i] + T::HALF * self.next(i));
            turned += self.interval * (self.rates[i] + bend);
        }
        let ramp = self.interval * T::from_u32(N as u32);
        T::TWO * turned + (duration - T::TWO * ramp) * self.end_rate
    }

    /// θ̈ at the end of an interval.
    pub fn next(&self, i: usize) -> T {
        if i + 1 < N { self.knots[i + 1] } else { T::ZERO }
    }

    /// The hub after `step` of `parts` steps an interval. Its angle is left at zero: without
    /// gravity nothing depends on it.
    pub fn hub(&self, step: u32, parts: u32) -> HubState<T> {
        let i = (step / parts) as usize;
        if i >= N {
            return HubState { rate: self.end_rate, ..HubState::ZERO };
        }
        let part = T::from_u32(step % parts) / T::from_u32(parts);
        let acceleration = self.knots[i] + part * (self.next(i) - self.knots[i]);
        let mean = T::HALF * (self.knots[i] + acceleration);
        let rate = self.rates[i] + part * self.interval * mean;
        HubState { rate, acceleration, ..HubState::ZERO }
    }

    /// Where the rate turns inside an interval: the interval, the place in it (0 to 1), the rate.
    pub fn turns(&self) -> impl Iterator<Item = (usize, T, T)> + '_ {
        (0..N).filter_map(|i| {
            let (from, to) = (self.knots[i], self.next(i));
            let turns = (from > T::ZERO && to < T::ZERO) || (from < T::ZERO && to > T::ZERO);
            turns.then(|| {
                let part = from / (from - to);
                (i, part, self.rates[i] + T::HALF * part * self.interval * from)
            })
        })
    }

    /// Excess of the rate over that at the nearest node, where it turns between the nodes.
    pub fn beyond_nodes(&self) -> Nodes<T, N> {
        let mut beyond = [[T::ZERO; N]; 2];
        for (i, part, rate) in self.turns() {
            let quarter = T::HALF * T::HALF;
            let (side, at) = if part < quarter && i > 0 {
                (1, i - 1)
            } else {
                (usize::from(part > T::ONE - quarter), i)
            };
            let three = T::TWO + T::ONE;
            let eighth = T::from_f64(0.125) * self.interval;
            let node = match side {
                0 => self.rates[i] + eighth * (three * self.knots[i] + self.next(i)),
                _ if at < i => self.rates[i],
                _ if i + 1 < N => self.rates[i + 1],
                _ => self.end_rate,
            };
            beyond[side][at] = rate - node;
        }
        beyond
    }
}
