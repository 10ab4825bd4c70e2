//! One link of a chain with all that does not change while it moves.

use super::quadrature::Rule;
use crate::math::{Each, Scalar, array};
use crate::mechanism::Mechanism;

/// Constants of link `j`.
///
/// `W` coordinates: the joint's angle, then those of the link's curvature. `Q` Gauss points. Places
/// along the link are sums over the tangents at these points, and so are its moments of mass.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body<T, const W: usize, const Q: usize> {
    /// `L w_q`, m.
    pub lengths: [T; Q],
    /// First moment of the link's own mass, kg m, and with all mass beyond the link at its end.
    pub first: [T; Q],
    pub first_beyond: [T; Q],
    /// Second moment of the link's own mass, kg m².
    pub second: [[T; Q]; Q],
    /// Second moment with all mass beyond the link at its end.
    pub second_beyond: [[T; Q]; Q],
    /// `EI/L/(2k − 1)`, N m/rad; 0 for the joint.
    pub stiffness: [T; W],
    /// Mass of the link, and of it with all beyond, kg.
    pub mass: T,
    pub mass_beyond: T,
    /// `r`, joint to clamp, m.
    pub radius: T,
    /// `e`, end of the strip to the next joint, m.
    pub offset: T,
    /// Inertia of the joint's hub, kg m².
    pub hub: T,
    /// Inertia of the next joint's stator, kg m².
    pub stator: T,
    /// Mass of the next joint, at the end, kg.
    pub joint: T,
}

impl<const W: usize, const Q: usize> Body<f64, W, Q> {
    /// Link `j` of `mechanism`, with `outer` kg beyond its end.
    pub fn new(mechanism: &Mechanism, j: usize, outer: f64) -> Self {
        let rule = Rule::<W, Q>::new();
        let (link, joint) = (&mechanism.links[j], &mechanism.joints[j]);
        let (next_mass, stator) =
            mechanism.joints.get(j + 1).map_or((0.0, 0.0), |next| (next.mass, next.stator_inertia));
        let (l, m, outer) = (link.length, link.mass, outer + next_mass);
        let lengths = rule.weights.each(|weight| l * weight);
        let first = rule.first.each(|moment| m * l * moment);
        let second = rule.second.each(|row| row.each(|moment| m * l * l * moment));
        let bending = link.bending_stiffness() / l;
        Self {
            first_beyond: array(|q| first[q] + outer * lengths[q]),
            second_beyond: array(|q| array(|p| second[q][p] + outer * lengths[q] * lengths[p])),
            lengths,
            first,
            second,
            stiffness: array(|k| if k == 0 { 0.0 } else { bending / (2 * k - 1) as f64 }),
            mass: m,
            mass_beyond: m + outer,
            radius: joint.radius,
            offset: link.tip_offset,
            hub: joint.inertia,
            stator,
            joint: next_mass,
        }
    }
}

impl<T: Scalar, const W: usize, const Q: usize> Body<T, W, Q> {
    /// Rounds to another precision.
    pub fn cast<U: Scalar>(&self) -> Body<U, W, Q> {
        let f = |x: T| U::from_f64(x.to_f64());
        Body {
            lengths: self.lengths.each(f),
            first: self.first.each(f),
            second: self.second.each(|row| row.each(f)),
            first_beyond: self.first_beyond.each(f),
            second_beyond: self.second_beyond.each(|row| row.each(f)),
            stiffness: self.stiffness.each(f),
            mass: f(self.mass),
            mass_beyond: f(self.mass_beyond),
            radius: f(self.radius),
            offset: f(self.offset),
            hub: f(self.hub),
            stator: f(self.stator),
            joint: f(self.joint),
        }
    }
}

/// The payload at the chain's end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Load<T> {
    pub mass: T,
    pub inertia: T,
    /// End of the chain to the payload's centre along the tangent, m.
    pub offset: T,
}

impl<T: Scalar> Load<T> {
    /// Rounds to another precision.
    pub fn cast<U: Scalar>(&self) -> Load<U> {
        let f = |x: T| U::from_f64(x.to_f64());
        Load { mass: f(self.mass), inertia: f(self.inertia), offset: f(self.offset) }
    }
}
