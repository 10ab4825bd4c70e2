//! The arm as a chain of nodes in the global frame.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector2, Vector3};
use stillbeam::Scene;
use stillbeam::hub::HubState;

use super::block::Chain;
use super::element::Element;
use super::inertia::{Inertia, payload};
use super::node::{Change, Deformation, Node};
use super::{HubModel, Options};

/// Elements of the arm and the residual of its equations of motion.
pub(super) struct Model {
    pub scene: Scene,
    /// Present gravity in the plane of motion, m/s².
    pub gravity: f64,
    /// Direction of what holds a mass against gravity, in the global frame.
    lift: Vector2<f64>,
    /// Distance of every node from the axis, undeformed, m. The first node moves with the hub.
    reach: Vec<f64>,
    elements: Vec<Element>,
    /// Inertia of an element of the link. The hub's element has no mass.
    inertia: Inertia,
    /// Number of elements of the hub, 0 or 1.
    hub_elements: usize,
}

impl Model {
    pub fn new(scene: &Scene, options: &Options) -> Self {
        let (link, damping) = (&scene.link, &scene.damping);
        let count = options.elements;
        let length = link.length / count as f64;
        let bending = link.bending_stiffness;
        let axial = options.axial_stiffness * bending / (link.length * link.length);
        let beta = damping.beta;
        let mut reach = Vec::new();
        let mut elements = Vec::new();
        if let (HubModel::Element { stiffness }, true) = (options.hub, scene.hub.radius > 0.0) {
            reach.push(0.0);
            elements.push(Element {
                length: scene.hub.radius,
                axial: stiffness * axial,
                bending: stiffness * bending,
                beta,
            });
        }
        let hub_elements = elements.len();
        reach.extend((0..=count).map(|i| scene.hub.radius + i as f64 * length));
        elements.extend((0..count).map(|_| Element { length, axial, bending, beta }));
        let inertia = Inertia::new(link.mass / count as f64, length, damping.alpha);
        let gravity = scene.in_plane_gravity();
        let lift = Vector2::new(-scene.mount.direction.sin(), scene.mount.direction.cos());
        Self { scene: *scene, gravity, lift, reach, elements, inertia, hub_elements }
    }

    pub fn nodes(&self) -> usize {
        self.reach.len()
    }

    /// Sets the nodes to u_m + u_d: the rigid motion with the hub, exact in time, and the
    /// deformation.
    pub fn place(&self, hub: &HubState<f64>, deformation: &Deformation, nodes: &mut [Node]) {
        if self.scene.mount.is_linear() {
            self.place_on_carriage(hub, deformation, nodes);
            return;
        }
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
            };
        }
    }

    /// Sets the nodes to u_m + u_d on a carriage, which moves along global Y.
    fn place_on_carriage(
        &self,
        hub: &HubState<f64>,
        deformation: &Deformation,
        nodes: &mut [Node],
    ) {
        let moved = |x: f64, y: f64| Vector3::new(x, y, 0.0);
        for (i, &x) in self.reach.iter().enumerate() {
            nodes[i] = Node {
                q: moved(x, hub.angle.radians()) + deformation.u[i],
                v: moved(0.0, hub.rate) + deformation.v[i],
                a: moved(0.0, hub.acceleration) + deformation.a[i],
                deformation: deformation.u[i],
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
        let lift = self.gravity * self.lift;
        residual.fill(Vector3::zeros());
        tangent.clear();
        for (i, element) in self.elements.iter().enumerate() {
            let (a, b) = (&nodes[i], &nodes[i + 1]);
            let (mut force, mut stiffness) = element.force(a, b, change);
            if i >= self.hub_elements {
                let (inertia, mass) = self.inertia.force(a, b, lift, change);
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
        let tip = self.nodes() - 1;
        let (force, mass) = payload(&self.scene, &nodes[tip], lift, change);
        residual[tip] += force;
        tangent.diagonal[tip] += Matrix3::from_diagonal(&mass);
    }

    /// Returns the hub torque, N m: the first node's reaction, moment and force carried to the
    /// axis, and `J_h θ̈`. On a linear axis the force on the carriage, its own mass included, N.
    pub fn torque(&self, reaction: &Vector3<f64>, clamp: &Node, hub: &HubState<f64>) -> f64 {
        let own = self.scene.hub.inertia;
        if self.scene.mount.is_linear() {
            return reaction.y + own * (hub.acceleration + self.gravity * self.lift.y);
        }
        reaction.z + clamp.q.x * reaction.y - clamp.q.y * reaction.x + own * hub.acceleration
    }

    /// Returns a position in the global frame, m, as it is on a carrier that turns.
    pub fn on_carrier(&self, q: &Vector3<f64>, t: f64) -> [f64; 2] {
        let carrier = self.scene.mount.carrier;
        if carrier == 0.0 {
            return [q.x, q.y];
        }
        let (sin, cos) = (carrier * t).sin_cos();
        [q.x * cos + q.y * sin, q.y * cos - q.x * sin]
    }

    /// Returns the hub-frame Y of a position in the global frame, m.
    pub fn deflection(&self, q: &Vector3<f64>, hub: &HubState<f64>) -> f64 {
        if self.scene.mount.is_linear() {
            return q.y - hub.angle.radians();
        }
        q.y * hub.cos - q.x * hub.sin
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
        let largest = residual.iter().skip(1).fold(0.0, |largest: f64, r| {
            // f64::max would drop a NaN.
            let size = r.x.abs().max(r.y.abs()).max(r.z.abs() / link.length) + 0.0 * r.sum();
            if size.is_nan() { f64::INFINITY } else { largest.max(size) }
        });
        scale * largest
    }
}

impl Deformation {
    pub fn zeros(nodes: usize) -> Self {
        let zeros = vec![Vector3::zeros(); nodes];
        Self { u: zeros.clone(), v: zeros.clone(), a: zeros }
    }
}
