//! State of a node.

use nalgebra::Vector3;

/// Displacement, velocity and acceleration of a node: global x, y (m) and rotation (rad). They are
/// the sums of u_m and u_d.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::reference) struct Node {
    /// Position x, y and rotation.
    pub q: Vector3<f64>,
    pub v: Vector3<f64>,
    pub a: Vector3<f64>,
    /// Deformation u_d alone, and its rate.
    pub deformation: Vector3<f64>,
    pub deformation_rate: Vector3<f64>,
}

/// Factors by which a change of the unknowns enters displacements, velocities and accelerations.
#[derive(Clone, Copy, Debug)]
pub(in crate::reference) struct Change {
    pub displacement: f64,
    /// 1/s.
    pub rate: f64,
    /// 1/s².
    pub acceleration: f64,
}

/// u_d of every node with its time derivatives.
#[derive(Clone, Debug)]
pub(super) struct Deformation {
    pub u: Vec<Vector3<f64>>,
    pub v: Vec<Vector3<f64>>,
    pub a: Vec<Vector3<f64>>,
}
