//! Checks that an arm that gravity bends stays where it rests.

use super::{Elastica, ElasticaState};
use crate::hub::HubState;
use crate::math::Scalar;
use crate::stepper::{AtRest, Stepper};

/// Sine and cosine of the angles χ that are checked for a hub that turns.
const ANGLES: [(f64, f64); 6] =
    [(0.0, 1.0), (0.0, -1.0), (1.0, 0.0), (-1.0, 0.0), (0.7, 0.7), (-0.7, -0.7)];

/// Ticks that an arm is left alone.
const TICKS: u32 = 200;

/// Largest factor by which its displacement may grow meanwhile. An exact vibration about a bent
/// rest grows to twice its amplitude at most.
const LARGEST_GROWTH: f64 = 10.0;

/// First displacement, as a fraction of the tip angle that the arm is set up for.
const DISPLACEMENT: f64 = 1e-3;

impl<T: Scalar, const K: usize> Elastica<T, K> {
    /// True if the arm stays where its weight bends it to. The predictor feeds energy to an arm
    /// that bends far while a tick hardly resolves its first mode. Set-up only.
    pub(super) fn is_stable_at_rest(&self) -> bool {
        if !self.nonlinear.feels_gravity() {
            return true;
        }
        if self.gravity.follows_hub() {
            return ANGLES.iter().all(|&angle| self.is_stable_at(angle));
        }
        let mut hub = HubState::<T>::ZERO;
        self.gravity.aim(&mut hub);
        self.is_stable_at((hub.sin.to_f64(), hub.cos.to_f64()))
    }

    fn is_stable_at(&self, (sin, cos): (f64, f64)) -> bool {
        let hub = HubState { sin: T::from_f64(sin), cos: T::from_f64(cos), ..HubState::ZERO };
        let rest = self.equilibrium(&hub);
        let moved = self.numerical_damping.offset(DISPLACEMENT * self.bend);
        let mut state = rest;
        state.y[0][0] += moved;
        let most = T::from_f64(LARGEST_GROWTH * LARGEST_GROWTH) * moved * moved;
        (0..TICKS).all(|_| {
            self.step::<AtRest>(&mut state, &hub, &hub);
            distance(&state, &rest) < most
        })
    }
}

/// Square of the distance of two states.
fn distance<T: Scalar, const K: usize>(a: &ElasticaState<T, K>, b: &ElasticaState<T, K>) -> T {
    let mut sum = T::ZERO;
    for k in 0..K {
        for r in 0..2 {
            let off = a.y[k][r] - b.y[k][r];
            sum += off * off;
        }
    }
    sum
}
