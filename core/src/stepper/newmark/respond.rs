//! Torque at the hub and position of the tip, from the state.

use super::{Newmark, NewmarkState};
use crate::hub::HubState;
use crate::math::{Scalar, dot};

impl<T: Scalar, const N: usize, const W: usize, const AXES: bool> Newmark<T, N, W, AXES> {
    /// `(J_h + J_r − Fᵀb) θ̈ + Fᵀv̇`.
    #[inline(always)]
    pub(super) fn inertial(&self, state: &NewmarkState<T, N>, acceleration: T) -> T {
        self.inertia * acceleration + dot(&self.coupling, &state.restoring)
    }

    /// `u qᵀGq + 2θ̇ qᵀGq̇`, `u = θ̈ + αθ̇`.
    #[inline(always)]
    pub(super) fn spin_torque(&self, state: &NewmarkState<T, N>, forced: T, rate: T) -> T {
        let q = &state.deflection;
        let twice = self.twice_per_half * rate;
        let mut arm = *q;
        for i in 0..N {
            arm[i] = forced * q[i] + twice * state.gain[i];
        }
        dot(&self.spun(q), &arm)
    }

    /// `g cosχ S − g sinχ f_gᵀq − ½ g cosχ qᵀK_P q` on a hub that turns; on a carriage, where the
    /// weight is the same in every shape, `g cosχ S`: there `bent` and `swings` are zero.
    #[inline(never)]
    pub(super) fn weight_torque(&self, state: &NewmarkState<T, N>, hub: &HubState<T>) -> T {
        let q = &state.deflection;
        hub.cos * (self.moment - self.bent.at(q)) - self.swings * hub.sin * dot(&self.weight, q)
    }

    #[inline(always)]
    pub(super) fn tip_of(&self, state: &NewmarkState<T, N>) -> [T; 2] {
        let q = &state.deflection;
        [self.reach - self.shortening.at(q), self.tip_deflection(q)]
    }

    /// `w(L)`.
    #[inline(always)]
    fn tip_deflection(&self, q: &[T; N]) -> T {
        if Self::PRINCIPAL {
            dot(&self.tip, q)
        } else {
            // Both indices are constants: no bounds check, and `q` may stay in registers.
            if self.tip_last { q[N - 1] } else { q[N.saturating_sub(2)] }
        }
    }
}
