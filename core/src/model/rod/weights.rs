//! Weights of integrals over the link by the values at a few points of it.

use super::polynomials::{legendre, rule};
use super::varied::VariedLink;
use super::{LINK_STATIONS, POINTS as FINE, Rod};
use crate::math::{Each, array, dot};
use crate::scene::Varied;

/// Gauss points for the planner: six follow moves that bend by a radian.
pub(super) const SIX: usize = 6;

/// `(x, weight)` of the Gauss-Legendre rule on −1..1, upper half.
const HALF_RULE: [(f64, f64); SIX / 2] = [
    (0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_4),
];

/// Integrals from the clamp by the values at the points, m, and the modes' slopes there.
pub(super) struct Weights<const K: usize, const P: usize> {
    /// To the stations of the link.
    pub link: [[f64; P]; LINK_STATIONS],
    pub to_tip: [f64; P],
    pub to_payload: [f64; P],
    pub slope: [[f64; K]; P],
}

impl<const K: usize> Weights<K, SIX> {
    /// Of the polynomial through the points.
    pub fn uniform(rod: &Rod<K>, offset: f64) -> Self {
        let length = rod.scene().link.length;
        let at = places();
        // Of the interpolation through the points: Σ (2j + 1) w_p P_j(ξ_p) ∫₀^ξ P_j.
        let integral = |p: usize, xi: f64| -> f64 {
            let (here, there) = (legendre::<{ SIX + 1 }>(at[p].0), legendre::<{ SIX + 1 }>(xi));
            let sum: f64 = (0..SIX)
                .map(|j| match j {
                    0 => xi,
                    _ => here[j] * 0.5 * (there[j + 1] - there[j - 1]),
                })
                .sum();
            length * at[p].1 * sum
        };
        let end = |p: usize| -> f64 {
            let here = legendre::<SIX>(at[p].0);
            at[p].1 * (0..SIX).map(|j| (2 * j + 1) as f64 * here[j]).sum::<f64>()
        };
        let mut link = [[0.0; SIX]; LINK_STATIONS];
        for (row, &xi) in link.iter_mut().zip(&rule().0) {
            *row = array(|p| integral(p, xi));
        }
        let to_tip: [f64; SIX] = array(|p| integral(p, 1.0));
        Self {
            link,
            to_tip,
            to_payload: array(|p| to_tip[p] + offset * end(p)),
            slope: at.each(|(xi, _)| rod.slopes_at(xi)),
        }
    }

    /// Of the space that a constant and the rod's angles span: the rod's own eight points see in it
    /// what they see in their own.
    pub fn varied(rod: &Rod<K>, shape: &Varied, mass: f64) -> Self {
        let length = rod.scene().link.length;
        let link = VariedLink::<{ SIX - 1 }>::new(shape, mass);
        let (to_points, from_points) = link.coarse(&places().map(|(xi, _)| xi));
        let stations = rod.stations();
        let row = |fine: &[f64; FINE]| -> [f64; SIX] {
            array(|p| length * (0..FINE).map(|q| fine[q] * from_points[q][p]).sum::<f64>())
        };
        Self {
            link: stations.running.each(|fine| row(&fine)),
            to_tip: row(&stations.to_tip),
            to_payload: row(&stations.to_payload),
            slope: to_points.each(|at| array(|k| dot(&at, &rod.slope()[k]))),
        }
    }
}

/// `(ξ, weight)` of the points on 0..1.
fn places() -> [(f64, f64); SIX] {
    array(|p| {
        let (x, weight) = HALF_RULE[p % (SIX / 2)];
        (0.5 * (1.0 + if p < SIX / 2 { x } else { -x }), 0.5 * weight)
    })
}

impl<const K: usize> Weights<K, FINE> {
    /// Of the rod's own points.
    pub fn fine(rod: &Rod<K>) -> Self {
        let (length, stations) = (rod.scene().link.length, rod.stations());
        let row = |row: &[f64; FINE]| row.each(|weight| length * weight);
        Self {
            link: stations.running.each(|running| row(&running)),
            to_tip: row(&stations.to_tip),
            to_payload: row(&stations.to_payload),
            slope: array(|p| array(|k| rod.slope()[k][p])),
        }
    }
}
