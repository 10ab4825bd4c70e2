//! The steps for what is known of the hub's motion.

use super::{Elastica, ElasticaState, Quality};
use crate::hub::HubState;
use crate::math::Scalar;
use crate::stepper::Forcing;

impl<T: Scalar, const K: usize> Elastica<T, K> {
    /// Advances by a tick of any motion.
    #[inline(always)]
    pub(super) fn step_any(
        &self,
        state: &mut ElasticaState<T, K>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        let forcing = if self.nonlinear.is_damped() {
            Forcing::between(before, after, self.per_tick, self.alpha)
        } else {
            Forcing::undamped(before, after, self.per_tick)
        };
        match self.quality {
            Quality::Fast => self.advance(state, &forcing, after),
            Quality::Fine => {
                let [first, second] = forcing.halves(self.quarter);
                self.advance(state, &first, &self.middle(before, after));
                self.advance(state, &second, after);
            }
        }
    }

    /// Advances by a tick with linear acceleration, without damping and gravity.
    #[inline(always)]
    pub(super) fn step_linear(
        &self,
        state: &mut ElasticaState<T, K>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        let begin = before.acceleration;
        let gained = after.acceleration - begin;
        match self.quality {
            Quality::Fast => self.rotate(state, begin, gained, after),
            Quality::Fine => {
                let half = T::HALF * gained;
                let middle = HubState { rate: self.middle_rate(before, after), ..*after };
                self.rotate(state, begin, half, &middle);
                self.rotate(state, begin + half, half, after);
            }
        }
    }

    /// Advances by a tick of a hub at rest, without damping and gravity.
    #[inline(always)]
    pub(super) fn step_at_rest(&self, state: &mut ElasticaState<T, K>, hub: &HubState<T>) {
        if self.quality == Quality::Fine {
            self.ring(state, hub);
        }
        self.ring(state, hub);
    }

    /// A step, of anything that a scene can hold.
    #[inline(always)]
    fn advance(&self, state: &mut ElasticaState<T, K>, forcing: &Forcing<T>, end: &HubState<T>) {
        let damped = self.nonlinear.is_damped();
        let ElasticaState { y, offset, drift, .. } = state;
        let guess = core::array::from_fn(|k| {
            self.modes[k].predict(y[k], offset[k], drift[k], forcing, damped)
        });
        let value = self.nonlinear.evaluate::<true, true>(&guess, end);
        state.follow(guess, value, |k, y, excess| self.modes[k].correct(y, excess));
    }

    /// A step without damping and gravity in which the hub's acceleration gains `gained` in a
    /// straight line.
    #[inline(always)]
    fn rotate(&self, state: &mut ElasticaState<T, K>, begin: T, gained: T, end: &HubState<T>) {
        let ElasticaState { y, offset, drift, .. } = state;
        let guess = core::array::from_fn(|k| {
            self.modes[k].rotate(y[k], offset[k], drift[k], begin, gained)
        });
        let value = self.nonlinear.evaluate::<false, true>(&guess, end);
        state.follow(guess, value, |k, y, excess| self.modes[k].correct_undamped(y, excess));
    }

    /// A step without damping and gravity of an arm whose hub rests.
    #[inline(always)]
    fn ring(&self, state: &mut ElasticaState<T, K>, hub: &HubState<T>) {
        let ElasticaState { y, offset, drift, .. } = state;
        let off: [[T; 2]; K] =
            core::array::from_fn(|k| self.modes[k].off(y[k], offset[k], drift[k]));
        let damping = self.numerical_damping.at(&off[0]);
        let guess = core::array::from_fn(|k| {
            self.modes[k].step_at_rest(y[k], off[k], drift[k], damping[k])
        });
        let value = self.nonlinear.evaluate::<false, false>(&guess, hub);
        state.follow(guess, value, |k, y, excess| self.modes[k].correct_undamped(y, excess));
    }

    /// θ̇ in the middle of a tick, by cubic Hermite interpolation.
    #[inline(always)]
    fn middle_rate(&self, before: &HubState<T>, after: &HubState<T>) -> T {
        T::HALF * (before.rate + after.rate)
            + self.eighth_tick * (before.acceleration - after.acceleration)
    }

    /// The hub in the middle of a tick.
    #[inline(always)]
    fn middle(&self, before: &HubState<T>, after: &HubState<T>) -> HubState<T> {
        let between =
            |x: T, x_dot: T, y: T, y_dot: T| T::HALF * (x + y) + self.eighth_tick * (x_dot - y_dot);
        let rate = self.middle_rate(before, after);
        if !self.nonlinear.turns() {
            return HubState { rate, ..*after };
        }
        HubState {
            rate,
            sin: between(before.sin, before.cos * before.rate, after.sin, after.cos * after.rate),
            cos: between(
                before.cos,
                -(before.sin * before.rate),
                after.cos,
                -(after.sin * after.rate),
            ),
            ..*after
        }
    }
}
