//! The mesh of a mechanism and the residual of its equations of motion.

use nalgebra::{Matrix3, Vector2, Vector3};
use stillbeam::mechanism::Mechanism;

use super::Options;
use super::band::Band;
use super::layout::{Layout, LinkPoints, Point, Unknown};
use super::pose::{Pose, State, System};
use crate::mechanism::table::Row;
use crate::mechanism::{Moving, is_passive};
use crate::reference::fem::element::Element;
use crate::reference::fem::inertia::{Inertia, body};
use crate::reference::fem::node::{Change, Node};

/// A mechanism's elements and bodies on their points.
pub(super) struct Model {
    pub mechanism: Mechanism,
    /// True if the released joints turn freely.
    pub closed: bool,
    pub layout: Layout,
    /// Elements of every link and their inertia; `None` of a rigid link.
    meshes: Vec<Option<(Element, Inertia)>>,
    /// Share of the weight, 0 to 1.
    pub share: f64,
    /// Largest distance between unknowns of one element or body.
    width: usize,
}

/// A system that is being put together.
struct Assembly<'a> {
    state: &'a State,
    change: &'a Change,
    /// Acceleration that holds a mass against gravity, m/s².
    lift: Vector2<f64>,
    system: &'a mut System,
}

/// The two ends of a link in a state.
pub(super) struct Ends {
    pub joint: Node,
    pub root: Node,
    pub end: Node,
}

impl Model {
    /// Creates the mesh. See [`Layout::new`].
    pub fn new(
        mechanism: &Mechanism,
        options: &Options,
        closed: bool,
        pin: Option<[f64; 2]>,
    ) -> Option<Self> {
        let layout = Layout::new(mechanism, options.elements, closed, pin)?;
        let damping = &mechanism.damping;
        let mesh = |link: &stillbeam::mechanism::Link| {
            link.bends().then(|| {
                let parts = options.elements as f64;
                let (length, bending) = (link.length / parts, link.bending_stiffness());
                let axial = options.axial_stiffness * bending / (link.length * link.length);
                let k = bending / length;
                let bending = [[4.0 * k, 2.0 * k], [2.0 * k, 4.0 * k]];
                (
                    Element { length, axial, bending, beta: damping.beta },
                    Inertia::new(link.mass / parts, length, damping.alpha),
                )
            })
        };
        let meshes = mechanism.links.iter().map(mesh).collect();
        let width = widest(&layout);
        let mechanism = mechanism.clone();
        Some(Self { mechanism, closed, layout, meshes, share: 1.0, width })
    }

    /// Returns an empty system of this mesh.
    pub fn system(&self) -> System {
        let count = self.layout.unknowns.len();
        System {
            residual: vec![0.0; count + self.layout.links.len()],
            tangent: Band::new(count, self.width),
        }
    }

    /// Computes the force that each unknown lacks for the equations of motion to hold, and its
    /// derivative along `change`. Behind the unknowns stand the torques of the drives.
    pub fn assemble(&self, state: &State, change: &Change, system: &mut System) {
        system.residual.fill(0.0);
        system.tangent.clear();
        let lift = Vector2::new(0.0, self.share * self.mechanism.gravity);
        let alpha = self.mechanism.damping.alpha;
        let mut assembly = Assembly { state, change, lift, system };
        for (index, points) in self.layout.links.iter().enumerate() {
            let joint = &self.mechanism.joints[index];
            assembly.add_body(&points.joint, [joint.mass, joint.stator_inertia, 0.0], alpha);
            // Drag does not act on hubs, as with one link.
            assembly.add_body(&points.root, [0.0, joint.inertia, 0.0], 0.0);
            if let Some((element, inertia)) = &self.meshes[index] {
                assembly.add_strip(points, element, inertia);
            } else {
                let link = &self.mechanism.links[index];
                let inertia = link.mass * link.length * link.length / 12.0;
                assembly.add_body(&points.root, [link.mass, inertia, 0.5 * link.length], alpha);
            }
        }
        let payload = &self.mechanism.payload;
        let own = [payload.mass, payload.inertia, payload.offset];
        assembly.add_body(self.tip(), own, alpha);
    }

