//! The centreline of a bent arm.

use stillbeam::model::Rod;

/// Points of the centreline, both ends included.
pub const POINTS: usize = 49;

/// Points `(x, y)` in the hub's frame, m.
pub type Points = [[f64; 2]; POINTS];

/// The arm's modes at the middles of equal parts of the link: there the angle is
/// `φ = a₁ψ₁ + a₂ψ₂`.
#[derive(Debug)]
pub struct Centreline {
    slopes: [[f64; 2]; POINTS - 1],
    step: f64,
    radius: f64,
}

impl Centreline {
    /// Takes the modes of a rod.
    pub fn of(rod: &Rod<2>) -> Self {
        let parts = (POINTS - 1) as f64;
        Self {
            slopes: core::array::from_fn(|k| rod.slopes_at((k as f64 + 0.5) / parts)),
            step: rod.scene().link.length / parts,
            radius: rod.scene().hub.radius,
        }
    }

    /// Computes the points for modal coordinates, by the midpoint rule: `x = ∫cos φ`, `y = ∫sin φ`.
    /// Each part of the link keeps its length. Error of the tip: below 1e-3 of L at 2 rad.
    pub fn bend(&self, coordinate: [f64; 2], points: &mut Points) {
        let [mut x, mut y] = [self.radius, 0.0];
        points[0] = [x, y];
        for (slope, point) in self.slopes.iter().zip(&mut points[1..]) {
            let angle = slope[0] * coordinate[0] + slope[1] * coordinate[1];
            x += self.step * libm::cos(angle);
            y += self.step * libm::sin(angle);
            *point = [x, y];
        }
    }
}
