//! The pin of a closed chain: two forces that keep its end in place.

use super::along::at_points;
use super::factors::{Factors, Values};
use super::pose::{Pose, Vector, normal, plus};
use super::solve::solve_pair;
use super::stages::{Slots, Stages};
use super::{Chain, Model};
use crate::math::{Complex, Each, Scalar, array};

/// A right side of the stage equations and the answer to forces at the chain's end: a Schur
/// complement on their factors `LDLᵀ`.
pub(super) struct Pinned<T, const LINKS: usize, const W: usize> {
    /// How far each coordinate moves the end, m per unit, in the global frame: `G`.
    moves: [[Vector<T>; W]; LINKS],
    /// `D⁻¹L⁻¹` of `Gᵀ`, of each axis, and of the right side.
    answers: [Values<T, LINKS, W>; 3],
    /// `G(LDLᵀ)⁻¹Gᵀ`, entries xx, xy and yy.
    pub end: [Complex<T>; 3],
    /// Way of the end by the right side.
    moved: [Complex<T>; 2],
}

impl<T: Scalar, const LINKS: usize, const W: usize> Pinned<T, LINKS, W> {
    #[inline(always)]
    pub fn new(
        factors: &Factors<T, LINKS, W>,
        moves: [[Vector<T>; W]; LINKS],
        right: &Values<T, LINKS, W>,
    ) -> Self {
        let side = |axis: usize| -> Values<T, LINKS, W> {
            core::array::from_fn(|j| {
                core::array::from_fn(|k| Complex::new(moves[j][k][axis], T::ZERO))
            })
        };
        let mut sides = [side(0), side(1), *right];
        factors.forward(&mut sides);
        let (mut end, mut moved) = ([Complex::ZERO; 3], [Complex::ZERO; 2]);
        for j in 0..LINKS {
            for k in 0..W {
                let inverse = factors.inverse()[j][k];
                let [x, y, right] = [sides[0][j][k], sides[1][j][k], sides[2][j][k]];
                let [answer_x, answer_y] = [x * inverse, y * inverse];
                end = [end[0] + answer_x * x, end[1] + answer_x * y, end[2] + answer_y * y];
                moved = [moved[0] + answer_x * right, moved[1] + answer_y * right];
                (sides[0][j][k], sides[1][j][k]) = (answer_x, answer_y);
                sides[2][j][k] = right * inverse;
            }
        }
        Self { moves, answers: sides, end, moved }
    }

    /// Solves with two forces at the end such that it moves by `to`. Returns the solution and the
    /// forces.
    #[inline(always)]
    pub fn solve(
        &self,
        factors: &Factors<T, LINKS, W>,
        to: [Complex<T>; 2],
    ) -> (Values<T, LINKS, W>, [Complex<T>; 2]) {
        let missing = [to[0] - self.moved[0], to[1] - self.moved[1]];
        let pushed = solve_pair(self.end, missing);
        let [answers_x, answers_y, mut x] = self.answers;
        for j in 0..LINKS {
            for k in 0..W {
                x[j][k] = x[j][k] + (answers_x[j][k] * pushed[0] + answers_y[j][k] * pushed[1]);
            }
        }
        factors.backward(&mut x);
        (x, pushed)
    }

    /// Velocity of the end at those rates.
    pub fn velocity(&self, rate: &Slots<T, LINKS, W>) -> Vector<T> {
        let mut velocity = [T::ZERO; 2];
        for j in 0..LINKS {
            for k in 0..W {
                velocity = plus(velocity, rate[j][k], self.moves[j][k]);
            }
        }
        velocity
    }

    /// Torque of joint `j` against a force at the end.
    #[inline(always)]
    pub fn torque(&self, j: usize, force: &Vector<T>) -> T {
        let [x, y] = self.moves[j][0];
        x * force[0] + y * force[1]
    }
}

impl<T, const LINKS: usize, const W: usize, const C: usize, const Q: usize> Chain<T, LINKS, W, C, Q>
where
    T: Scalar,
{
    /// By how much each stage misses `ẋ + (x − pin)/h = 0` at the chain's end, m/s, as the right
    /// side for the change of the accelerations. The end's own place is in it, so that it does not
    /// drift.
    #[inline(always)]
    pub(super) fn missed(
        &self,
        poses: &[[Pose<T, Q>; LINKS]; 2],
        stages: &Stages<T, LINKS, W>,
        pin: Vector<T>,
    ) -> [Complex<T>; 2] {
        let [first, second]: [Vector<T>; 2] = array(|stage| {
            let (tip, velocity) = self.model.tip_motion(&poses[stage], &stages.v[stage]);
            plus(velocity, self.weights.per_tick, [tip[0] - pin[0], tip[1] - pin[1]])
        });
        [0, 1].each(|axis| self.weights.pin * self.weights.forward(first[axis], second[axis]))
    }

    /// Change of the pin's force in both stages. Per unit of force the equations were divided by
    /// 1 + hαλ.
    #[inline(always)]
    pub(super) fn push(&self, pushed: [Complex<T>; 2]) -> [Vector<T>; 2] {
        let [x, y] = pushed.each(|push| self.weights.back(push * self.weights.undamped));
        [[x[0], y[0]], [x[1], y[1]]]
    }
}

impl<T: Scalar, const LINKS: usize, const W: usize, const Q: usize> Model<T, LINKS, W, Q> {
    /// Place and velocity of the chain's end.
    #[inline(never)]
    fn tip_motion(
        &self,
        pose: &[Pose<T, Q>; LINKS],
        rate: &[[T; W]; LINKS],
    ) -> (Vector<T>, Vector<T>) {
        let (mut place, mut velocity) = ([T::ZERO; 2], [T::ZERO; 2]);
        let mut omega = T::ZERO;
        for j in 0..LINKS {
            let (body, pose) = (&self.links[j], &pose[j]);
            omega += rate[j][0];
            place = plus(place, T::ONE, body.reach(pose));
            if body.radius != T::ZERO {
                velocity = plus(velocity, body.radius * omega, normal(pose.base));
            }
            let rates = at_points::<T, W, Q>(omega, &rate[j]);
            for q in 0..Q {
                velocity = plus(velocity, body.lengths[q] * rates[q], normal(pose.tangents[q]));
            }
            omega += rate[j][1];
            if body.offset != T::ZERO {
                velocity = plus(velocity, body.offset * omega, normal(pose.end));
            }
        }
        (place, velocity)
    }
}
