//! The arm as a chain of nodes in the global frame.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use stillbeam::Scene;
use stillbeam::hub::HubState;

use super::block::Chain;
use super::element::{Element, end_stiffness};
use super::inertia::{Inertia, body};
use super::node::{Change, Deformation, Node};
use super::{HubModel, Options};

/// Elements of the arm and the residual of its equations of motion.
pub(super) struct Model {
    pub scene: Scene,
    /// Present gravity, m/s².
    pub gravity: f64,
    /// Distance of every node from the axis, undeformed, m. The first node moves with the hub, but
    /// for its rotation where the joint gives.
    reach: Vec<f64>,
    elements: Vec<Element>,
    /// Inertia of the elements of the link. The hub's element has no mass.
    inertia: Vec<Inertia>,
    /// Number of elements of the hub, 0 or 1.
    hub_elements: usize,
    /// Rigid bodies on nodes: mass (kg), inertia (kg m²) and offset (m).
    bodies: Vec<(usize, [f64; 3])>,
    /// Stiffness (N m/rad) and damping (N m s/rad) of the joint between hub and link.
    joint: Option<[f64; 2]>,
}

impl Model {
    pub fn new(scene: &Scene, options: &Options) -> Self {
        let (link, damping) = (&scene.link, &scene.damping);
        let bending = link.bending_stiffness;
        let axial = options.axial_stiffness * bending / (link.length * link.length);
        let beta = damping.beta;
        let uniform = |length: f64, bending: f64| {
            let k = bending / length;
            [[4.0 * k, 2.0 * k], [2.0 * k, 4.0 * k]]
        };
        let mut reach = Vec::new();
        let mut elements = Vec::new();
        if let (HubModel::Element { stiffness }, true) = (options.hub, scene.hub.radius > 0.0) {
            reach.push(0.0);
            elements.push(Element {
                length: scene.hub.radius,
                axial: stiffness * axial,
                bending: uniform(scene.hub.radius, stiffness * bending),
                beta,
            });
        }
        let hub_elements = elements.len();
        let nodes = mesh(scene, options.elements);
        reach.extend(nodes.iter().map(|&xi| scene.hub.radius + xi * link.length));
        let mut inertia = Vec::new();
        for ends in nodes.windows(2) {
            let (begin, share) = (ends[0], ends[1] - ends[0]);
            let length = share * link.length;
            let shape = &scene.shape;
            let at = |xi: f64| begin + xi * share;
            let (stiffness, own) = if shape.is_uniform() {
                let mass = link.mass * share;
                (uniform(length, bending), Inertia::new(mass, length, damping.alpha))
            } else {
                let density = |xi: f64| scene.mass_per_length() * shape.density(at(xi));
                (
                    end_stiffness(length, |xi| 1.0 / (bending * shape.stiffness(at(xi)))),
                    Inertia::varied(length, damping.alpha, density),
                )
            };
            elements.push(Element { length, axial, bending: stiffness, beta });
            inertia.push(own);
        }
        let near = |position: f64| {
            let apart = |&i: &usize| (nodes[i] - position).abs();
            (0..nodes.len()).min_by(|i, j| apart(i).total_cmp(&apart(j))).expect("a node")
        };
        let payload = &scene.payload;
        let mut bodies: Vec<_> = scene
            .shape
            .masses()
            .map(|own| (hub_elements + near(own.position), [own.mass, 0.0, 0.0]))
            .collect();
        bodies.push((reach.len() - 1, [payload.mass, payload.inertia, payload.offset]));
        let joint = scene.hub.stiffness.map(|k| [k, k * (beta + damping.joint)]);
        let (scene, gravity) = (*scene, scene.gravity);
        Self { scene, gravity, reach, elements, inertia, hub_elements, bodies, joint }
    }

    /// Returns the number of the first node that has unknowns: 0 where the joint gives.
    pub fn first(&self) -> usize {
        usize::from(self.joint.is_none())
    }

    /// Returns the moment of the joint on the link's root, N m.
    fn joint_moment(&self, clamp: &Node) -> f64 {
        self.joint.map_or(0.0, |[k, c]| k * clamp.deformation.z + c * clamp.deformation_rate.z)
    }

    /// Holds the position of the first node, which only turns, in the equations.
    pub fn hold(&self, residual: &mut [Vector3<f64>], tangent: &mut Chain) {
        if self.joint.is_none() {
            return;
        }
        for axis in 0..2 {
            residual[0][axis] = 0.0;
            for other in 0..3 {
                tangent.diagonal[0][(axis, other)] = 0.0;
                tangent.diagonal[0][(other, axis)] = 0.0;
                tangent.upper[0][(axis, other)] = 0.0;
                tangent.lower[1][(other, axis)] = 0.0;
            }
            tangent.diagonal[0][(axis, axis)] = 1.0;
        }
    }

    pub fn nodes(&self) -> usize {
        self.reach.len()
    }

