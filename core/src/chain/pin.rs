//! The pin of a closed chain: two forces that keep its end in place.

use super::pose::{Pose, Vector, plus};
use super::solve::{Factors, solve_pair};
use super::stages::Stages;
use super::{Chain, Model};
use crate::math::{Complex, Scalar};

/// The stage equations' answer to forces at the chain's end: a Schur complement on their factors.
pub(super) struct Pinned<T, const C: usize> {
    /// How far each coordinate moves the end, m per unit, in the global frame.
    moves: [Vector<T>; C],
    /// The same in rows, 0 for what is commanded.
    rows: [[T; C]; 2],
    /// Answer of the coordinates to a unit force along each axis.
    answers: [[Complex<T>; C]; 2],
    /// Answer of the end.
    end: [[Complex<T>; 2]; 2],
}

impl<T: Scalar, const C: usize> Pinned<T, C> {
    #[inline(always)]
    pub fn new(factors: &Factors<T, C>, moves: [Vector<T>; C], free: &[bool; C]) -> Self {
        let mut rows = [[T::ZERO; C]; 2];
        for i in 0..C {
            if free[i] {
                (rows[0][i], rows[1][i]) = (moves[i][0], moves[i][1]);
            }
        }
        let right = |row: &[T; C]| row.map(|entry| Complex::new(entry, T::ZERO));
        let answers =
            [factors.solve(&right(&rows[0]), free), factors.solve(&right(&rows[1]), free)];
        let mut end = [[Complex::ZERO; 2]; 2];
        for a in 0..2 {
            for b in 0..2 {
                end[a][b] = project(&rows[a], &answers[b]);
            }
        }
        Self { moves, rows, answers, end }
    }

    /// Adds what the end's force takes of the motors' torques.
    #[inline(always)]
    pub fn torques<const LINKS: usize>(
        &self,
        torques: [T; LINKS],
        pushed: &Vector<T>,
        free: &[bool; C],
    ) -> [T; LINKS] {
        let mut torques = torques;
        let per_link = C / LINKS;
        for j in 0..LINKS {
            let i = j * per_link;
            if i < C && !free[i] {
                let [x, y] = self.moves[i];
                torques[j] -= x * pushed[0] + y * pushed[1];
            }
        }
        torques
    }
}

#[inline(always)]
fn project<T: Scalar, const C: usize>(row: &[T; C], x: &[Complex<T>; C]) -> Complex<T> {
    let mut sum = Complex::ZERO;
    for i in 0..C {
        sum = sum + x[i].scaled(row[i]);
    }
    sum
}

impl<T, const LINKS: usize, const W: usize, const C: usize, const Q: usize> Chain<T, LINKS, W, C, Q>
where
    T: Scalar,
{
    /// By how much each stage misses `ẋ + (x − pin)/h = 0` at the chain's end, m/s. Its own place
    /// is in it, so that the end does not drift.
    #[inline(always)]
    pub(super) fn missed(
        &self,
        poses: &[[Pose<T, Q>; LINKS]; 2],
        stages: &Stages<T, LINKS, W>,
        pin: Vector<T>,
    ) -> [Vector<T>; 2] {
        let per_tick = self.weights.per_tick;
        core::array::from_fn(|stage| {
            let (tip, velocity) = self.model.tip_motion(&poses[stage], &stages.v[stage]);
            plus(velocity, per_tick, [tip[0] - pin[0], tip[1] - pin[1]])
        })
    }

    /// Changes `y` such that the end keeps to its pin, and returns the change of the pin's force in
    /// both stages.
    #[inline(always)]
    pub(super) fn hold_pin(
        &self,
        pinned: &Pinned<T, C>,
        missed: &[Vector<T>; 2],
        y: &mut [Complex<T>; C],
    ) -> [Vector<T>; 2] {
        let right = core::array::from_fn(|axis| {
            let condition = self.weights.forward(missed[0][axis], missed[1][axis]);
            self.weights.pin * condition - project(&pinned.rows[axis], y)
        });
        let pushed = solve_pair(pinned.end, right);
        for i in 0..C {
            let [x, z] = [pinned.answers[0][i] * pushed[0], pinned.answers[1][i] * pushed[1]];
            y[i] = y[i] + x + z;
        }
        // Per unit of force the equations were divided by 1 + hαλ.
        let force = pushed.map(|push| self.weights.back(push * self.weights.undamped));
        [[force[0][0], force[1][0]], [force[0][1], force[1][1]]]
    }
}

impl<T: Scalar, const LINKS: usize, const W: usize, const Q: usize> Model<T, LINKS, W, Q> {
    /// Place and velocity of the chain's end in the global frame.
    #[inline(always)]
    fn tip_motion(
        &self,
        pose: &[Pose<T, Q>; LINKS],
        rate: &[[T; W]; LINKS],
    ) -> (Vector<T>, Vector<T>) {
        let zero = [T::ZERO; 2];
        let (mut place, mut velocity, mut frame) = (zero, zero, [T::ONE, T::ZERO]);
        let mut omega = T::ZERO;
        for j in 0..LINKS {
            frame = super::pose::turned(frame, pose[j].frame);
            omega += rate[j][0];
            let body = &self.links[j];
            let (mut reach, mut moves) = ([body.radius, T::ZERO], [T::ZERO, body.radius * omega]);
            for q in 0..Q {
                let [cos, sin] = pose[j].tangents[q];
                let mut rate_here = omega;
                for k in 1..W {
                    rate_here += body.slopes[q][k] * rate[j][k];
                }
                reach = plus(reach, body.lengths[q], [cos, sin]);
                moves = plus(moves, body.lengths[q] * rate_here, [-sin, cos]);
            }
            omega += rate[j][1];
            if body.offset != T::ZERO {
                let [cos, sin] = pose[j].end;
                reach = plus(reach, body.offset, [cos, sin]);
                moves = plus(moves, body.offset * omega, [-sin, cos]);
            }
            place = plus(place, T::ONE, super::pose::turned(frame, reach));
            velocity = plus(velocity, T::ONE, super::pose::turned(frame, moves));
        }
        (place, velocity)
    }
}
