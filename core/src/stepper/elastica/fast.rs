//! A stepper that the compiler knows to be fast.

use super::{Elastica, ElasticaState, Quality};
use crate::Error;
use crate::hub::{GravityDirection, HubState};
use crate::math::Scalar;
use crate::motion::Peaks;
use crate::stepper::{FastPaths, HubMotion, KinkMoments, Response, Stepper};

/// An [`Elastica`] of [`Quality::Fast`], which stands elsewhere: see [`Elastica::fast`].
#[derive(Clone, Copy, Debug)]
pub struct ElasticaFast<'a, T, const K: usize>(&'a Elastica<T, K>);

impl<T: Scalar, const K: usize> Elastica<T, K> {
    /// Returns the stepper as one whose quality the compiler knows; `None` unless it is
    /// [`Quality::Fast`]. It gives the same bits, and links the steps of no other quality: in two
    /// modes 1.5 to 3 KB of flash less.
    pub fn fast(&self) -> Option<ElasticaFast<'_, T, K>> {
        (self.quality == Quality::Fast).then_some(ElasticaFast(self))
    }
}

impl<T: Scalar, const K: usize> Stepper for ElasticaFast<'_, T, K> {
    type Scalar = T;
    type State = ElasticaState<T, K>;

    const FAST: FastPaths = <Elastica<T, K> as Stepper>::FAST;

    #[inline(always)]
    fn step<M: HubMotion>(
        &self,
        state: &mut ElasticaState<T, K>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        self.0.step_of::<M>(Quality::Fast, state, before, after);
    }

    fn tick(&self) -> f64 {
        self.0.tick()
    }

    #[inline(always)]
    fn gravity(&self) -> &GravityDirection<T> {
        self.0.gravity()
    }

    #[inline(always)]
    fn is_linear_fast(&self, rate: T) -> bool {
        self.0.is_linear_fast(rate)
    }

    fn admit(&self, peaks: &Peaks, held: f64) -> Result<(), Error> {
        self.0.admit(peaks, held)
    }

    fn equilibrium(&self, hub: &HubState<T>) -> ElasticaState<T, K> {
        self.0.equilibrium(hub)
    }

    #[inline(always)]
    fn response<M: HubMotion>(
        &self,
        state: &ElasticaState<T, K>,
        hub: &HubState<T>,
    ) -> Response<T> {
        self.0.response::<M>(state, hub)
    }

    fn tip_angle(&self, state: &ElasticaState<T, K>) -> T {
        self.0.tip_angle(state)
    }

    #[inline(always)]
    fn kink(&self, state: &mut ElasticaState<T, K>, moments: KinkMoments<'_, T>) {
        self.0.kink(state, moments);
    }

    #[inline(always)]
    fn is_settled(&self, state: &ElasticaState<T, K>) -> bool {
        self.0.is_settled(state)
    }
}
