//! Modes of vibration of an open chain about a place where it rests.

use super::equilibrium::Rest;
use super::{Chain, Model};
use crate::Error;
use crate::math::{Band, Each, Scalar, generalized_eigen, sqrt};

/// The lowest modes, one a link that bends, for the joints at rest.
#[derive(Clone, Copy, Debug)]
pub struct ChainModes<const LINKS: usize, const C: usize> {
    /// Angular frequencies, rad/s, ascending; infinite where a chain has fewer links that bend.
    pub frequency: [f64; LINKS],
    /// `φᵀM` of each mode, `φᵀMφ = 1`: the mode's coordinate is its product with those of the
    /// chain.
    pub(super) onto: [[f64; C]; LINKS],
    /// Displacement of the tip per unit of each mode, m.
    pub(super) tip: [f64; LINKS],
}

impl<const LINKS: usize, const C: usize> ChainModes<LINKS, C> {
    /// First period, s.
    pub fn period(&self) -> f64 {
        core::f64::consts::TAU / self.frequency[0]
    }
}

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Chain<T, LINKS, W, C, Q>
{
    /// Modes about the place where the chain rests with its joints at `angles`, rad. Set-up only.
    ///
    /// # Errors
    /// Those of [`Self::at_rest`]; a chain with a passive joint, which does not hold its place.
    pub fn modes(&self, angles: &[f64; LINKS]) -> Result<ChainModes<LINKS, C>, Error> {
        for j in 0..LINKS {
            if self.open[j * W] || self.pin.is_some() {
                return Err(Error::PassiveJoint { parameter: "joints", joint: j + 1 });
            }
        }
        let state = self.at_rest(angles)?;
        let mut rest = Rest { q: state.shape.each(|row| row.each(T::to_f64)), force: [0.0; 2] };
        for j in 0..LINKS {
            rest.q[j][0] = angles[j];
        }
        Ok(modes_of(&self.model.precise(), &rest, &self.open))
    }
}

fn modes_of<const LINKS: usize, const W: usize, const C: usize, const Q: usize>(
    model: &Model<f64, LINKS, W, Q>,
    rest: &Rest<LINKS, W>,
    free: &[bool; C],
) -> ChainModes<LINKS, C> {
    let pose = model.pose(&model.in_turns(&rest.q));
    let matrix = model.mass::<C, false>(&pose).matrix;
    let tangent = model.tangent(rest, free);
    let moves = model.tip_moves(&pose);
    let (mut mass, mut stiffness) = (Band::<f64, C, C>::ZERO, Band::<f64, C, C>::ZERO);
    for i in 0..C {
        // A coordinate that is held has stiffness and no mass: its frequency is infinite.
        if !free[i] {
            stiffness.add(i, i, 1.0);
            continue;
        }
        for p in (0..=i).filter(|&p| free[p]) {
            mass.add(i, p, matrix[i][p]);
            stiffness.add(i, p, tangent[i][p]);
        }
    }
    let (squares, vectors) = generalized_eigen(&stiffness, &mass);
    let mut modes = ChainModes {
        frequency: [f64::INFINITY; LINKS],
        onto: [[0.0; C]; LINKS],
        tip: [0.0; LINKS],
    };
    let bends = (0..LINKS).filter(|link| free[link * W + 1]).count();
    for mode in 0..bends.min(LINKS) {
        let omega = 1.0 / sqrt(squares[mode]);
        let shape = vectors[mode].each(|entry| entry * omega);
        modes.frequency[mode] = omega;
        modes.onto[mode] = mass.times(&shape);
        let tip = |axis: usize| (0..C).map(|i| moves[i / W][i % W][axis] * shape[i]).sum::<f64>();
        modes.tip[mode] = sqrt(tip(0) * tip(0) + tip(1) * tip(1));
    }
    modes
}
