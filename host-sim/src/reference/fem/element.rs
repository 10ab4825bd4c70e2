//! Internal forces of a plane beam element in its corotational frame.

use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;
use nalgebra::{Matrix6, Vector6};

use super::node::{Change, Node};

/// Points of the quadrature over an element.
const DEGREE: NonZeroUsize = NonZeroUsize::new(8).unwrap();

/// A Bernoulli-Euler element between two nodes, cubic in its own frame.
///
/// The frame is the chord; θ̄ᵢ are the end rotations against it and `ε = (l − l₀)/l₀ + (2θ̄₁² −
/// θ̄₁θ̄₂ + 2θ̄₂²)/30` is the mean stretch of the cubic (second order in slope), which a chord that
/// shortens by bending does not change. Energy `½ EA l₀ ε² + ½ EI/l₀ (4θ̄₁² + 4θ̄₁θ̄₂ + 4θ̄₂²)`
/// where EI is constant; else the end moments bend it as its compliance `∫ξ²/EI` has it.
/// Stiffness-proportional damping adds β times the rates of ε and θ̄ to them, so that rigid motion
/// is not damped.
///
/// Sources: Crisfield, Non-linear Finite Element Analysis of Solids and Structures, vol. 1 (1991),
/// section 7.4; Battini, Co-rotational beam elements (2002), shallow-arch strain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    /// l₀, m.
    pub length: f64,
    /// EA, N.
    pub axial: f64,
    /// End moments by the end rotations against the chord, N m: `EI/l₀ [4 2; 2 4]` where EI is
    /// constant.
    pub bending: [[f64; 2]; 2],
    /// β, s.
    pub beta: f64,
}

/// Deformation of an element, with gradients over its six displacements.
struct Deformation {
    /// Along and across the chord: the gradient of l, and l times that of the chord's angle.
    along: Vector6<f64>,
    across: Vector6<f64>,
    /// l, m.
    chord: f64,
    /// ε.
    strain: f64,
    /// θ̄, rad.
    bend: [f64; 2],
    /// `∂ε/∂θ̄`.
    slope: [f64; 2],
}

/// Returns the end moments of a beam of `length` (m) by its end rotations against the chord, N m.
/// `soft` is `1/EI` by the place ξ = 0..1. The moment is a straight line between the ends.
pub(super) fn end_stiffness(length: f64, soft: impl Fn(f64) -> f64) -> [[f64; 2]; 2] {
    let [mut near, mut mixed, mut far] = [0.0; 3];
    for &(x, weight) in GaussLegendre::new(DEGREE).iter() {
        let (xi, compliance) = (0.5 * (1.0 + x), 0.5 * weight * length);
        let compliance = compliance * soft(xi);
        near += compliance * (1.0 - xi) * (1.0 - xi);
        mixed -= compliance * xi * (1.0 - xi);
        far += compliance * xi * xi;
    }
    let determinant = near * far - mixed * mixed;
    [[far / determinant, -mixed / determinant], [-mixed / determinant, near / determinant]]
}

impl Element {
    fn deformation(&self, a: &Node, b: &Node) -> Deformation {
        let chord = (b.q - a.q).xy();
        let length = chord.norm();
        let e = chord / length;
        let relative = |node: &Node| {
            // Against the chord itself: never near the cut of atan2, however far the hub turns.
            let (sin, cos) = node.q.z.sin_cos();
            (e.x * sin - e.y * cos).atan2(e.x * cos + e.y * sin)
        };
        let [first, second] = [relative(a), relative(b)];
        // l² − l₀² from the deformation alone: the rigid part would cancel, but not its rounding.
        let stretch = (b.deformation - a.deformation).xy();
        let growth = (2.0 * chord - stretch).dot(&stretch) / (length + self.length);
        let bow = (2.0 * first * first - first * second + 2.0 * second * second) / 30.0;
        Deformation {
            along: Vector6::new(-e.x, -e.y, 0.0, e.x, e.y, 0.0),
            across: Vector6::new(e.y, -e.x, 0.0, -e.y, e.x, 0.0),
            chord: length,
            strain: growth / self.length + bow,
            bend: [first, second],
            slope: [(4.0 * first - second) / 30.0, (4.0 * second - first) / 30.0],
        }
    }

    /// Returns the internal force (N, N, N m at each end) in the global frame, and its derivative
    /// along `change`.
    pub fn force(&self, a: &Node, b: &Node, change: &Change) -> (Vector6<f64>, Matrix6<f64>) {
        let d = self.deformation(a, b);
        let (l, l0, s) = (d.chord, self.length, d.slope);
        let v = Vector6::new(a.v.x, a.v.y, a.v.z, b.v.x, b.v.y, b.v.z);
        let (r, z) = (d.along, d.across);

        // Gradients of θ̄₁, θ̄₂ and ε.
        let turn = z / l;
        let g = [Vector6::ith(2, 1.0) - turn, Vector6::ith(5, 1.0) - turn];
        let strain = r / l0 + g[0] * s[0] + g[1] * s[1];
        // Gradients of ∂ε/∂θ̄.
        let curl = [(4.0 * g[0] - g[1]) / 30.0, (4.0 * g[1] - g[0]) / 30.0];

        // Rates, and their derivatives along the change.
        let (l_rate, turn_rate) = (r.dot(&v), turn.dot(&v));
        let rate = [v[2] - turn_rate, v[5] - turn_rate];
        let strain_rate = l_rate / l0 + s[0] * rate[0] + s[1] * rate[1];
        let d_l_rate = change.rate * r + change.displacement * turn_rate * z;
        let d_turn_rate =
            change.rate * turn - change.displacement * (l_rate * turn + turn_rate * r) / l;
        let d_rate = [0, 1].map(|i| {
            let own = if i == 0 { 2 } else { 5 };
            Vector6::ith(own, change.rate) - d_turn_rate
        });
        let d_strain_rate = d_l_rate / l0
            + d_rate[0] * s[0]
            + d_rate[1] * s[1]
            + change.displacement * (curl[0] * rate[0] + curl[1] * rate[1]);

        // Axial force and end moments.
        let tension = self.axial * (d.strain + self.beta * strain_rate);
        let d_tension = self.axial * (change.displacement * strain + self.beta * d_strain_rate);
        let k = self.bending;
        let bend = [0, 1].map(|i| d.bend[i] + self.beta * rate[i]);
        let d_bend = [0, 1].map(|i| change.displacement * g[i] + self.beta * d_rate[i]);
        let moment = [0, 1].map(|i| k[i][0] * bend[0] + k[i][1] * bend[1] + tension * l0 * s[i]);
        let d_moment = [0, 1].map(|i| {
            k[i][0] * d_bend[0]
                + k[i][1] * d_bend[1]
                + l0 * s[i] * d_tension
                + change.displacement * tension * l0 * curl[i]
        });

        let force = tension * r + moment[0] * g[0] + moment[1] * g[1];
        let sum = (moment[0] + moment[1]) / (l * l);
        let geometric =
            z * z.transpose() * (tension / l) + (r * z.transpose() + z * r.transpose()) * sum;
        let tangent = r * d_tension.transpose()
            + g[0] * d_moment[0].transpose()
            + g[1] * d_moment[1].transpose()
            + geometric * change.displacement;
        (force, tangent)
    }
}
