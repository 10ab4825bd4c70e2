//! The shape of a chain at one instant: directions and places in the global frame.

use super::along::{at_points, over_points};
use super::{Body, Model};
use crate::math::{Scalar, array};

/// A vector of the plane.
pub(super) type Vector<T> = [T; 2];

/// Returns `v` turned back by the angle whose cosine and sine are `by`.
#[inline(always)]
pub(super) fn turned_back<T: Scalar>(by: Vector<T>, v: Vector<T>) -> Vector<T> {
    [by[0] * v[0] + by[1] * v[1], by[0] * v[1] - by[1] * v[0]]
}

/// `a × b`.
#[inline(always)]
pub(super) fn cross<T: Scalar>(a: Vector<T>, b: Vector<T>) -> T {
    a[0] * b[1] - a[1] * b[0]
}

/// `a + s b`.
#[inline(always)]
pub(super) fn plus<T: Scalar>(a: Vector<T>, s: T, b: Vector<T>) -> Vector<T> {
    [a[0] + s * b[0], a[1] + s * b[1]]
}

/// `t` turned by a right angle.
#[inline(always)]
pub(super) fn normal<T: Scalar>(t: Vector<T>) -> Vector<T> {
    [-t[1], t[0]]
}

/// Directions of one link, as cosine and sine in the global frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose<T, const Q: usize> {
    /// Tangent at the clamp, if the clamp is beside the axis; else that of the global frame.
    pub base: Vector<T>,
    /// Tangents at the points.
    pub tangents: [Vector<T>; Q],
    /// Tangent at the end, where something sticks out there; else that of the global frame.
    pub end: Vector<T>,
}

impl<T: Scalar, const Q: usize> Pose<T, Q> {
    /// Sums over the points of `factor[q] ψ_k(ξ_q) n_q` for every coordinate `k`, `n` the normals.
    #[inline(always)]
    pub fn normals<const W: usize>(&self, factor: &[T; Q]) -> [Vector<T>; W] {
        let part = |axis: usize| -> [T; Q] { array(|q| factor[q] * self.tangents[q][axis]) };
        let [along_x, along_y] = [0, 1].map(|axis| over_points::<T, W, Q>(&part(axis)));
        array(|k| [-along_y[k], along_x[k]])
    }
}

impl<T: Scalar, const LINKS: usize, const W: usize, const Q: usize> Model<T, LINKS, W, Q> {
    /// Directions of all links. In `coordinates` the joints' angles are in turns, `|x| ≤ 300`, the
    /// others in rad.
    #[inline(never)]
    pub(super) fn pose(&self, coordinates: &[[T; W]; LINKS]) -> [Pose<T, Q>; LINKS] {
        let ahead = [T::ONE, T::ZERO];
        let mut pose = [Pose { base: ahead, tangents: [ahead; Q], end: ahead }; LINKS];
        let mut angle = T::ZERO;
        for j in 0..LINKS {
            let turns: [T; W] = array(|k| self.turns * coordinates[j][k]);
            angle += coordinates[j][0];
            if self.links[j].radius != T::ZERO {
                pose[j].base = direction(angle);
            }
            let slopes = at_points::<T, W, Q>(angle, &turns);
            for q in 0..Q {
                pose[j].tangents[q] = direction(slopes[q]);
            }
            angle += turns[1];
            if self.sticks_out(j) {
                pose[j].end = direction(angle);
            }
        }
        pose
    }

    /// True if something sticks out of the end of link `j`: the next joint, or the payload.
    #[inline(always)]
    pub(super) fn sticks_out(&self, j: usize) -> bool {
        self.links[j].offset != T::ZERO || (j + 1 == LINKS && self.load.offset != T::ZERO)
    }

    /// How far each coordinate moves the tip, in the global frame, m per unit.
    #[inline(never)]
    pub(super) fn tip_moves(&self, pose: &[Pose<T, Q>; LINKS]) -> [[Vector<T>; W]; LINKS] {
        let mut moves = [[[T::ZERO; 2]; W]; LINKS];
        let mut to_tip = [T::ZERO; 2];
        for j in (0..LINKS).rev() {
            let (body, pose) = (&self.links[j], &pose[j]);
            if body.offset != T::ZERO {
                to_tip = plus(to_tip, body.offset, pose.end);
            }
            let mut own = pose.normals::<W>(&body.lengths);
            // The joint and the first coordinate turn the link's end.
            own[0] = plus(own[0], T::ONE, normal(to_tip));
            own[1] = plus(own[1], T::ONE, normal(to_tip));
            if body.radius != T::ZERO {
                own[0] = plus(own[0], body.radius, normal(pose.base));
            }
            to_tip = [own[0][1], -own[0][0]];
            moves[j] = own;
        }
        moves
    }
}

impl<T: Scalar, const W: usize, const Q: usize> Body<T, W, Q> {
    /// From a link's joint to its end, the next joint or the tip, in the global frame.
    #[inline(always)]
    pub fn reach(&self, pose: &Pose<T, Q>) -> Vector<T> {
        self.reach_along(|| pose.base, |q| pose.tangents[q], || pose.end)
    }

    /// The same along other directions: of the clamp, at the points, and of the end.
    #[inline(always)]
    pub fn reach_along(
        &self,
        base: impl FnOnce() -> Vector<T>,
        tangent: impl Fn(usize) -> Vector<T>,
        end: impl FnOnce() -> Vector<T>,
    ) -> Vector<T> {
        let mut reach = [T::ZERO; 2];
        for q in 0..Q {
            reach = plus(reach, self.lengths[q], tangent(q));
        }
        if self.radius != T::ZERO {
            reach = plus(reach, self.radius, base());
        }
        if self.offset != T::ZERO { plus(reach, self.offset, end()) } else { reach }
    }
}

/// Cosine and sine of an angle in turns.
#[inline(always)]
pub(super) fn direction<T: Scalar>(turns: T) -> Vector<T> {
    let (sin, cos) = turns.sin_cos_turns();
    [cos, sin]
}
