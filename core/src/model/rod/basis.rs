//! The angles that the modes of the rod are made of.

use super::POINTS;
use super::polynomials::{AT_POINTS, END, rule, slopes};
use super::stations::Stations;
use super::varied::VariedLink;
use crate::math::{Band, array};
use crate::scene::{LinkShape, Scene};

/// `N` angles along the link: those that a bending moment `EI/L P_j(2ξ − 1)` makes, `P_j`
/// Legendre's polynomials. A joint that gives adds the angle `φ₀ = M(0)/k` of the root to each, so
/// that it has no unknown of its own: the root has no inertia.
pub(super) struct Basis<const N: usize> {
    pub at_points: [[f64; N]; POINTS],
    pub root: [f64; N],
    pub tip: [f64; N],
    /// Strain energy of link and joint, `½aᵀBa` times `EI/L`.
    pub bending: Band<f64, N, N>,
    pub stations: Stations,
}

impl<const N: usize> Basis<N> {
    pub fn new<S: LinkShape>(scene: &Scene<f64, S>) -> Self {
        let link = &scene.link;
        let offset = scene.payload.offset / link.length;
        let mut basis = match scene.shape.varied() {
            None => Self::uniform(link.mass, offset),
            Some(shape) => VariedLink::<N>::new(shape, link.mass).basis(offset),
        };
        let give = link.bending_stiffness / link.length * scene.hub.compliance();
        // P_j(−1) is ±1.
        basis.root = array(|j| if j % 2 == 0 { give } else { -give });
        for i in 0..N {
            basis.tip[i] += basis.root[i];
            for row in &mut basis.at_points {
                row[i] += basis.root[i];
            }
            for j in 0..=i {
                let sign = if (i + j) % 2 == 0 { 1.0 } else { -1.0 };
                basis.bending.add(i, j, give * sign);
            }
        }
        basis
    }

    /// Of a uniform link: integrals of Legendre polynomials, so that bending is diagonal.
    fn uniform(mass: f64, offset: f64) -> Self {
        let (points, _) = rule();
        let mut bending = Band::ZERO;
        for j in 0..N {
            bending.add(j, j, 1.0 / (2 * j + 1) as f64);
        }
        Self {
            at_points: array(|p| slopes(points[p], &AT_POINTS[p])),
            root: [0.0; N],
            // Every Legendre polynomial is 1 there.
            tip: slopes(1.0, &[1.0; POINTS + 1]),
            bending,
            stations: Stations::uniform(mass).with_payload(offset, &END),
        }
    }
}
