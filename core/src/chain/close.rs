//! A chain that closes while it runs.

use super::pose::Pose;
use super::solve::{Factors, solve_pair};
use super::{Chain, ChainState};
use crate::math::{Complex, Scalar};

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
        let free = &self.closed;
        let pose = self.pose_of(state);
        let moves: [[T; 2]; C] = self.model.tip_moves(&pose);
        let mut velocity = [T::ZERO; 2];
        for (moved, rate) in moves.iter().zip(state.rate.as_flattened()) {
            velocity = [velocity[0] + moved[0] * *rate, velocity[1] + moved[1] * *rate];
        }
        let factors =
            Factors::new(&self.model.mass::<C, false>(&pose).matrix, &[Complex::ZERO; C], free);
        let solved: [[Complex<T>; C]; 2] = core::array::from_fn(|axis| {
            let right = core::array::from_fn(|i| {
                Complex::new(if free[i] { moves[i][axis] } else { T::ZERO }, T::ZERO)
            });
            factors.solve(&right, free)
        });
        let mut matrix = [[Complex::ZERO; 2]; 2];
        for a in 0..2 {
            for b in 0..2 {
                for i in 0..C {
                    let g = if free[i] { moves[i][a] } else { T::ZERO };
                    matrix[a][b] = matrix[a][b] + solved[b][i].scaled(g);
                }
            }
        }
        let impulse = solve_pair(matrix, velocity.map(|v| Complex::new(v, T::ZERO)));
        for (i, rate) in state.rate.as_flattened_mut().iter_mut().enumerate().take(C) {
            *rate -= solved[0][i].re * impulse[0].re + solved[1][i].re * impulse[1].re;
        }
        for j in 0..LINKS {
            state.joints[j].rate = state.rate[j][0];
        }
        state.pin = Some(self.model.places(&pose)[LINKS - 1]);
        state.force = [T::ZERO; 2];
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
