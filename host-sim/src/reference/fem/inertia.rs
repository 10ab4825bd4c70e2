//! Inertia forces, drag and weight.

use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;
use nalgebra::{Matrix3, Matrix6, SMatrix, Vector2, Vector3, Vector6};

use super::node::{Change, Node};

/// Points of the quadrature over an element: exact to degree 9.
const DEGREE: NonZeroUsize = NonZeroUsize::new(5).unwrap();

/// Consistent mass of an element: its kinetic energy is that of
/// `r(ξ) = N₁x₁ + N₂t₁ + N₃x₂ + N₄t₂`, the cubic Hermite curve through the nodes with the unit
/// tangents `t = (cos θ, sin θ)`.
///
/// Across the chord this is the usual consistent mass, turned with the element. Written for points
/// and tangents the matrix is the same number for both global directions whatever the angle, so it
/// stays constant; what turning adds, `ẗ = θ̈n − θ̇²t`, is exact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inertia {
    matrix: SMatrix<f64, 4, 4>,
    alpha: f64,
}

impl Inertia {
    pub fn new(mass: f64, l: f64, alpha: f64) -> Self {
        let matrix = SMatrix::from([
            [156.0, 22.0 * l, 54.0, -13.0 * l],
            [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
            [54.0, 13.0 * l, 156.0, -22.0 * l],
            [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
        ]);
        Self { matrix: matrix * (mass / 420.0), alpha }
    }

    /// Returns the consistent mass of an element whose mass per length (kg/m) is `density` by the
    /// place ξ = 0..1, a polynomial of degree 2 or less.
    pub fn varied(l: f64, alpha: f64, density: impl Fn(f64) -> f64) -> Self {
        let mut matrix = SMatrix::zeros();
        for &(x, weight) in GaussLegendre::new(DEGREE).iter() {
            let xi = 0.5 * (1.0 + x);
            let (xi2, xi3) = (xi * xi, xi * xi * xi);
            let n = SMatrix::<f64, 4, 1>::new(
                1.0 - 3.0 * xi2 + 2.0 * xi3,
                l * (xi - 2.0 * xi2 + xi3),
                3.0 * xi2 - 2.0 * xi3,
                l * (xi3 - xi2),
            );
            matrix += n * n.transpose() * (0.5 * weight * l * density(xi));
        }
        Self { matrix, alpha }
    }

    /// Returns inertia, drag and weight (`lift` is gravity's negative in the global frame, m/s²) as
    /// forces that the arm has to supply, N, N, N m at each end, and their derivative along
    /// `change`.
    pub fn force(
        &self,
        a: &Node,
        b: &Node,
        lift: Vector2<f64>,
        change: &Change,
    ) -> (Vector6<f64>, Matrix6<f64>) {
        let alpha = self.alpha;
        let linear = change.acceleration + alpha * change.rate;
        let mut acceleration = [Vector2::zeros(); 4];
        let mut normal = [Vector2::zeros(); 2];
        let mut tangent = [Vector2::zeros(); 2];
        // Derivative of ẗ + αṫ over the node's rotation.
        let mut turning = [Vector2::zeros(); 2];
        for (i, node) in [a, b].into_iter().enumerate() {
            let (sin, cos) = node.q.z.sin_cos();
            let (t, n) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
            let (rate, second) = (node.v.z, node.a.z);
            acceleration[2 * i] = node.a.xy() + alpha * node.v.xy() + lift;
            acceleration[2 * i + 1] = (second + alpha * rate) * n - rate * rate * t;
            turning[i] = (linear - change.displacement * rate * rate) * n
                - (change.displacement * (second + alpha * rate) + 2.0 * rate * change.rate) * t;
            (tangent[i], normal[i]) = (t, n);
        }
        let mut force = Vector6::zeros();
        let mut derivative = Matrix6::zeros();
        for i in 0..2 {
            let pull = |row: usize| {
                (0..4)
                    .fold(Vector2::zeros(), |sum, k| sum + self.matrix[(row, k)] * acceleration[k])
            };
            let (at_point, at_tangent) = (pull(2 * i), pull(2 * i + 1));
            force.fixed_rows_mut::<2>(3 * i).copy_from(&at_point);
            force[3 * i + 2] = normal[i].dot(&at_tangent);
            for j in 0..2 {
                let m = |p: usize, q: usize| self.matrix[(2 * i + p, 2 * j + q)];
                for axis in 0..2 {
                    derivative[(3 * i + axis, 3 * j + axis)] = m(0, 0) * linear;
                    derivative[(3 * i + axis, 3 * j + 2)] = m(0, 1) * turning[j][axis];
                    derivative[(3 * i + 2, 3 * j + axis)] = m(1, 0) * linear * normal[i][axis];
                }
                derivative[(3 * i + 2, 3 * j + 2)] = m(1, 1) * normal[i].dot(&turning[j]);
            }
            derivative[(3 * i + 2, 3 * i + 2)] -= change.displacement * tangent[i].dot(&at_tangent);
        }
        (force, derivative)
    }
}

/// Returns the force of a rigid body that is fixed to a node, as [`Inertia::force`] does: of `mass`
/// kg and `inertia` kg m² about its own centre, which lies `offset` m ahead along the node's
/// tangent.
pub(super) fn body(
    [mass, inertia, offset]: [f64; 3],
    alpha: f64,
    node: &Node,
    lift: Vector2<f64>,
    change: &Change,
) -> (Vector3<f64>, Matrix3<f64>) {
    let (sin, cos) = node.q.z.sin_cos();
    let (t, n) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
    let (rate, turning) = (node.v.z, node.a.z + alpha * node.v.z);
    let linear = change.acceleration + alpha * change.rate;
    let centre = node.a.xy() + alpha * node.v.xy() + lift;
    let force = mass * (centre + offset * (turning * n - rate * rate * t));
    // Its derivative over the node's rotation.
    let turned = mass
        * offset
        * ((linear - change.displacement * rate * rate) * n
            - (change.displacement * turning + 2.0 * rate * change.rate) * t);
    let lever = mass * linear * offset * n;
    let moment = offset * n.dot(&force) + inertia * turning;
    let twist = offset * (n.dot(&turned) - change.displacement * t.dot(&force)) + inertia * linear;
    (
        Vector3::new(force.x, force.y, moment),
        Matrix3::new(
            mass * linear,
            0.0,
            turned.x,
            0.0,
            mass * linear,
            turned.y,
            lever.x,
            lever.y,
            twist,
        ),
    )
}
