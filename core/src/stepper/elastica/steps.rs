//! The steps for what is known of the hub's motion.

use super::nonlinear::Value;
use super::{Elastica, ElasticaState, Quality};
use crate::hub::HubState;
use crate::math::{Each, Scalar, array};
use crate::stepper::Forcing;

impl<T: Scalar, const K: usize> Elastica<T, K> {
    /// Advances by a tick of any motion.
    #[inline(always)]
    pub(super) fn step_any(
        &self,
        quality: Quality,
        state: &mut ElasticaState<T, K>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        let forcing = if self.nonlinear.is_damped() {
            Forcing::between(before, after, self.per_tick, self.alpha)
        } else {
            Forcing::undamped(before, after, self.per_tick)
        };
        match quality {
            Quality::Fast => self.advance_by(state, &forcing, after),
            Quality::Fine => {
                let [first, second] = forcing.halves(self.quarter);
                self.advance_by(state, &first, &self.middle(before, after));
                self.advance_by(state, &second, after);
            }
        }
    }

    /// Advances by a tick with linear acceleration, without damping and gravity.
    #[inline(always)]
    pub(super) fn step_linear(
        &self,
        quality: Quality,
        state: &mut ElasticaState<T, K>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        let mut begin = before.acceleration;
        let mut gained = after.acceleration - begin;
        if quality == Quality::Fine {
            gained = T::HALF * gained;
            self.rotate(state, begin, gained, self.middle_rate(before, after));
            begin += gained;
        }
        self.rotate(state, begin, gained, after.rate);
    }

    /// Advances by a tick of a hub at rest, without damping and gravity.
    #[inline(always)]
    pub(super) fn step_at_rest(&self, quality: Quality, state: &mut ElasticaState<T, K>) {
        if quality == Quality::Fine {
            self.ring(state);
        }
        self.ring(state);
    }

    /// Returns the nonlinear terms at `y = (ωa, p̃)`, outside of the tick: those at the end of a
    /// step of modes that nothing drives, each about where it is. It links nothing but the step.
    #[inline(never)]
    pub(super) fn value_at(&self, y: &[[T; 2]; K], hub: &HubState<T>) -> Value<T, K> {
        let at_its_centre = y.each(|y| y.each(|y| -y));
        let mut state = ElasticaState {
            y: *y,
            offset: at_its_centre,
            drift: [[T::ZERO; 2]; K],
            torque: T::ZERO,
            inertia: T::ZERO,
        };
        let nothing = Forcing { begin: T::ZERO, mean: T::ZERO, end: T::ZERO };
        self.advance_by(&mut state, &nothing, hub);
        let ElasticaState { offset, torque, inertia, .. } = state;
        Value { offset, torque, inertia }
    }

    #[inline(always)]
    fn advance_by(&self, state: &mut ElasticaState<T, K>, forcing: &Forcing<T>, end: &HubState<T>) {
        if K == 1 {
            // So short that a call would cost it a twentieth.
            self.advance(state, end, forcing);
        } else {
            let &Forcing { begin, mean, end: last } = forcing;
            let &HubState { rate, sin, cos, .. } = end;
            self.advance_apart(state, begin, mean, last, rate, sin, cos);
        }
    }

    /// Does the work of [`Self::advance`] with a parabola from `begin` to `end` of that mean, and
    /// the hub at that rate, sine and cosine at the end.
    // Most of the arithmetic of a tick with every term, and linked once, however many paths and
    // qualities of a tick lead to it. Scalars are passed in floating-point registers, where a
    // structure would be stored and loaded.
    #[expect(clippy::too_many_arguments, reason = "as many registers, and nothing in memory")]
    #[inline(never)]
    fn advance_apart(
        &self,
        state: &mut ElasticaState<T, K>,
        begin: T,
        mean: T,
        end: T,
        rate: T,
        sin: T,
        cos: T,
    ) {
        let hub = HubState { rate, sin, cos, ..HubState::ZERO };
        self.advance(state, &hub, &Forcing { begin, mean, end });
    }

    /// Advances by a step, of anything that a scene can hold, with the hub at `hub` at its end.
    #[inline(always)]
    fn advance(&self, state: &mut ElasticaState<T, K>, hub: &HubState<T>, forcing: &Forcing<T>) {
        let damped = self.nonlinear.is_damped();
        let ElasticaState { y, offset, drift, .. } = state;
        let guess = array(|k| self.modes[k].predict(y[k], offset[k], drift[k], forcing, damped));
        let value = self.nonlinear.evaluate::<true, true>(&guess, hub);
        state.follow(guess, value, |k, y, excess| self.modes[k].correct(y, excess));
    }

    /// Advances by a step without damping and gravity in which the hub's acceleration gains
    /// `gained` in a straight line. The hub's rate at its end is `rate`.
    #[inline(always)]
    fn rotate(&self, state: &mut ElasticaState<T, K>, begin: T, gained: T, rate: T) {
        let ElasticaState { y, offset, drift, .. } = state;
        let guess = array(|k| self.modes[k].rotate(y[k], offset[k], drift[k], begin, gained));
        let hub = HubState { rate, ..HubState::ZERO };
        let value = self.nonlinear.evaluate::<false, true>(&guess, &hub);
        state.follow(guess, value, |k, y, excess| self.modes[k].correct_undamped(y, excess));
    }

    /// Advances by a step without damping and gravity of an arm whose hub rests.
    #[inline(always)]
    fn ring(&self, state: &mut ElasticaState<T, K>) {
        let ElasticaState { y, offset, drift, .. } = state;
        let off: [[T; 2]; K] = array(|k| self.modes[k].off(y[k], offset[k], drift[k]));
        let damping = self.numerical_damping.at(&off[0]);
        let guess = array(|k| self.modes[k].step_at_rest(y[k], off[k], drift[k], damping[k]));
        let value = self.nonlinear.evaluate::<false, false>(&guess, &HubState::ZERO);
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
