//! Energy of a chain, and what damping takes of it.

use super::mass::Mass;
use super::{Chain, ChainState};
use crate::math::{Scalar, array};

/// Energy at one instant, J, and its loss.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energy<T> {
    /// `½q̇ᵀMq̇`.
    pub kinetic: T,
    /// Strain energy of the links, `½aᵀKa`.
    pub strain: T,
    /// In the field of gravity, zero at the height of the first joint.
    pub height: T,
    /// Power that damping takes, `αq̇ᵀMq̇ + βȧᵀKȧ`, the hubs left out of `M`, W.
    pub loss: T,
}

impl<T: Scalar> Energy<T> {
    /// Kinetic energy, strain and height.
    pub fn total(&self) -> T {
        self.kinetic + self.strain + self.height
    }
}

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Chain<T, LINKS, W, C, Q>
{
    /// Energy of a state. With the motors' power `Στθ̇` its sum changes by that less the loss. Not
    /// for the tick.
    pub fn energy(&self, state: &ChainState<T, LINKS, W>) -> Energy<T> {
        let pose = self.pose_of(state);
        let mut mass = Mass::NONE;
        let whole = self.model.write_mass::<C, true>(&pose, &mut mass);
        let rates = state.rate.as_flattened();
        let mut twice = T::ZERO;
        for i in 0..C {
            for p in 0..i {
                twice += T::TWO * rates[i] * mass.matrix[i][p] * rates[p];
            }
            twice += rates[i] * mass.matrix[i][i] * rates[i];
        }
        let (mut strain, mut bending) = (T::ZERO, T::ZERO);
        let (mut hubs, mut omega) = (T::ZERO, T::ZERO);
        for j in 0..LINKS {
            omega += state.rate[j][0];
            hubs += self.model.links[j].hub * (omega * omega);
            omega += state.rate[j][1];
            for k in 1..W {
                let stiffness = self.model.links[j].stiffness[k];
                strain += T::HALF * stiffness * state.shape[j][k] * state.shape[j][k];
                bending += stiffness * state.rate[j][k] * state.rate[j][k];
            }
        }
        Energy {
            kinetic: T::HALF * twice,
            strain,
            height: self.model.gravity * whole[1],
            loss: self.model.alpha * (twice - hubs) + self.model.beta * bending,
        }
    }

    /// Inertia that each joint turns, kg m².
    pub(super) fn inertias(&self, state: &ChainState<T, LINKS, W>) -> [f64; LINKS] {
        let mass = self.model.mass::<C, false>(&self.pose_of(state));
        array(|j| mass.matrix[j * W][j * W].to_f64())
    }
}