    /// The point of the tip.
    fn tip(&self) -> &Point {
        &self.layout.links.last().expect("a chain has links").end
    }

    /// Adds what an impact meets: inertia, and the links' resistance to being stretched.
    pub fn assemble_impact(&self, state: &State, stiff: f64, system: &mut System) {
        let mass = Change { displacement: 0.0, rate: 0.0, acceleration: 1.0 };
        self.assemble(state, &mass, system);
        let stretch = Change { displacement: stiff, rate: 0.0, acceleration: 0.0 };
        for (points, mesh) in self.layout.links.iter().zip(&self.meshes) {
            let Some((element, _)) = mesh else { continue };
            let axial = Element { bending: [[0.0; 2]; 2], beta: 0.0, ..*element };
            let poses = deformed(state, points, element.length);
            for pair in poses.windows(2) {
                let (_, derivative) = axial.force(&pair[0].node, &pair[1].node, &stretch);
                let force = nalgebra::Vector6::zeros();
                system.add_pair([&pair[0], &pair[1]], (force, derivative), &mass);
            }
        }
        // A mass without bounds at the tip is caught by the ground.
        let tip = state.pose(self.tip());
        system.residual.fill(0.0);
        let caught = 1e9 * self.mass();
        let force = caught * Vector3::new(tip.node.v.x, tip.node.v.y, 0.0);
        let derivative = Matrix3::from_diagonal(&Vector3::new(caught, caught, 0.0));
        system.add_point(&tip, (force, derivative), &mass);
    }

    /// Mass of everything, kg.
    fn mass(&self) -> f64 {
        let links: f64 = self.mechanism.links.iter().map(|link| link.mass).sum();
        let joints: f64 = self.mechanism.joints.iter().map(|joint| joint.mass).sum();
        links + joints + self.mechanism.payload.mass
    }

    /// Returns the ends of a link.
    pub fn ends(&self, state: &State, link: usize) -> Ends {
        let points = &self.layout.links[link];
        let [joint, root, end] =
            [&points.joint, &points.root, &points.end].map(|point| state.pose(point).node);
        Ends { joint, root, end }
    }

    /// Returns the state of the same mechanism in other unknowns. Accelerations are left at 0.
    pub fn carry_over(&self, state: &State, to: &Self) -> State {
        let count = to.layout.unknowns.len();
        let zeros = vec![0.0; count];
        let mut new = State { u: zeros.clone(), v: zeros.clone(), a: zeros, drives: Vec::new() };
        new.drives.clone_from(&state.drives);
        for (k, unknown) in to.layout.unknowns.iter().enumerate() {
            let (node, axis) = match *unknown {
                Unknown::Inner { link, node, axis } => {
                    (state.pose(&self.layout.links[link].nodes[node]).node, axis)
                }
                Unknown::End { link, axis } => (self.ends(state, link).end, axis),
                Unknown::Root { link } => (self.ends(state, link).root, 2),
            };
            (new.u[k], new.v[k]) = (node.q[axis], node.v[axis]);
        }
        new
    }

    /// Returns the state of straight links at rest, with their joints at the given angles.
    pub fn straight(&self, angles: &[f64]) -> State {
        let drives = angles.iter().map(|&angle| Moving { angle, ..Moving::default() }).collect();
        let count = self.layout.unknowns.len();
        let mut u = vec![0.0; count];
        let (mut place, mut turned) = (Vector2::zeros(), 0.0);
        for (index, link) in self.mechanism.links.iter().enumerate() {
            turned += angles[index];
            let along = Vector2::new(f64::cos(turned), f64::sin(turned));
            place += self.mechanism.joints[index].radius * along;
            let element = self.meshes[index].as_ref().map_or(0.0, |(element, _)| element.length);
            let end = place + (link.length + link.tip_offset) * along;
            for (value, unknown) in u.iter_mut().zip(&self.layout.unknowns) {
                let at = |point: Vector2<f64>, axis: usize| {
                    if axis == 2 { turned } else { point[axis] }
                };
                match *unknown {
                    Unknown::Inner { link, node, axis } if link == index => {
                        *value = at(place + node as f64 * element * along, axis);
                    }
                    Unknown::End { link, axis } if link == index => *value = at(end, axis),
                    Unknown::Root { link } if link == index => *value = turned,
                    _ => {}
                }
            }
            place = end;
        }
        State { u, v: vec![0.0; count], a: vec![0.0; count], drives }
    }

