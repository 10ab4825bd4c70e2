//! The chain's constants: shapes of the links, masses at their stations, numbers of coordinates.

use stillbeam::mechanism::Mechanism;

use crate::mechanism::is_passive;
use crate::reference::rod::legendre::{Rule, integrals};

/// Gauss points of a link: with 14 of them the integrals are exact to the ninth digit at angles of
/// several rad.
const POINTS: usize = 14;

/// A mechanism in coordinates: per joint its relative angle, then the curvatures of its link.
pub(super) struct Chain {
    pub mechanism: Mechanism,
    pub links: Vec<Strip>,
    /// Number of all coordinates.
    pub size: usize,
    /// Abscissae and weights of the quadrature along every link, on 0..1.
    pub rule: Rule,
    /// Row p: weights of the integral from 0 to point p.
    pub running: Vec<Vec<f64>>,
    /// Row p: `ψₖ` at point p, `ψₖ(ξ) = ∫₀^ξ P̃ₖ₋₁`.
    pub shapes: Vec<Vec<f64>>,
}

/// Coordinates of one link.
pub(super) struct Strip {
    /// Index of the joint's angle; the curvatures follow.
    pub angle: usize,
    /// Number of curvatures, 0 for a rigid link.
    pub order: usize,
    /// `EI/L`, N m; 0 for a rigid link.
    pub stiffness: f64,
}

impl Chain {
    /// Creates the chain with that many curvatures a flexible link.
    pub fn new(mechanism: &Mechanism, order: usize) -> Self {
        let mut size = 0;
        let mut links = Vec::new();
        for link in &mechanism.links {
            let order = if link.bends() { order } else { 0 };
            let stiffness = link.bending_stiffness() / link.length;
            links.push(Strip { angle: size, order, stiffness });
            size += 1 + order;
        }
        let rule = Rule::new(POINTS);
        let running = rule.points.iter().map(|&x| rule.running(x)).collect();
        let shapes = rule.points.iter().map(|&x| integrals(x, order)).collect();
        Self { mechanism: mechanism.clone(), links, size, rule, running, shapes }
    }

    /// Returns the indices of the coordinates that no drive holds.
    pub fn free(&self, closed: bool) -> Vec<usize> {
        let mut free = Vec::new();
        for (joint, link) in self.links.iter().enumerate() {
            if is_passive(&self.mechanism, joint, closed) {
                free.push(link.angle);
            }
            free.extend(link.curvatures());
        }
        free
    }

    /// Returns the joints that a drive holds.
    pub fn driven(&self, closed: bool) -> Vec<usize> {
        (0..self.links.len()).filter(|&joint| !is_passive(&self.mechanism, joint, closed)).collect()
    }

    /// Returns the stiffness of a curvature, `EI/L · 1/(2k − 1)`, N m: Legendre polynomials are
    /// orthogonal.
    pub fn stiffnesses(&self) -> impl Iterator<Item = (usize, f64)> {
        self.links.iter().flat_map(|link| {
            let of = |k: usize| (link.angle + 1 + k, link.stiffness / (2 * k + 1) as f64);
            (0..link.order).map(of)
        })
    }
}

impl Strip {
    /// Returns the indices of the link's curvatures.
    pub fn curvatures(&self) -> std::ops::Range<usize> {
        self.angle + 1..self.angle + 1 + self.order
    }
}