    /// Sets the nodes to u_m + u_d: the rigid motion with the hub, exact in time, and the
    /// deformation.
    pub fn place(&self, hub: &HubState<f64>, deformation: &Deformation, nodes: &mut [Node]) {
        // Whole turns are left out: only directions are ever taken from it.
        let angle = TAU * hub.angle.part;
        let (sin, cos) = (hub.sin, hub.cos);
        for (i, &x) in self.reach.iter().enumerate() {
            let (along, across) =
                (Vector3::new(x * cos, x * sin, 0.0), Vector3::new(-x * sin, x * cos, 1.0));
            nodes[i] = Node {
                q: along + Vector3::new(0.0, 0.0, angle) + deformation.u[i],
                v: hub.rate * across + deformation.v[i],
                a: hub.acceleration * across - hub.rate * hub.rate * along + deformation.a[i],
                deformation: deformation.u[i],
                deformation_rate: deformation.v[i],
            };
        }
    }

    /// Returns the force (N, N, N m) that each node lacks for the equations of motion to hold, and
    /// its derivative. That of the first node is the reaction of the hub.
    pub fn residual(
        &self,
        nodes: &[Node],
        change: &Change,
        residual: &mut [Vector3<f64>],
        tangent: &mut Chain,
    ) {
        residual.fill(Vector3::zeros());
        tangent.clear();
        for (i, element) in self.elements.iter().enumerate() {
            let (a, b) = (&nodes[i], &nodes[i + 1]);
            let (mut force, mut stiffness) = element.force(a, b, change);
            if i >= self.hub_elements {
                let own = &self.inertia[i - self.hub_elements];
                let (inertia, mass) = own.force(a, b, self.gravity, change);
                force += inertia;
                stiffness += mass;
            }
            residual[i] += force.fixed_rows::<3>(0);
            residual[i + 1] += force.fixed_rows::<3>(3);
            tangent.diagonal[i] += stiffness.fixed_view::<3, 3>(0, 0);
            tangent.upper[i] += stiffness.fixed_view::<3, 3>(0, 3);
            tangent.lower[i + 1] += stiffness.fixed_view::<3, 3>(3, 0);
            tangent.diagonal[i + 1] += stiffness.fixed_view::<3, 3>(3, 3);
        }
        let alpha = self.scene.damping.alpha;
        for &(node, own) in &self.bodies {
            let (force, mass) = body(own, alpha, &nodes[node], self.gravity, change);
            residual[node] += force;
            tangent.diagonal[node] += mass;
        }
        if let Some([k, c]) = self.joint {
            residual[0].z += self.joint_moment(&nodes[0]);
            tangent.diagonal[0][(2, 2)] += k * change.displacement + c * change.rate;
        }
    }

    /// Returns the hub torque, N m: the first node's reaction, moment and force carried to the
    /// axis, and `J_h θ̈`.
    pub fn torque(&self, reaction: &Vector3<f64>, clamp: &Node, hub: &HubState<f64>) -> f64 {
        let moment = if self.joint.is_some() { -self.joint_moment(clamp) } else { reaction.z };
        moment + clamp.q.x * reaction.y - clamp.q.y * reaction.x
            + self.scene.hub.inertia * hub.acceleration
    }

    /// Returns the payload's centre in the global frame, m, from the node at the tip.
    pub fn payload(&self, tip: &Node) -> [f64; 2] {
        let (sin, cos) = tip.q.z.sin_cos();
        let offset = self.scene.payload.offset;
        [tip.q.x + offset * cos, tip.q.y + offset * sin]
    }

    /// Returns the residual that rounding of the displacements may leave, relative as in
    /// [`Self::relative`]: that of the stretch, `ε |u|/l₀`, times EA, of the stiffest element.
    pub fn rounding(&self) -> f64 {
        let link = &self.scene.link;
        let scale = link.length * link.length / link.bending_stiffness;
        let stiffest =
            self.elements.iter().map(|element| element.axial / element.length).fold(0.0, f64::max);
        16.0 * f64::EPSILON * stiffest * self.scene.reach() * scale
    }

    /// Returns the size of a residual against `EI/L²`, moments taken at the arm L.
    pub fn relative(&self, residual: &[Vector3<f64>]) -> f64 {
        let link = &self.scene.link;
        let scale = link.length * link.length / link.bending_stiffness;
        let root = self.joint.map(|_| Vector3::new(0.0, 0.0, residual[0].z));
        let largest = residual.iter().skip(1).chain(&root).fold(0.0, |largest: f64, r| {
            // f64::max would drop a NaN.
            let size = r.x.abs().max(r.y.abs()).max(r.z.abs() / link.length) + 0.0 * r.sum();
            if size.is_nan() { f64::INFINITY } else { largest.max(size) }
        });
        scale * largest
    }
}

/// Returns the nodes of the link, fractions of L: at the borders of its sections and at its masses,
/// and `count` elements or more between them, as even as that allows.
fn mesh(scene: &Scene, count: usize) -> Vec<f64> {
    let mut borders = vec![0.0, 1.0];
    borders.extend(scene.shape.borders());
    borders.extend(scene.shape.masses().map(|own| own.position));
    borders.sort_by(f64::total_cmp);
    borders.dedup_by(|b, a| *b - *a < 1e-12);
    let mut nodes = vec![0.0];
    for ends in borders.windows(2) {
        let (begin, share) = (ends[0], ends[1] - ends[0]);
        let parts = (share * count as f64 - 1e-9).ceil().max(1.0);
        nodes.extend((1..=parts as usize).map(|i| begin + share * i as f64 / parts));
    }
    nodes
}

impl Deformation {
    pub fn zeros(nodes: usize) -> Self {
        let zeros = vec![Vector3::zeros(); nodes];
        Self { u: zeros.clone(), v: zeros.clone(), a: zeros }
    }
}
