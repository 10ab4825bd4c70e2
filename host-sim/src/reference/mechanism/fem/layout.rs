//! Unknowns of the mesh, and the points that follow from them.
//!
//! Every flexible link has nodes of its own between its ends. Its far end is a master: place and
//! rotation are unknowns. Its near end, the clamp, follows from the joint that carries it, and so
//! do rigid links. A pinned tip is a fixed point; rigid links before it follow from the pin.

use stillbeam::mechanism::Mechanism;

use crate::mechanism::is_passive;

/// Meaning of an unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unknown {
    /// x, y or rotation of a node inside a link.
    Inner { link: usize, node: usize, axis: usize },
    /// x, y or rotation of a link's far end, at the next joint.
    End { link: usize, axis: usize },
    /// Rotation of a link's root behind a passive joint.
    Root { link: usize },
}

impl Unknown {
    /// True for an angle, false for a length.
    pub fn is_rotation(self) -> bool {
        match self {
            Self::Inner { axis, .. } | Self::End { axis, .. } => axis == 2,
            Self::Root { .. } => true,
        }
    }
}

/// An angle: an unknown, turned further by drives.
#[derive(Clone, Debug, Default)]
pub(super) struct Rotation {
    /// Index of the unknown; `None` for the ground.
    pub unknown: Option<usize>,
    /// Joints whose commanded angles are added.
    pub drives: Vec<usize>,
}

/// The point that others follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Base {
    /// The first joint, which is fixed, or the pin.
    Fixed([f64; 2]),
    /// Index of the unknown x; y is the next.
    Master(usize),
}

/// A point that is a base, and rigid arms from it.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub base: Base,
    /// Lengths along directions, m.
    pub arms: Vec<(f64, Rotation)>,
    /// Rotation at the point.
    pub rotation: Rotation,
}

/// Points of one link.
#[derive(Clone, Debug)]
pub(super) struct LinkPoints {
    /// The joint that carries the link, as the link before it has it.
    pub joint: Point,
    /// The clamp.
    pub root: Point,
    /// Nodes from clamp to the end of the strip; of a rigid link the clamp alone.
    pub nodes: Vec<Point>,
    /// The next joint, or the tip.
    pub end: Point,
}

/// All unknowns and points.
pub(super) struct Layout {
    pub unknowns: Vec<Unknown>,
    pub links: Vec<LinkPoints>,
}

impl Point {
    /// Returns the point `length` m further along its tangent.
    pub fn forward(&self, length: f64) -> Self {
        let mut point = self.clone();
        if length != 0.0 {
            point.arms.push((length, self.rotation.clone()));
        }
        point
    }
}

impl Layout {
    /// Lays out the mesh with that many elements a flexible link. With `closed` the released joints
    /// turn freely; a `pin` holds the tip.
    ///
    /// Returns `None` for a pinned chain without a link that bends.
    pub fn new(
        mechanism: &Mechanism,
        elements: usize,
        closed: bool,
        pin: Option<[f64; 2]>,
    ) -> Option<Self> {
        let count = mechanism.links.len();
        // The links behind the last one that bends follow from the pin.
        let last = (0..count).rev().find(|&j| mechanism.links[j].bends());
        let pinned = pin.map(|pin| last.map(|last| (pin, last)));
        if pinned == Some(None) {
            return None;
        }
        let pinned = pinned.flatten();
        let mut layout = Self { unknowns: Vec::new(), links: Vec::new() };
        let mut here =
            Point { base: Base::Fixed([0.0; 2]), arms: Vec::new(), rotation: Rotation::default() };
        for index in 0..count {
            let ending = pinned.filter(|(_, last)| *last == index).map(|(pin, _)| pin);
            let free = is_passive(mechanism, index, closed);
            let joint = here.clone();
            let rotation = layout.behind_joint(&here.rotation, index, free);
            let root = Point { rotation, ..here }.forward(mechanism.joints[index].radius);
            let link = layout.add_link(mechanism, index, elements, (joint, root), ending, closed);
            here = link.end.clone();
            layout.links.push(link);
        }
        Some(layout)
    }

    /// Returns the rotation behind a joint.
    fn behind_joint(&mut self, before: &Rotation, joint: usize, free: bool) -> Rotation {
        let root = Unknown::Root { link: joint };
        if free {
            // The links before the pin have asked for it already.
            let known = self.unknowns.iter().position(|unknown| *unknown == root);
            return Rotation {
                unknown: Some(known.unwrap_or_else(|| self.add(root))),
                ..default()
            };
        }
        let mut rotation = before.clone();
        rotation.drives.push(joint);
        rotation
    }

    fn add(&mut self, unknown: Unknown) -> usize {
        self.unknowns.push(unknown);
        self.unknowns.len() - 1
    }

    fn add_link(
        &mut self,
        mechanism: &Mechanism,
        index: usize,
        elements: usize,
        (joint, root): (Point, Point),
        pin: Option<[f64; 2]>,
        closed: bool,
    ) -> LinkPoints {
        let link = &mechanism.links[index];
        if !link.bends() {
            let end = root.forward(link.length + link.tip_offset);
            return LinkPoints { joint, nodes: vec![root.clone()], root, end };
        }
        let mut nodes = vec![root.clone()];
        for node in 1..elements {
            let of = |axis| Unknown::Inner { link: index, node, axis };
            let [x, _, turned] = [0, 1, 2].map(|axis| self.add(of(axis)));
            nodes.push(Point::master(x, turned));
        }
        let end = match pin {
            None => {
                let [x, _, turned] =
                    [0, 1, 2].map(|axis| self.add(Unknown::End { link: index, axis }));
                Point::master(x, turned)
            }
            Some(pin) => self.before_pin(mechanism, index, pin, closed),
        };
        nodes.push(end.forward(-link.tip_offset));
        LinkPoints { joint, root, nodes, end }
    }

    /// Returns the far end of the last link that bends, whose place follows from the pin.
    fn before_pin(
        &mut self,
        mechanism: &Mechanism,
        index: usize,
        pin: [f64; 2],
        closed: bool,
    ) -> Point {
        let turned = self.add(Unknown::End { link: index, axis: 2 });
        let own = Rotation { unknown: Some(turned), drives: Vec::new() };
        let mut rotation = own.clone();
        let mut arms = Vec::new();
        for later in index + 1..mechanism.links.len() {
            let free = is_passive(mechanism, later, closed);
            rotation = self.behind_joint(&rotation, later, free);
            let link = &mechanism.links[later];
            let length = mechanism.joints[later].radius + link.length + link.tip_offset;
            arms.push((-length, rotation.clone()));
        }
        Point { base: Base::Fixed(pin), arms, rotation: own }
    }
}

impl Point {
    fn master(x: usize, turned: usize) -> Self {
        let rotation = Rotation { unknown: Some(turned), drives: Vec::new() };
        Self { base: Base::Master(x), arms: Vec::new(), rotation }
    }
}

fn default<T: Default>() -> T {
    T::default()
}
