//! The mass matrix, from composites that run from the tip to the base.

use super::Model;
use super::along::over_points;
use super::pose::{Pose, Vector, cross, normal, plus};
use crate::math::{Scalar, array};

/// Mass matrix of all coordinates, joints included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mass<T, const C: usize> {
    /// Lower triangle, `matrix[i][p]` for `p ≤ i`. Coordinate `k` of link `j` is `jW + k`.
    pub matrix: [[T; C]; C],
}

impl<T: Scalar, const C: usize> Mass<T, C> {
    /// Room for a matrix.
    pub const NONE: Self = Self { matrix: [[T::ZERO; C]; C] };
}

/// Momentum of all beyond a place per unit rate of a coordinate, and its moment about that place.
#[derive(Clone, Copy, Debug)]
struct Column<T> {
    momentum: Vector<T>,
    moment: T,
}

/// All beyond a place if it turned about it as one: first moment of mass about the place and
/// inertia.
#[derive(Clone, Copy, Debug)]
struct Composite<T> {
    first: Vector<T>,
    inertia: T,
}

impl<T: Scalar, const LINKS: usize, const W: usize, const Q: usize> Model<T, LINKS, W, Q> {
    /// Mass matrix for that pose.
    #[inline(always)]
    pub(super) fn mass<const C: usize, const WHOLE: bool>(
        &self,
        pose: &[Pose<T, Q>; LINKS],
    ) -> Mass<T, C> {
        let mut mass = Mass::NONE;
        self.write_mass::<C, WHOLE>(pose, &mut mass);
        mass
    }

    /// Writes the lower triangle for that pose. Returns, with `WHOLE`, the first moment of all mass
    /// about the first joint, kg m.
    #[inline(never)]
    pub(super) fn write_mass<const C: usize, const WHOLE: bool>(
        &self,
        pose: &[Pose<T, Q>; LINKS],
        mass: &mut Mass<T, C>,
    ) -> Vector<T> {
        const { assert!(C == LINKS * W, "a coordinate a joint and curvature") }
        let mut columns = [Column { momentum: [T::ZERO; 2], moment: T::ZERO }; C];
        let mut beyond = self.load_composite(&pose[LINKS - 1]);
        for j in (0..LINKS).rev() {
            if j + 1 < LINKS {
                beyond.inertia += self.links[j].stator;
            }
            self.past_offset(j, &pose[j], &mut beyond, &mut columns);
            self.past_link::<C, WHOLE>(j, &pose[j], &mut beyond, &mut columns, mass);
        }
        beyond.first
    }

    /// The payload about the chain's end.
    #[inline(always)]
    fn load_composite(&self, pose: &Pose<T, Q>) -> Composite<T> {
        let load = &self.load;
        let arm = load.mass * load.offset;
        Composite {
            first: [arm * pose.end[0], arm * pose.end[1]],
            inertia: load.inertia + arm * load.offset,
        }
    }

    /// From the next joint, or the tip, to the end of the strip.
    #[inline(always)]
    fn past_offset<const C: usize>(
        &self,
        j: usize,
        pose: &Pose<T, Q>,
        beyond: &mut Composite<T>,
        columns: &mut [Column<T>; C],
    ) {
        let (body, t) = (&self.links[j], pose.end);
        let e = body.offset;
        if e == T::ZERO {
            return;
        }
        let outer = body.mass_beyond - body.mass;
        let along = t[0] * beyond.first[0] + t[1] * beyond.first[1];
        beyond.inertia += e * (T::TWO * along + outer * e);
        beyond.first = plus(beyond.first, outer * e, t);
        for column in columns.iter_mut().skip((j + 1) * W) {
            column.moment += e * cross(t, column.momentum);
        }
    }

