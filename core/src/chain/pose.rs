//! The shape of a chain at one instant: directions, in each link's own frame, and places.

use super::Model;
use crate::math::Scalar;

/// A vector of the plane.
pub(super) type Vector<T> = [T; 2];

/// Returns `v` turned by the angle whose cosine and sine are `by`.
#[inline(always)]
pub(super) fn turned<T: Scalar>(by: Vector<T>, v: Vector<T>) -> Vector<T> {
    [by[0] * v[0] - by[1] * v[1], by[1] * v[0] + by[0] * v[1]]
}

/// Returns `v` turned back by that angle.
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

/// Directions of one link, as cosine and sine in its own frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose<T, const Q: usize> {
    /// The frame against that of the link before, of the first one against the global frame.
    pub frame: Vector<T>,
    /// Tangents at the points.
    pub tangents: [Vector<T>; Q],
    /// Tangent at the end, where something sticks out there; else that of a straight link.
    pub end: Vector<T>,
}

impl<T: Scalar, const LINKS: usize, const W: usize, const Q: usize> Model<T, LINKS, W, Q> {
    /// Directions of all links. In `coordinates` the joints' angles are in turns, `|x| ≤ 500`, the
    /// others in rad.
    #[inline(never)]
    pub(super) fn pose(&self, coordinates: &[[T; W]; LINKS]) -> [Pose<T, Q>; LINKS] {
        let mut pose = [Pose {
            frame: [T::ONE, T::ZERO],
            tangents: [[T::ONE, T::ZERO]; Q],
            end: [T::ONE, T::ZERO],
        }; LINKS];
        let mut before = T::ZERO;
        for j in 0..LINKS {
            let turns: [T; W] = core::array::from_fn(|k| self.turns * coordinates[j][k]);
            pose[j].frame = direction(before + coordinates[j][0]);
            for q in 0..Q {
                let slopes = &self.links[j].slopes[q];
                let mut slope = slopes[1] * turns[1];
                for k in 2..W {
                    slope += slopes[k] * turns[k];
                }
                pose[j].tangents[q] = direction(slope);
            }
            before = turns[1];
            if self.sticks_out(j) {
                pose[j].end = direction(before);
            }
        }
        pose
    }

    /// True if something sticks out of the end of link `j`: the next joint, or the payload.
    #[inline(always)]
    pub(super) fn sticks_out(&self, j: usize) -> bool {
        self.links[j].offset != T::ZERO || (j + 1 == LINKS && self.load.offset != T::ZERO)
    }

    /// From a link's joint to its end, the next joint or the tip, in its own frame.
    #[inline(always)]
    pub(super) fn reach(&self, j: usize, pose: &Pose<T, Q>) -> Vector<T> {
        let body = &self.links[j];
        let mut reach = [body.radius, T::ZERO];
        for q in 0..Q {
            reach = plus(reach, body.lengths[q], pose.tangents[q]);
        }
        if body.offset != T::ZERO { plus(reach, body.offset, pose.end) } else { reach }
    }

    /// Places of the end of every link in the global frame, m, the last one the tip.
    #[inline(always)]
    pub(super) fn places(&self, pose: &[Pose<T, Q>; LINKS]) -> [Vector<T>; LINKS] {
        let mut places = [[T::ZERO; 2]; LINKS];
        let mut frame = [T::ONE, T::ZERO];
        let mut place = [T::ZERO; 2];
        for j in 0..LINKS {
            frame = turned(frame, pose[j].frame);
            place = plus(place, T::ONE, turned(frame, self.reach(j, &pose[j])));
            places[j] = place;
        }
        places
    }
}

#[inline(always)]
fn direction<T: Scalar>(turns: T) -> Vector<T> {
    let (sin, cos) = turns.sin_cos_turns();
    [cos, sin]
}

impl<T: Scalar, const LINKS: usize, const W: usize, const Q: usize> Model<T, LINKS, W, Q> {
    /// How far each coordinate moves the tip, in the global frame, m per unit.
    #[inline(never)]
    pub(super) fn tip_moves<const C: usize>(&self, pose: &[Pose<T, Q>; LINKS]) -> [Vector<T>; C] {
        let mut moves = [[T::ZERO; 2]; C];
        let mut to_tip = [T::ZERO; 2];
        for j in (0..LINKS).rev() {
            let body = &self.links[j];
            if body.offset != T::ZERO {
                to_tip = plus(to_tip, body.offset, pose[j].end);
            }
            for k in 0..W {
                let mut own = if k <= 1 { [-to_tip[1], to_tip[0]] } else { [T::ZERO; 2] };
                for q in 0..Q {
                    let [cos, sin] = pose[j].tangents[q];
                    own = plus(own, body.length_slopes[q][k], [-sin, cos]);
                }
                moves[j * W + k] = own;
            }
            moves[j * W][1] += body.radius;
            to_tip = [moves[j * W][1], -moves[j * W][0]];
            to_tip = turned(pose[j].frame, to_tip);
            for tip in moves.iter_mut().skip(j * W) {
                *tip = turned(pose[j].frame, *tip);
            }
        }
        moves
    }
}
