//! Shape and motion of the arm, independent of any stepper.

use super::{Elastica, ElasticaState};
use crate::hub::HubState;
use crate::math::{Scalar, array};

/// Modal coordinates of a [`Rod`](crate::model::Rod) and their rates: what a measurement of the arm
/// gives, and what a still move is planned from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmState<T, const K: usize> {
    /// `a`, m √kg.
    pub coordinate: [T; K],
    /// `ȧ`, m √kg/s.
    pub rate: [T; K],
}

impl<T: Scalar, const K: usize> ArmState<T, K> {
    /// A straight arm that does not vibrate.
    pub const STRAIGHT: Self = Self { coordinate: [T::ZERO; K], rate: [T::ZERO; K] };
}

/// Rounds of `p̃ = ȧ − u(p̃)`; each adds a digit or more.
const ROUNDS: usize = 16;

impl<T: Scalar, const K: usize> Elastica<T, K> {
    /// Returns shape and motion of the arm in `state`. `hub` is the hub at the same instant.
    pub fn arm_state(&self, state: &ElasticaState<T, K>, hub: &HubState<T>) -> ArmState<T, K> {
        let value = self.value_at(&state.y, hub);
        ArmState {
            coordinate: array(|k| state.y[k][0] / self.nonlinear.omega(k)),
            rate: array(|k| state.y[k][1] + value.offset[k][1]),
        }
    }

    /// Returns the state of an arm with this shape and motion, e.g. as measured, on the given hub.
    /// Set-up only.
    pub fn state_of(&self, flex: &ArmState<T, K>, hub: &HubState<T>) -> ElasticaState<T, K> {
        let mut y: [[T; 2]; K] =
            array(|k| [self.nonlinear.omega(k) * flex.coordinate[k], flex.rate[k]]);
        let mut value = self.value_at(&y, hub);
        for _ in 0..ROUNDS {
            for k in 0..K {
                y[k][1] = flex.rate[k] - value.offset[k][1];
            }
            value = self.value_at(&y, hub);
        }
        ElasticaState::at(y, value)
    }
}