    /// From the end of the strip to the link's joint: the rows of its own coordinates.
    #[inline(always)]
    fn past_link<const C: usize, const WHOLE: bool>(
        &self,
        j: usize,
        pose: &Pose<T, Q>,
        beyond: &mut Composite<T>,
        columns: &mut [Column<T>; C],
        mass: &mut Mass<T, C>,
    ) {
        let body = &self.links[j];
        let mut own = self.own(j, pose, beyond);
        if j + 1 < LINKS {
            self.couple(j, pose, columns, mass);
        }
        // Of the first link only what its hub's radius and the whole chain need.
        if j > 0 || WHOLE || body.radius != T::ZERO {
            let momenta = self.momenta(j, pose, beyond);
            if body.radius != T::ZERO {
                let n = normal(pose.base);
                let push = |k: usize| momenta[k][0] * n[0] + momenta[k][1] * n[1];
                own[0][0] += body.radius * (T::TWO * push(0) - body.mass_beyond * body.radius);
                for k in 1..W {
                    own[k][0] += body.radius * push(k);
                }
            }
            for k in 0..W {
                columns[j * W + k].momentum = momenta[k];
            }
            beyond.first = [momenta[0][1], -momenta[0][0]];
        }
        own[0][0] += body.hub;
        for k in 0..W {
            columns[j * W + k].moment = own[k][0];
            for p in 0..=k {
                mass.matrix[j * W + k][j * W + p] = own[k][p];
            }
        }
        // What turns with the joint as one has the joint's own column.
        beyond.inertia = own[0][0];
    }

    /// Rows of all coordinates beyond the link in the columns of its own.
    #[inline(always)]
    fn couple<const C: usize>(
        &self,
        j: usize,
        pose: &Pose<T, Q>,
        columns: &mut [Column<T>; C],
        mass: &mut Mass<T, C>,
    ) {
        let body = &self.links[j];
        let mut moves = pose.normals::<W>(&body.lengths);
        if body.radius != T::ZERO {
            moves[0] = plus(moves[0], body.radius, normal(pose.base));
        }
        for i in (j + 1) * W..C {
            let Column { momentum, moment } = columns[i];
            for k in 0..W {
                let mut entry = moves[k][0] * momentum[0] + moves[k][1] * momentum[1];
                // The joint and the first coordinate turn the link's end.
                if k <= 1 {
                    entry += moment;
                }
                mass.matrix[i][j * W + k] = entry;
            }
            // About the link's joint: the moment of a column is its row of that joint.
            columns[i].moment = mass.matrix[i][j * W];
        }
    }

    /// Lower triangle of the link's own coordinates about its clamp.
    #[inline(always)]
    fn own(&self, j: usize, pose: &Pose<T, Q>, beyond: &Composite<T>) -> [[T; W]; W] {
        let (body, t) = (&self.links[j], &pose.tangents);
        let mut kernel = body.second_beyond;
        for q in 0..Q {
            for p in 0..q {
                let cos = t[q][0] * t[p][0] + t[q][1] * t[p][1];
                kernel[q][p] = kernel[q][p] * cos;
                kernel[p][q] = kernel[q][p];
            }
        }
        let mut levers = [T::ZERO; W];
        // A payload at the end of the last link has no lever.
        if j + 1 < LINKS || self.load.offset != T::ZERO {
            levers = over_points(&array::<T, Q, _>(|q| {
                body.lengths[q] * (t[q][0] * beyond.first[0] + t[q][1] * beyond.first[1])
            }));
        }
        let rows: [[T; W]; Q] = array(|q| over_points(&kernel[q]));
        let mut own = [[T::ZERO; W]; W];
        for p in 0..W {
            let column: [T; W] = over_points::<T, W, Q>(&array(|q| rows[q][p]));
            for k in p..W {
                own[k][p] = column[k];
            }
        }
        own[0][0] = own[0][0] + T::TWO * levers[0] + beyond.inertia;
        own[1][0] = own[1][0] + levers[0] + levers[1] + beyond.inertia;
        own[1][1] = own[1][1] + T::TWO * levers[1] + beyond.inertia;
        for k in 2..W {
            own[k][0] += levers[k];
            own[k][1] += levers[k];
        }
        own
    }

    /// Momentum of link and all beyond per unit rate of each of its coordinates.
    #[inline(always)]
    fn momenta(&self, j: usize, pose: &Pose<T, Q>, beyond: &Composite<T>) -> [Vector<T>; W] {
        let body = &self.links[j];
        let mut momenta = pose.normals::<W>(&body.first_beyond);
        for k in 0..2 {
            momenta[k] = plus(momenta[k], T::ONE, normal(beyond.first));
        }
        if body.radius != T::ZERO {
            momenta[0] = plus(momenta[0], body.mass_beyond * body.radius, normal(pose.base));
        }
        momenta
    }
}
