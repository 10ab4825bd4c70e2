//! The steps of a tick, and the answer at its end.

use super::{Pointwise, PointwiseState};
use crate::hub::HubState;
use crate::math::Scalar;
use crate::stepper::{Forcing, Response};

/// The hub within a tick: its acceleration is the parabola with the values at both ends and the
/// mean that the rate gained.
struct Course<'a, T> {
    before: &'a HubState<T>,
    after: &'a HubState<T>,
    /// Coefficients of the acceleration in the part of the tick that is gone.
    acceleration: [T; 3],
    /// h, s.
    length: T,
    /// Sine and cosine are needed.
    weighs: bool,
}

impl<'a, T: Scalar> Course<'a, T> {
    #[inline(always)]
    fn new(
        before: &'a HubState<T>,
        after: &'a HubState<T>,
        [length, per_tick]: [T; 2],
        weighs: bool,
    ) -> Self {
        let (begin, end) = (before.acceleration, after.acceleration);
        let mean = per_tick * (after.rate - before.rate);
        let [two, three] = [T::TWO, T::TWO + T::ONE];
        let bend = three * (begin + end - two * mean);
        let acceleration = [begin, end - begin - bend, bend];
        Self { before, after, acceleration, length, weighs }
    }

    /// The hub when the part `s` of the tick is gone.
    #[inline(always)]
    fn at(&self, s: T) -> HubState<T> {
        let [begin, slope, bend] = self.acceleration;
        let third = T::from_f64(1.0 / 3.0);
        let acceleration = begin + s * (slope + s * bend);
        let gained = s * (begin + s * (T::HALF * slope + s * (third * bend)));
        let rate = self.before.rate + self.length * gained;
        let mut hub = HubState { rate, acceleration, ..*self.after };
        if self.weighs {
            let (a, b) = (self.before, self.after);
            hub.sin = self.between(s, [a.sin, a.cos * a.rate], [b.sin, b.cos * b.rate]);
            hub.cos = self.between(s, [a.cos, -(a.sin * a.rate)], [b.cos, -(b.sin * b.rate)]);
        }
        hub
    }

    /// Cubic Hermite interpolation of values with their slopes, per second.
    #[inline(always)]
    fn between(&self, s: T, [x, x_dot]: [T; 2], [y, y_dot]: [T; 2]) -> T {
        let rest = T::ONE - s;
        let smooth = s * s * (T::TWO + T::ONE - T::TWO * s);
        x + smooth * (y - x) + self.length * (s * rest) * (rest * x_dot - s * y_dot)
    }
}

impl<T: Scalar, const K: usize> Pointwise<T, K> {
    /// Advances by a tick.
    // Linked once, however many paths of a tick lead to it.
    #[inline(never)]
    pub(super) fn advance(
        &self,
        state: &mut PointwiseState<T, K>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        let course = Course::new(before, after, [self.length, self.per_tick], self.weighs);
        let mut hub = *before;
        // The acceleration of the hub may have jumped since the last step.
        let mut force = self.excess(&state.coordinate, &state.rate, before);
        for step in 1..=self.steps {
            let next_hub =
                if step == self.steps { *after } else { course.at(T::from_u32(step) * self.part) };
            let drive = Forcing::between(&hub, &next_hub, self.per_step, self.alpha);
            let mut guess = [[T::ZERO; 2]; K];
            for k in 0..K {
                let at = [state.coordinate[k], state.rate[k]];
                guess[k] = self.modes[k].predict(
                    at,
                    &drive,
                    [T::ZERO, force[k]],
                    [T::ZERO, state.change[k]],
                );
            }
            let next = self.excess(&guess.map(|y| y[0]), &guess.map(|y| y[1]), &next_hub);
            for k in 0..K {
                let change = next[k] - force[k];
                let excess = change - state.change[k];
                let [a, v] = self.modes[k].correct(guess[k], [T::ZERO, excess]);
                (state.coordinate[k], state.rate[k], state.change[k]) = (a, v, change);
            }
            (force, hub) = (next, next_hub);
        }
        state.force = force;
    }

    /// The torque and the tip.
    #[inline(never)]
    pub(super) fn answer(&self, state: &PointwiseState<T, K>, hub: &HubState<T>) -> Response<T> {
        let PointwiseState { coordinate, rate, .. } = state;
        let load = self.points.answer(coordinate, rate, hub, &self.stiffness, &self.loss);
        Response { torque: load.torque, tip: load.tip }
    }
}
