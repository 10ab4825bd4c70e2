//! The chain of elements, assembled over the free nodes.

use super::element::{self, Matrix};
use super::varied::Beam;
use crate::math::{Band, Each, Scalar, array, dot};
use crate::scene::{LinkShape, Scene};

/// Band width of a chain of two-node elements with two degrees of freedom a node.
pub(crate) const CHAIN: usize = 4;

/// Matrices and vectors over the `D = 2 × elements` free degrees of freedom `w₁ φ₁ … w_E φ_E`.
/// The clamped node is left out; the hub is rigid and needs no element: its radius only enters
/// `spin`, `coupling` and the axial force. Where the joint gives, the root's angle is eliminated:
/// it has no inertia, and follows the first element.
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
    /// The root's angle, `φ₀ = rootᵀq`: zero where the link is clamped without give.
    pub root: [T; D],
}

/// Distribution of an element's mass over its nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MassMatrix {
    Consistent,
    Lumped,
}

/// Matrices of one element, degrees of freedom `w₁ φ₁ w₂ φ₂`.
struct Element<T> {
    stiffness: Matrix<T>,
    mass: Matrix<T>,
    /// `∫ P N'N'ᵀ dx` of the axial force per θ̇², per g along the link, and of a unit force.
    centrifugal: Matrix<T>,
    hanging: Matrix<T>,
    shortening: Matrix<T>,
}

