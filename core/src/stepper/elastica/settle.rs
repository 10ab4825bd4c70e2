//! Whether an arm that gravity bends stays where it rests.

use super::{Elastica, ElasticaState};
use crate::hub::HubState;
use crate::math::Scalar;
use crate::stepper::Stepper;

/// Sine and cosine of the hub angles that are asked for.
const ANGLES: [(f64, f64); 6] =
    [(0.0, 1.0), (0.0, -1.0), (1.0, 0.0), (-1.0, 0.0), (0.7, 0.7), (-0.7, -0.7)];

/// Ticks that an arm is left alone, and by how much what it was moved by may grow meanwhile: an exact
/// vibration about a bent rest grows to twice of it at most.
const TICKS: u32 = 200;
const MOST: f64 = 10.0;

/// What it is moved by, of the bend that it is set up for.
const SHARE: f64 = 1e-3;

impl<T: Scalar, const K: usize> Elastica<T, K> {
    /// Whether the arm stays where its weight bends it to: the predictor feeds one that bends far while
    /// a tick hardly resolves its first mode. Set-up only.
    pub(super) fn rests(&self) -> bool {
        !self.is_directed() || ANGLES.iter().all(|&angle| self.stays(angle))
    }

    fn stays(&self, (sin, cos): (f64, f64)) -> bool {
        let hub = HubState { sin: T::from_f64(sin), cos: T::from_f64(cos), ..HubState::ZERO };
        let rest = self.equilibrium(&hub);
        let moved = self.calm.offset(SHARE * self.bend);
        let mut state = rest;
        state.y[0][0] += moved;
        let most = T::from_f64(MOST * MOST) * moved * moved;
        (0..TICKS).all(|_| {
            self.swing(&mut state, &hub);
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
