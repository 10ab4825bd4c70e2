//! The places that carry the link's mass, and how their positions follow from the angle at the
//! points.

use super::POINTS;
use super::polynomials::{RUNNING, rule};

/// Stations of the link: one more than there are points, so that the integrals of any distribution
/// of mass can be had. A uniform link leaves the last without mass.
pub(crate) const LINK_STATIONS: usize = POINTS + 1;

/// Weights of the integrals over the link, all for a link of length 1: with `f` the cosine or the
/// sine of the angle at the points, station `s` lies at `Σ running[s][p] f(p)` from the clamp.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stations {
    /// Mass of the link and of all that is mounted on it, kg.
    pub mass: f64,
    /// The stations' shares of it.
    pub weights: [f64; LINK_STATIONS],
    pub running: [[f64; POINTS]; LINK_STATIONS],
    /// From the clamp to the tip, and to the payload's centre.
    pub to_tip: [f64; POINTS],
    pub to_payload: [f64; POINTS],
}

impl Stations {
    /// Stations at the points themselves: Gauss's rule.
    pub(super) fn uniform(mass: f64) -> Self {
        let (_, gauss) = rule();
        let mut weights = [0.0; LINK_STATIONS];
        let mut running = [[0.0; POINTS]; LINK_STATIONS];
        weights[..POINTS].copy_from_slice(&gauss);
        running[..POINTS].copy_from_slice(&RUNNING);
        Self { mass, weights, running, to_tip: gauss, to_payload: gauss }
    }

    /// Puts the payload's centre `offset` beyond the tip, along the tangent there. `end` takes the
    /// values at the points to the tip.
    pub(super) fn with_payload(mut self, offset: f64, end: &[f64; POINTS]) -> Self {
        for p in 0..POINTS {
            self.to_payload[p] = self.to_tip[p] + offset * end[p];
        }
        self
    }
}
