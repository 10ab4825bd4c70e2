//! How far moves are expected to bend the links of an open chain.

use super::{Body, Chain, Model};
use crate::Error;
use crate::math::{Scalar, array};

/// Largest slope at the end of a link that moves may be expected to make, rad.
const MOST: f64 = 2.0;

/// Slope at the end of each link, rad, as a force at its end would make that gives the same moment
/// at the clamp, of the straight chain: `ML/2EI`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bends<const LINKS: usize> {
    /// Per unit acceleration of each joint, s².
    acceleration: [[f64; LINKS]; LINKS],
    /// Under gravity across the chain.
    sag: [f64; LINKS],
}

impl<const LINKS: usize> Bends<LINKS> {
    pub fn new<const W: usize, const C: usize, const Q: usize>(
        model: &Model<f64, LINKS, W, Q>,
    ) -> Self {
        let straight = model.pose(&[[0.0; W]; LINKS]);
        let matrix = model.mass::<C, false>(&straight).matrix;
        let still = [[0.0; W]; LINKS];
        let weight = model.inverse_dynamics(&straight, &still, &still, None);
        let slope = |body: &Body<f64, W, Q>| {
            // The first coordinate's stiffness is EI/L; a rigid link has none.
            if body.stiffness[1] > 0.0 { 0.5 / body.stiffness[1] } else { 0.0 }
        };
        Self {
            acceleration: array(|j| {
                array(|i| {
                    let (row, column) = (i.max(j) * W, i.min(j) * W);
                    let hub = if i == j { model.links[j].hub } else { 0.0 };
                    (matrix[row][column] - hub) * slope(&model.links[j])
                })
            }),
            sag: array(|j| weight[j][0] * slope(&model.links[j])),
        }
    }
}

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Chain<T, LINKS, W, C, Q>
{
    /// Refuses moves whose joints accelerate by up to `peaks`, rad/s², if the chain is open and
    /// they would bend a link further than the tick follows. The links of a loop hold each other.
    pub(super) fn admit(&self, peaks: &[f64; LINKS], closed: bool) -> Result<(), Error> {
        if closed {
            return Ok(());
        }
        for j in 0..LINKS {
            let row = self.bends.acceleration[j].iter();
            let moved: f64 = row.zip(peaks).map(|(bend, peak)| bend * peak).sum();
            let bend = moved + self.bends.sag[j];
            // NaN is not below it either.
            if !(..=MOST).contains(&bend) {
                return Err(Error::BendsTooFar { bend, max: MOST });
            }
        }
        Ok(())
    }
}
