//! Torque at the hub and position of the tip, from the state.

use super::{Modal, ModalState};
use crate::hub::HubState;
use crate::math::{Scalar, dot};

impl<T: Scalar, const K: usize> Modal<T, K> {
    /// `(J_h + J_r − bᵀb)θ̈ + bᵀ(ä + bu + αȧ + βω²ȧ)`: the drive and the drag cancel, and the force
    /// less the spring is left.
    #[inline(always)]
    pub(super) fn inertial(&self, state: &ModalState<T, K>, acceleration: T) -> T {
        let mut pull = state.coordinate;
        for k in 0..K {
            pull[k] -= state.force[k];
        }
        self.inertia * acceleration - dot(&self.support, &pull)
    }

    /// `u aᵀΓa + 2θ̇ aᵀΓȧ`.
    #[inline(always)]
    pub(super) fn spin_torque(&self, state: &ModalState<T, K>, u: T, rate: T) -> T {
        let twice = rate + rate;
        let mut arm = state.coordinate;
        for k in 0..K {
            arm[k] = u * arm[k] + twice * state.rate[k];
        }
        dot(&state.softening, &arm)
    }

    /// `g cosχ S − g sinχ fᵀa − ½ g cosχ aᵀΠa` on a hub that turns; on a carriage, where the weight
    /// is the same in every shape, `g cosχ S`: there `bent` and `lever` are zero.
    #[inline(always)]
    pub(super) fn weight_torque(&self, state: &ModalState<T, K>, hub: &HubState<T>) -> T {
        let a = &state.coordinate;
        hub.cos * (self.moment - self.bent.at(a)) - hub.sin * dot(&self.lever, a)
    }

    #[inline(always)]
    pub(super) fn tip_of(&self, state: &ModalState<T, K>) -> [T; 2] {
        let a = &state.coordinate;
        [self.reach - self.shortening.at(a), dot(&self.tip, a)]
    }
}
