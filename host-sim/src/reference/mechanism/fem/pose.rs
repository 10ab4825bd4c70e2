//! Place, velocity and acceleration of a point of the mesh, with its derivatives.

use nalgebra::{Matrix6, Vector2, Vector3, Vector6};

use super::band::Band;
use super::layout::{Base, Point, Rotation};
use crate::mechanism::Moving;
use crate::reference::fem::node::{Change, Node};

/// The unknowns with their rates and accelerations, and what the drives command.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub u: Vec<f64>,
    pub v: Vec<f64>,
    pub a: Vec<f64>,
    /// Commanded angle of every joint; of passive joints it is not used.
    pub drives: Vec<Moving>,
}

/// A point in a state.
#[derive(Clone, Debug)]
pub(super) struct Pose {
    pub node: Node,
    /// Derivative of x, y and rotation over unknowns. Behind the unknowns follow the drives.
    pub slopes: Vec<(usize, Vector3<f64>)>,
    /// Arms that turn with an unknown: its index and the arm, m.
    arms: Vec<(usize, Vector2<f64>)>,
}

/// Residual of all equations, and its derivative over the unknowns.
pub(super) struct System {
    /// Forces on the unknowns that are lacking, then the torques of the drives.
    pub residual: Vec<f64>,
    pub tangent: Band,
}

impl State {
    /// Returns angle, rate and acceleration of a rotation.
    fn turn(&self, rotation: &Rotation) -> [f64; 3] {
        let own = rotation.unknown.map_or([0.0; 3], |i| [self.u[i], self.v[i], self.a[i]]);
        rotation.drives.iter().fold(own, |[angle, rate, turning], &joint| {
            let drive = self.drives[joint];
            [angle + drive.angle, rate + drive.rate, turning + drive.acceleration]
        })
    }

    /// Computes a point.
    pub fn pose(&self, point: &Point) -> Pose {
        let count = self.u.len();
        let mut node = Node::default();
        let mut slopes = Vec::new();
        let mut arms = Vec::new();
        match point.base {
            Base::Fixed([x, y]) => node.q = Vector3::new(x, y, 0.0),
            Base::Master(x) => {
                for axis in 0..2 {
                    let i = x + axis;
                    (node.q[axis], node.v[axis], node.a[axis]) = (self.u[i], self.v[i], self.a[i]);
                    slopes.push((i, Vector3::ith(axis, 1.0)));
                }
            }
        }
        for (length, rotation) in &point.arms {
            let [angle, rate, turning] = self.turn(rotation);
            let (sin, cos) = angle.sin_cos();
            let along = Vector3::new(length * cos, length * sin, 0.0);
            let across = Vector3::new(-along.y, along.x, 0.0);
            node.q += along;
            node.v += rate * across;
            node.a += turning * across - rate * rate * along;
            for i in indices(rotation, count) {
                slopes.push((i, across));
            }
            if let Some(unknown) = rotation.unknown {
                arms.push((unknown, along.xy()));
            }
        }
        [node.q.z, node.v.z, node.a.z] = self.turn(&point.rotation);
        slopes.extend(indices(&point.rotation, count).map(|i| (i, Vector3::z())));
        Pose { node, slopes, arms }
    }
}

/// Returns the indices over which a rotation has the derivative 1.
fn indices(rotation: &Rotation, count: usize) -> impl Iterator<Item = usize> {
    rotation.unknown.into_iter().chain(rotation.drives.iter().map(move |joint| count + joint))
}

impl System {
    /// Adds the force at two points, and its derivative over both.
    pub fn add_pair(
        &mut self,
        [a, b]: [&Pose; 2],
        (force, derivative): (Vector6<f64>, Matrix6<f64>),
        change: &Change,
    ) {
        let ends = [a, b];
        for (row, pose) in ends.into_iter().enumerate() {
            let own = force.fixed_rows::<3>(3 * row).into_owned();
            self.add_force(pose, &own, change);
            for (column, other) in ends.into_iter().enumerate() {
                let block = derivative.fixed_view::<3, 3>(3 * row, 3 * column);
                for (i, slope) in &pose.slopes {
                    for (j, along) in &other.slopes {
                        self.tangent.add(*i, *j, slope.dot(&(block * along)));
                    }
                }
            }
        }
    }

    /// Adds the force at one point, and its derivative there.
    pub fn add_point(
        &mut self,
        pose: &Pose,
        (force, derivative): (Vector3<f64>, nalgebra::Matrix3<f64>),
        change: &Change,
    ) {
        self.add_force(pose, &force, change);
        for (i, slope) in &pose.slopes {
            for (j, along) in &pose.slopes {
                self.tangent.add(*i, *j, slope.dot(&(derivative * along)));
            }
        }
    }

    /// Adds a force, and the turn of its lever arms. What turning arms add to rates is left to the
    /// iterations: it is of the order of a step's turn.
    fn add_force(&mut self, pose: &Pose, force: &Vector3<f64>, change: &Change) {
        for (i, slope) in &pose.slopes {
            self.residual[*i] += slope.dot(force);
        }
        for (i, arm) in &pose.arms {
            self.tangent.add(*i, *i, -change.displacement * arm.dot(&force.xy()));
        }
    }
}
