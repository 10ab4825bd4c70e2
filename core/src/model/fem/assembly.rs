//! The chain of elements, assembled over the free nodes.

use super::element::{self, Matrix};
use crate::math::{Band, Scalar, dot};
use crate::scene::Scene;

/// Band width of a chain of two-node elements with two degrees of freedom a node.
pub(crate) const CHAIN: usize = 4;

/// Matrices and vectors over the `D = 2 × elements` free degrees of freedom `w₁ φ₁ … w_E φ_E`.
/// The clamped node is left out; the hub is rigid and needs no element: its radius only enters
/// `spin`, `coupling` and the axial force.
pub(crate) struct Assembly<T, const D: usize> {
    /// `M`, payload included.
    pub mass: Band<T, D, CHAIN>,
    /// `K`.
    pub stiffness: Band<T, D, CHAIN>,
    /// `G = K_g − M_t`, the stiffness per θ̇²; zero on a carriage.
    pub spin: Band<T, D, CHAIN>,
    /// `K_P = ∫ P_g N'N'ᵀ dx`, the stiffness per −g sinχ.
    pub tension: Band<T, D, CHAIN>,
    /// `S = ∫ N'N'ᵀ dx`: the tip comes ½ qᵀSq closer to the hub.
    pub shortening: Band<T, D, CHAIN>,
    /// `F`: the rows of `M` times the rigid rotation `(r + x, 1)`, on a carriage times the rigid
    /// translation `(1, 0)`.
    pub coupling: [T; D],
    /// `f_g`: the rows of `M_t` times the rigid translation `(1, 0)`.
    pub weight: [T; D],
}

/// Distribution of an element's mass over its nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MassMatrix {
    Consistent,
    Lumped,
}

impl<T: Scalar, const D: usize> Assembly<T, D> {
    pub(crate) fn new(scene: &Scene<T>, mass: MassMatrix) -> Self {
        let elements = D / 2;
        let (length, radius) = (scene.link.length, scene.hub.radius);
        let rho_a = scene.mass_per_length();
        let l = length / T::from_u32(elements as u32);
        let mut chain = Self {
            mass: Band::ZERO,
            stiffness: Band::ZERO,
            spin: Band::ZERO,
            tension: Band::ZERO,
            shortening: Band::ZERO,
            coupling: [T::ZERO; D],
            weight: [T::ZERO; D],
        };
        let m_e = match mass {
            MassMatrix::Consistent => element::consistent_mass(rho_a, l),
            MassMatrix::Lumped => element::lumped_mass(rho_a, l),
        };
        let tip_force = scene.payload.mass * scene.reach();
        for e in 0..elements {
            let x1 = T::from_u32(e as u32) * l;
            // Axial force per θ̇², and per g along the link, in ξ = (x − x₁)/ℓ.
            let outboard = length - x1;
            let centrifugal = [
                rho_a * (radius * outboard + T::HALF * outboard * (length + x1)) + tip_force,
                -rho_a * l * (radius + x1),
                -T::HALF * rho_a * l * l,
            ];
            let hanging = [rho_a * outboard + scene.payload.mass, -rho_a * l, T::ZERO];
            scatter(&mut chain.stiffness, e, &element::stiffness(scene.link.bending_stiffness, l));
            scatter(&mut chain.mass, e, &m_e);
            scatter(&mut chain.spin, e, &element::axial(l, centrifugal));
            scatter(&mut chain.spin, e, &m_e.map(|row| row.map(|value| -value)));
            scatter(&mut chain.tension, e, &element::axial(l, hanging));
            scatter(&mut chain.shortening, e, &element::axial(l, [T::ONE, T::ZERO, T::ZERO]));
            let x = radius + x1;
            scatter_product(&mut chain.coupling, e, &m_e, [x, T::ONE, x + l, T::ONE]);
            scatter_product(&mut chain.weight, e, &m_e, [T::ONE, T::ZERO, T::ONE, T::ZERO]);
        }
        chain.add_payload(scene);
        if scene.mount.is_linear() {
            chain.put_on_carriage();
        }
        chain
    }

    /// A carriage moves the link across itself and does not turn it.
    fn put_on_carriage(&mut self) {
        self.coupling = self.weight;
        self.spin = Band::ZERO;
    }

    /// The payload's mass and rotary inertia at the tip. A rotation of the tip has no centrifugal
    /// softening, so that `J_p` stays out of `spin`.
    fn add_payload(&mut self, scene: &Scene<T>) {
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
fn scatter<T: Scalar, const D: usize>(sum: &mut Band<T, D, CHAIN>, e: usize, matrix: &Matrix<T>) {
    for i in 0..4 {
        for j in 0..=i {
            if let (Some(row), Some(column)) = (free(e, i), free(e, j)) {
                sum.add(row, column, matrix[i][j]);
            }
        }
    }
}

/// Adds `matrix × rigid` of element `e`, all four columns, to the free rows.
fn scatter_product<T: Scalar, const D: usize>(
    sum: &mut [T; D],
    e: usize,
    matrix: &Matrix<T>,
    rigid: [T; 4],
) {
    for i in 0..4 {
        if let Some(row) = free(e, i) {
            sum[row] += dot(&matrix[i], &rigid);
        }
    }
}

/// Global number of the element's degree of freedom `i`; none at the clamp.
fn free(e: usize, i: usize) -> Option<usize> {
    (2 * e + i).checked_sub(2)
}