    /// Returns the row of a state, of which `system` holds the torques.
    pub fn row(&self, t: f64, state: &State, system: &System) -> Row {
        let count = self.layout.links.len();
        let unknowns = self.layout.unknowns.len();
        let mut row = Row { t, ..Row::default() };
        for link in 0..count {
            let Ends { joint, root, end } = self.ends(state, link);
            let passive = is_passive(&self.mechanism, link, self.closed);
            let turned = if passive { root.q.z - joint.q.z } else { state.drives[link].angle };
            row.joints.push(turned);
            row.torques.push(if passive { 0.0 } else { system.residual[unknowns + link] });
            row.ends.push([end.q.x, end.q.y]);
            let away = (end.q - root.q).xy();
            let (sin, cos) = root.q.z.sin_cos();
            row.deflections.push(away.y * cos - away.x * sin);
        }
        row
    }
}

impl Assembly<'_> {
    /// Adds elements and their inertia along a link.
    fn add_strip(&mut self, points: &LinkPoints, element: &Element, inertia: &Inertia) {
        let poses = deformed(self.state, points, element.length);
        for pair in poses.windows(2) {
            let ends = [&pair[0], &pair[1]];
            let [a, b] = ends.map(|pose| &pose.node);
            let change = self.change;
            self.system.add_pair(ends, element.force(a, b, change), change);
            self.system.add_pair(ends, inertia.force(a, b, self.lift, change), change);
        }
    }

    /// Adds a rigid body on a point: mass (kg), inertia about its centre (kg m²), and the distance
    /// of the centre ahead of the point (m).
    fn add_body(&mut self, point: &Point, own: [f64; 3], alpha: f64) {
        if own != [0.0; 3] {
            let pose = self.state.pose(point);
            let force = body(own, alpha, &pose.node, self.lift, self.change);
            self.system.add_point(&pose, force, self.change);
        }
    }
}

/// Returns the poses of a link's nodes, with their deformation against the straight link at the
/// clamp.
fn deformed(state: &State, points: &LinkPoints, length: f64) -> Vec<Pose> {
    let mut poses: Vec<Pose> = points.nodes.iter().map(|point| state.pose(point)).collect();
    let clamp = poses[0].node.q;
    let (sin, cos) = clamp.z.sin_cos();
    for (k, pose) in poses.iter_mut().enumerate() {
        let along = k as f64 * length * Vector3::new(cos, sin, 0.0);
        pose.node.deformation = pose.node.q - clamp - along;
    }
    poses
}

/// Returns the largest distance between the unknowns of one element or body.
fn widest(layout: &Layout) -> usize {
    let count = layout.unknowns.len();
    let zeros = vec![0.0; count];
    let drives = vec![Moving::default(); layout.links.len()];
    let state = State { u: zeros.clone(), v: zeros.clone(), a: zeros, drives };
    let span = |poses: &[Pose]| {
        let all = poses.iter().flat_map(|pose| &pose.slopes).map(|slope| slope.0);
        let own = all.filter(|&i| i < count);
        let (least, most) = own.fold((usize::MAX, 0), |(a, b), i| (a.min(i), b.max(i)));
        most.saturating_sub(least)
    };
    let of_link = |points: &LinkPoints| {
        let nodes: Vec<Pose> = points.nodes.iter().map(|point| state.pose(point)).collect();
        let bodies = [&points.joint, &points.root, &points.end].map(|point| state.pose(point));
        let pairs = nodes.windows(2).map(span).max().unwrap_or(0);
        bodies.into_iter().map(|pose| span(&[pose])).max().unwrap_or(0).max(pairs)
    };
    layout.links.iter().map(of_link).max().unwrap_or(0)
}
