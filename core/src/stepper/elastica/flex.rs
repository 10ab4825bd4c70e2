//! How the arm bends and moves, apart from any stepper.

use super::{Elastica, ElasticaState};
use crate::math::Scalar;
use crate::motion::Hub;

/// Modal coordinates of a [`Rod`](crate::beam::Rod) and their rates: what a measurement of the arm gives, and what a still
/// move is planned from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flex<T, const K: usize> {
    /// `a`, m √kg.
    pub coordinate: [T; K],
    /// `ȧ`, m √kg/s.
    pub rate: [T; K],
}

impl<T: Scalar, const K: usize> Flex<T, K> {
    /// A straight arm that does not vibrate.
    pub const STRAIGHT: Self = Self { coordinate: [T::ZERO; K], rate: [T::ZERO; K] };
}

/// Rounds of `p̃ = ȧ − nₐ(p̃)`; each adds a digit or more.
const ROUNDS: usize = 16;

impl<T: Scalar, const K: usize> Elastica<T, K> {
    /// How the arm of a state bends and moves, the hub as it was at that instant.
    pub fn flex(&self, state: &ElasticaState<T, K>, hub: &Hub<T>) -> Flex<T, K> {
        let value = self.remainder.evaluate(&state.coordinate, &state.momentum, hub);
        Flex {
            coordinate: state.coordinate,
            rate: core::array::from_fn(|k| state.momentum[k] + value.force[k][0]),
        }
    }

    /// The state of an arm that bends and moves so, e.g. as measured, on a hub that is as given.
    /// Set-up only.
    pub fn state_of(&self, flex: &Flex<T, K>, hub: &Hub<T>) -> ElasticaState<T, K> {
        let mut momentum = flex.rate;
        let mut value = self.remainder.evaluate(&flex.coordinate, &momentum, hub);
        for _ in 0..ROUNDS {
            momentum = core::array::from_fn(|k| flex.rate[k] - value.force[k][0]);
            value = self.remainder.evaluate(&flex.coordinate, &momentum, hub);
        }
        ElasticaState {
            coordinate: flex.coordinate,
            momentum,
            force: value.force,
            change: [[T::ZERO; 2]; K],
            torque: value.torque,
            inertia: value.inertia,
        }
    }
}