impl<T: Scalar, const D: usize> Assembly<T, D> {
    pub(crate) fn new<S: LinkShape>(scene: &Scene<T, S>, mass: MassMatrix) -> Self {
        let elements = D / 2;
        let l = scene.link.length / T::from_u32(elements as u32);
        let mut chain = Self {
            mass: Band::ZERO,
            stiffness: Band::ZERO,
            spin: Band::ZERO,
            tension: Band::ZERO,
            shortening: Band::ZERO,
            coupling: [T::ZERO; D],
            weight: [T::ZERO; D],
            root: [T::ZERO; D],
        };
        let beam = Beam::of(scene);
        for e in 0..elements {
            let own = match &beam {
                None => uniform_element(scene, e, l, mass),
                Some(beam) => varied_element(beam, e, elements, mass),
            };
            let root = if e == 0 { chain.hinge(scene, &own.stiffness) } else { [T::ZERO; 4] };
            let add = |sum: &mut Band<T, D, CHAIN>, matrix: &Matrix<T>| {
                scatter(sum, e, &matrix_with_root(matrix, &root));
            };
            add(&mut chain.stiffness, &own.stiffness);
            add(&mut chain.mass, &own.mass);
            add(&mut chain.spin, &own.centrifugal);
            add(&mut chain.spin, &own.mass.each(|row| row.each(|value| -value)));
            add(&mut chain.tension, &own.hanging);
            add(&mut chain.shortening, &own.shortening);
            let x = scene.hub.radius + T::from_u32(e as u32) * l;
            let rigid = [[x, T::ONE, x + l, T::ONE], [T::ONE, T::ZERO, T::ONE, T::ZERO]];
            for (sum, rigid) in [&mut chain.coupling, &mut chain.weight].into_iter().zip(rigid) {
                let product = own.mass.each(|row| dot(&row, &rigid));
                scatter_product(sum, e, &vector_with_root(&product, &root));
            }
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

    /// Lets the root turn: without inertia, so that its angle is what the joint's moment and the
    /// first element's leave of it, `(K_φφ + k) φ₀ + K_φ· q = 0`. Adds the joint's stiffness, and
    /// returns `φ₀` by the element's degrees of freedom.
    fn hinge<S: LinkShape>(&mut self, scene: &Scene<T, S>, element: &Matrix<T>) -> [T; 4] {
        let Some(k) = scene.hub.stiffness else { return [T::ZERO; 4] };
        let row = element[1];
        let root = row.each(|x| -x / (row[1] + k));
        let root = [T::ZERO, T::ZERO, root[2], root[3]];
        for i in 2..4 {
            self.root[i - 2] = root[i];
            for j in 2..=i {
                self.stiffness.add(i - 2, j - 2, k * root[i] * root[j]);
            }
        }
        root
    }

    /// The payload's mass and rotary inertia, `d` beyond the tip: its centre is at `w + dφ`, and
    /// comes `½dφ²` closer. A rotation of the tip has no centrifugal softening, so that `J_p` stays
    /// out of `spin`.
    fn add_payload<S: LinkShape>(&mut self, scene: &Scene<T, S>) {
        let (w, phi) = (D - 2, D - 1);
        let (payload, reach) = (scene.payload, scene.payload_reach());
        let lever = payload.mass * payload.offset;
        self.mass.add(w, w, payload.mass);
        self.mass.add(phi, w, lever);
        self.mass.add(phi, phi, lever * payload.offset + payload.inertia);
        self.spin.add(w, w, -payload.mass);
        self.spin.add(phi, w, -lever);
        self.spin.add(phi, phi, lever * reach - lever * payload.offset);
        self.tension.add(phi, phi, lever);
        self.coupling[w] += payload.mass * reach;
        self.coupling[phi] += lever * reach + payload.inertia;
        self.weight[w] += payload.mass;
        self.weight[phi] += lever;
    }
}

/// An element of a uniform link in closed form.
fn uniform_element<T: Scalar, S: LinkShape>(
    scene: &Scene<T, S>,
    e: usize,
    l: T,
    mass: MassMatrix,
) -> Element<T> {
    let (length, radius) = (scene.link.length, scene.hub.radius);
    let rho_a = scene.mass_per_length();
    let tip_force = scene.payload.mass * scene.payload_reach();
    let x1 = T::from_u32(e as u32) * l;
    // Axial force per θ̇², and per g along the link, in ξ = (x − x₁)/ℓ.
    let outboard = length - x1;
    let centrifugal = [
        rho_a * (radius * outboard + T::HALF * outboard * (length + x1)) + tip_force,
        -rho_a * l * (radius + x1),
        -T::HALF * rho_a * l * l,
    ];
    let hanging = [rho_a * outboard + scene.payload.mass, -rho_a * l, T::ZERO];
    Element {
        stiffness: element::stiffness(scene.link.bending_stiffness, l),
        mass: match mass {
            MassMatrix::Consistent => element::consistent_mass(rho_a, l),
            MassMatrix::Lumped => element::lumped_mass(rho_a, l),
        },
        centrifugal: element::axial(l, centrifugal),
        hanging: element::axial(l, hanging),
        shortening: element::axial(l, [T::ONE, T::ZERO, T::ZERO]),
    }
}

/// An element of any other link by quadrature.
fn varied_element<T: Scalar>(
    beam: &Beam<'_>,
    e: usize,
    elements: usize,
    mass: MassMatrix,
) -> Element<T> {
    let own = beam.element(e, elements, mass == MassMatrix::Lumped);
    let round = |matrix: &Matrix<f64>| matrix.each(|row| row.each(T::from_f64));
    Element {
        stiffness: round(&own.stiffness),
        mass: round(&own.mass),
        centrifugal: round(&own.centrifugal),
        hanging: round(&own.hanging),
        shortening: round(&own.shortening),
    }
}

/// `BᵀAB` over the second node, with `φ₁ = root · q`. The rows of the first node are left as they
/// are: they are never asked for.
fn matrix_with_root<T: Scalar>(a: &Matrix<T>, root: &[T; 4]) -> Matrix<T> {
    array(|i| {
        array(|j| a[i][j] + (root[i] * a[1][j] + a[i][1] * root[j] + root[i] * (a[1][1] * root[j])))
    })
}

/// `Bᵀf`, likewise.
fn vector_with_root<T: Scalar>(f: &[T; 4], root: &[T; 4]) -> [T; 4] {
    array(|i| f[i] + root[i] * f[1])
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

/// Adds a vector of element `e` to the free rows.
fn scatter_product<T: Scalar, const D: usize>(sum: &mut [T; D], e: usize, own: &[T; 4]) {
    for i in 0..4 {
        if let Some(row) = free(e, i) {
            sum[row] += own[i];
        }
    }
}

/// Global number of the element's degree of freedom `i`; none at the clamp.
fn free(e: usize, i: usize) -> Option<usize> {
    (2 * e + i).checked_sub(2)
}
