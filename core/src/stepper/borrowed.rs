//! A stepper that stands elsewhere.

use super::{FastPaths, HubMotion, KinkMoments, Response, Stepper};
use crate::Error;
use crate::hub::{GravityDirection, HubState};
use crate::motion::Peaks;

/// The stepper itself, where it stands: a generator of it holds an address in place of the numbers,
/// which on a small stack are not to be there twice, and two arms may share one stepper.
impl<S: Stepper> Stepper for &S {
    type Scalar = S::Scalar;
    type State = S::State;

    const FAST: FastPaths = S::FAST;

    fn tick(&self) -> f64 {
        S::tick(self)
    }

    #[inline(always)]
    fn gravity(&self) -> &GravityDirection<S::Scalar> {
        S::gravity(self)
    }

    #[inline(always)]
    fn is_linear_fast(&self, rate: S::Scalar) -> bool {
        S::is_linear_fast(self, rate)
    }

    fn admit(&self, peaks: &Peaks, held: f64) -> Result<(), Error> {
        S::admit(self, peaks, held)
    }

    fn equilibrium(&self, hub: &HubState<S::Scalar>) -> S::State {
        S::equilibrium(self, hub)
    }

    #[inline(always)]
    fn step<M: HubMotion>(
        &self,
        state: &mut S::State,
        before: &HubState<S::Scalar>,
        after: &HubState<S::Scalar>,
    ) {
        S::step::<M>(self, state, before, after);
    }

    #[inline(always)]
    fn response<M: HubMotion>(
        &self,
        state: &S::State,
        hub: &HubState<S::Scalar>,
    ) -> Response<S::Scalar> {
        S::response::<M>(self, state, hub)
    }

    fn tip_angle(&self, state: &S::State) -> S::Scalar {
        S::tip_angle(self, state)
    }

    #[inline(always)]
    fn kink(&self, state: &mut S::State, moments: KinkMoments<'_, S::Scalar>) {
        S::kink(self, state, moments);
    }

    #[inline(always)]
    fn is_settled(&self, state: &S::State) -> bool {
        S::is_settled(self, state)
    }
}
