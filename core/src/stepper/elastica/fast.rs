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

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::*;
    use crate::model::Rod;
    use crate::{Damping, Generator, Link, Move, Profile, Scene, Setpoint};

    const LINK: Link = Link { length: 0.4, mass: 0.02, bending_stiffness: 0.05 };
    const DAMPING: Damping = Damping { alpha: 0.15, beta: 0.002, joint: 0.0 };

    fn stepper(scene: &Scene, quality: Quality) -> Elastica<f32, 2> {
        let rod = Rod::new(scene).expect("a rod");
        Elastica::new(&rod, 0.01, quality, 1.5).expect("a stepper")
    }

    /// The setpoints of a move with linear acceleration, one without, and a rest.
    fn run<S: Stepper<Scalar = f32>>(stepper: S) -> Vec<Setpoint<f32>> {
        let mut arm = Generator::<S, 4>::new(stepper, 0.1).expect("a generator");
        for (profile, to) in [(Profile::Cubic, 0.9), (Profile::Quintic, -0.4)] {
            arm.push(&Move::To { profile, duration: 0.7, to }).expect("a move");
        }
        (0..200).map(|_| arm.tick()).collect()
    }

    /// Owned, borrowed or known to be fast: the same bits, on every path of a tick.
    #[test]
    fn what_the_compiler_knows_changes_no_bit() {
        let plain = Scene::new(LINK);
        let full = Scene { damping: DAMPING, gravity: 0.5, ..plain };
        for scene in [plain, full] {
            let stepper = stepper(&scene, Quality::Fast);
            let owned = run(stepper);
            let borrowed = &stepper;
            assert_eq!(run(borrowed), owned);
            assert_eq!(run(stepper.fast().expect("it is fast")), owned);
        }
    }

    #[test]
    fn what_is_fine_is_not_fast() {
        assert!(stepper(&Scene::new(LINK), Quality::Fine).fast().is_none());
    }
}
