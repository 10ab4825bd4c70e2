//! The steps for what is known of the hub's motion.

use super::{Modal, ModalState};
use crate::hub::HubState;
use crate::math::{Each, Scalar, array};
use crate::stepper::oscillator::Forcing;

impl<T: Scalar, const K: usize> Modal<T, K> {
    /// Advances by a tick of any motion.
    #[inline(always)]
    pub(super) fn step_any(
        &self,
        state: &mut ModalState<T, K>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        let forcing = if self.terms.damping {
            Forcing::between(before, after, self.per_tick, self.alpha)
        } else {
            Forcing::undamped(before, after, self.per_tick)
        };
        let mut y = [[T::ZERO; 2]; K];
        for k in 0..K {
            y[k] = [state.coordinate[k], state.rate[k]];
            y[k] = self.modes[k].predict_forced(y[k], &forcing, state.force[k]);
        }
        if self.terms.spin || self.terms.gravity {
            let [force, _] = self.force(&y.each(|y| y[0]), after);
            let change = self.implied(array(|k| force[k] - state.force[k]), after);
            for k in 0..K {
                y[k] = self.modes[k].correct_forced(y[k], change[k]);
                state.force[k] += change[k];
            }
            state.softening = self.spin.times(&y.each(|y| y[0]));
        }
        state.coordinate = y.each(|y| y[0]);
        state.rate = y.each(|y| y[1]);
    }

    /// Advances by a tick with linear acceleration, without damping and gravity.
    #[inline(always)]
    pub(super) fn step_linear(
        &self,
        state: &mut ModalState<T, K>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        let gained = after.acceleration - before.acceleration;
        let mut y = [[T::ZERO; 2]; K];
        let (mut predicted, mut driven) = ([T::ZERO; K], [T::ZERO; K]);
        for k in 0..K {
            let (rest, force) = (self.rest[k], state.force[k]);
            y[k] = [state.coordinate[k], state.rate[k]];
            y[k] = self.modes[k].rotate(y[k], rest, before.acceleration, force);
            driven[k] = rest * gained + force;
            predicted[k] = y[k][0] - self.modes[k].ramp(0, rest * gained);
        }
        let softening = self.spin.times(&predicted);
        let square = after.rate * after.rate;
        let force = softening.each(|f| -(square * f));
        let (mut coordinate, mut rate) = (state.coordinate, state.rate);
        for k in 0..K {
            let change = force[k] - driven[k];
            coordinate[k] = y[k][0] + self.modes[k].ramp(0, change);
            rate[k] = y[k][1] + self.modes[k].ramp(1, change);
        }
        *state = ModalState { coordinate, rate, force, softening };
    }

    /// Advances by a tick of a hub at rest.
    #[inline(always)]
    pub(super) fn step_at_rest(&self, state: &mut ModalState<T, K>, hub: &HubState<T>) {
        let mut y = [[T::ZERO; 2]; K];
        for k in 0..K {
            y[k] = [state.coordinate[k], state.rate[k]];
            y[k] = self.modes[k].step_at_rest(y[k], state.force[k]);
        }
        if self.terms.gravity {
            let hanging = self.hanging(&y.each(|y| y[0]), hub);
            let change = self.implied(array(|k| hanging[k] - state.force[k]), hub);
            for k in 0..K {
                y[k] = self.modes[k].correct_forced(y[k], change[k]);
                state.force[k] += change[k];
            }
        }
        state.coordinate = y.each(|y| y[0]);
        state.rate = y.each(|y| y[1]);
    }
}
