//! A chain that closes while it runs.

use super::pose::Pose;
use super::solve::{Factors, solve_pair};
use super::{Chain, ChainState};
use crate::math::{Complex, Scalar};

/// The end's answer to forces on it, by the inertia of all coordinates that are free.
struct EndAnswer<T, const C: usize> {
    /// Displacement of the end per unit of each coordinate, m.
    moves: [[T; 2]; C],
    /// Acceleration of the coordinates per unit force along each axis.
    answers: [[Complex<T>; C]; 2],
    /// Acceleration of the end, `GM⁻¹Gᵀ`, 1/kg.
    matrix: [[Complex<T>; 2]; 2],
}

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Chain<T, LINKS, W, C, Q>
{
    /// Tick at which the chain closes, counted from the first one, which is 0.
    pub fn closes_at(&self) -> Option<u32> {
        self.closes
    }

    /// Closes the chain on a pin where its end is now; the joints that let go turn freely from now
    /// on. The end stops in a plastic impact: the rates jump by
    /// `−M⁻¹Gᵀ(GM⁻¹Gᵀ)⁻¹ẋ`, `G` the end's displacement per unit of the free coordinates, `ẋ` its
    /// velocity. Accelerations stay those of the latest tick, from which the next one guesses.
    #[inline(never)]
    pub fn close(&self, state: &mut ChainState<T, LINKS, W>) {
        let end = self.end_answer(state);
        let mut velocity = [T::ZERO; 2];
        for (moved, rate) in end.moves.iter().zip(state.rate.as_flattened()) {
            velocity = [velocity[0] + moved[0] * *rate, velocity[1] + moved[1] * *rate];
        }
        let impulse = solve_pair(end.matrix, velocity.map(|v| Complex::new(v, T::ZERO)));
        let [x, y] = &end.answers;
        for (i, rate) in state.rate.as_flattened_mut().iter_mut().enumerate().take(C) {
            *rate -= x[i].re * impulse[0].re + y[i].re * impulse[1].re;
        }
        for j in 0..LINKS {
            state.joints[j].rate = state.rate[j][0];
        }
        state.pin = Some(self.model.places(&self.pose_of(state))[LINKS - 1]);
        state.force = [T::ZERO; 2];
    }

    /// The end of the closed chain in the place where it is now.
    fn end_answer(&self, state: &ChainState<T, LINKS, W>) -> EndAnswer<T, C> {
        let free = &self.closed;
        let pose = self.pose_of(state);
        let moves: [[T; 2]; C] = self.model.tip_moves(&pose);
        let mass = self.model.mass::<C, false>(&pose);
        let factors = Factors::new(&mass.matrix, &[Complex::ZERO; C], free);
        let row = |axis: usize, i: usize| if free[i] { moves[i][axis] } else { T::ZERO };
        let answers: [[Complex<T>; C]; 2] = core::array::from_fn(|axis| {
            let right = core::array::from_fn(|i| Complex::new(row(axis, i), T::ZERO));
            factors.solve(&right, free)
        });
        let mut matrix = [[Complex::ZERO; 2]; 2];
        for a in 0..2 {
            for b in 0..2 {
                for i in 0..C {
                    matrix[a][b] = matrix[a][b] + answers[b][i].scaled(row(a, i));
                }
            }
        }
        EndAnswer { moves, answers, matrix }
    }

    /// Least over greatest of the accelerations that a force of 1 N gives the end of the closed
    /// chain: 0 where the links lie in one line, along which no force moves it.
    pub(super) fn mobility(&self, state: &ChainState<T, LINKS, W>) -> f64 {
        let [[a, b], [_, c]] =
            self.end_answer(state).matrix.map(|row| row.map(|entry| entry.re.to_f64()));
        let mean = 0.5 * (a + c);
        let spread = crate::math::sqrt(0.25 * (a - c) * (a - c) + b * b);
        (mean - spread) / (mean + spread)
    }

    /// Directions of all links in a state.
    #[inline(always)]
    pub(super) fn pose_of(&self, state: &ChainState<T, LINKS, W>) -> [Pose<T, Q>; LINKS] {
        let mut coordinates = state.shape;
        for j in 0..LINKS {
            coordinates[j][0] = state.joints[j].angle.part;
        }
        self.model.pose(&coordinates)
    }
}
