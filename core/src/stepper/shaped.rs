//! A motion behind an input shaper, tick by tick.

use super::{AnyMotion, KinkMoments, Stepper};
use crate::math::Scalar;
use crate::motion::Shaped;

impl<T: Scalar> Shaped<'_, T> {
    /// Advances an arm from tick `k` to tick `k + 1`, with what jumps at its ends and within.
    pub fn advance<S: Stepper<Scalar = T>>(&self, stepper: &S, state: &mut S::State, k: u32) {
        let kink = self.kink(k);
        if !kink.is_none() {
            stepper.kink(state, KinkMoments::All(&kink));
        }
        let [before, after] =
            [self.hub(k), self.arrival(k + 1)].map(|hub| stepper.gravity().aimed(&hub));
        stepper.step::<AnyMotion>(state, &before, &after);
    }
}
