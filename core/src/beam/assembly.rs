//! The chain of elements, assembled over the free nodes.

use super::element::{self, Matrix};
use crate::math::Band;
use crate::scene::Scene;

/// Band width of a chain of two-node elements with two degrees of freedom a node.
pub(crate) const CHAIN: usize = 4;

/// Matrices and vectors over the `D = 2 × elements` free degrees of freedom `w₁ φ₁ … w_E φ_E`.
/// The clamped node is left out; the hub is rigid and needs no element: its radius only enters
/// `spin`, `coupling` and the axial force.
pub(crate) struct Assembly<const D: usize> {
    /// `M`, payload included.
    pub mass: Band<f64, D, CHAIN>,
    /// `K`.
    pub stiffness: Band<f64, D, CHAIN>,
    /// `G = K_g − M_t`, the stiffness per θ̇².
    pub spin: Band<f64, D, CHAIN>,
    /// `K_P = ∫ P_g N'N'ᵀ dx`, the stiffness per −g sinθ.
    pub tension: Band<f64, D, CHAIN>,
    /// `S = ∫ N'N'ᵀ dx`: the tip comes ½ qᵀSq closer to the hub.
    pub shortening: Band<f64, D, CHAIN>,
    /// `F`: the rows of `M` times the rigid rotation `(r + x, 1)`.
    pub coupling: [f64; D],
    /// `f_g`: the rows of `M_t` times the rigid translation `(1, 0)`.
    pub weight: [f64; D],
}

/// How an element's mass is spread over its nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MassMatrix {
    Consistent,
    Lumped,
}

impl<const D: usize> Assembly<D> {
    pub(crate) fn new(scene: &Scene, mass: MassMatrix) -> Self {
        let elements = D / 2;
        let (length, radius) = (scene.link.length, scene.hub.radius);
        let rho_a = scene.mass_per_length();
        let l = length / elements as f64;
        let mut chain = Self {
            mass: Band::ZERO,
            stiffness: Band::ZERO,
            spin: Band::ZERO,
            tension: Band::ZERO,
            shortening: Band::ZERO,
            coupling: [0.0; D],
            weight: [0.0; D],
        };
        let m_e = match mass {
            MassMatrix::Consistent => element::consistent_mass(rho_a, l),
            MassMatrix::Lumped => element::lumped_mass(rho_a, l),
        };
        let tip_force = scene.payload.mass * scene.reach();
        for e in 0..elements {
            let x1 = e as f64 * l;
            // Axial force per θ̇², and per g along the link, in ξ = (x − x₁)/ℓ.
            let outboard = length - x1;
            let centrifugal = [
                rho_a * (radius * outboard + 0.5 * outboard * (length + x1)) + tip_force,
                -rho_a * l * (radius + x1),
                -0.5 * rho_a * l * l,
            ];
            let hanging = [rho_a * outboard + scene.payload.mass, -rho_a * l, 0.0];
            scatter(&mut chain.stiffness, e, &element::stiffness(scene.link.bending_stiffness, l));
            scatter(&mut chain.mass, e, &m_e);
            scatter(&mut chain.spin, e, &element::axial(l, centrifugal));
            scatter(&mut chain.spin, e, &m_e.map(|row| row.map(|value| -value)));
            scatter(&mut chain.tension, e, &element::axial(l, hanging));
            scatter(&mut chain.shortening, e, &element::axial(l, [1.0, 0.0, 0.0]));
            let x = radius + x1;
            scatter_product(&mut chain.coupling, e, &m_e, [x, 1.0, x + l, 1.0]);
            scatter_product(&mut chain.weight, e, &m_e, [1.0, 0.0, 1.0, 0.0]);
        }
        chain.add_payload(scene);
        chain
    }

    /// The payload's mass and rotary inertia at the tip. A rotation of the tip has no centrifugal
    /// softening, so that `J_p` stays out of `spin`.
    fn add_payload(&mut self, scene: &Scene) {
        let (w, phi) = (D - 2, D - 1);
        let payload = scene.payload;
        self.mass.add(w, w, payload.mass);
        self.mass.add(phi, phi, payload.inertia);
        self.spin.add(w, w, -payload.mass);
        self.coupling[w] += payload.mass * scene.reach();
        self.coupling[phi] += payload.inertia;
        self.weight[w] += payload.mass;
    }
}

/// Adds element `e` to the assembled matrix, leaving out the clamped node.
#[inline(never)]
fn scatter<const D: usize>(sum: &mut Band<f64, D, CHAIN>, e: usize, matrix: &Matrix) {
    for i in 0..4 {
        for j in 0..=i {
            if let (Some(row), Some(column)) = (free(e, i), free(e, j)) {
                sum.add(row, column, matrix[i][j]);
            }
        }
    }
}

/// Adds `matrix × rigid` of element `e`, all four columns, to the free rows.
fn scatter_product<const D: usize>(sum: &mut [f64; D], e: usize, matrix: &Matrix, rigid: [f64; 4]) {
    for i in 0..4 {
        if let Some(row) = free(e, i) {
            sum[row] += crate::math::dot(&matrix[i], &rigid);
        }
    }
}

/// Global number of the element's degree of freedom `i`; none at the clamp.
fn free(e: usize, i: usize) -> Option<usize> {
    (2 * e + i).checked_sub(2)
}
