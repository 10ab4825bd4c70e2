//! One tick: Radau IIA with two stages, simplified Newton iterations on both stages at once.
//!
//! The stages lie at a third of the tick and at its end. With `A = [5/12, −1/12; 3/4, 1/4]` and the
//! stages' accelerations `k₁`, `k₂` as unknowns the rates are `v + hA k` and the coordinates
//! `q + hcv + h²A²k`. `A` has the eigenvalues `λ = ⅓ ± i/√18` with the eigenvectors
//! `(1, 1 ∓ 2√2 i)`. One of the conjugate pair is enough: with the residuals `R₁`, `R₂`
//!
//! `Z y = −R₁ + i(R₁ − R₂)/2√2`, `δk₁ = Re y`, `δk₂ = Re y + 2√2 Im y`,
//!
//! `Z = M(1 + hαλ) + K(hβλ + h²λ²)`, of which `M` is that of the tick's end as first guessed.

use super::mass::Mass;
use super::pin::Pinned;
use super::pose::{Pose, Vector, plus};
use super::solve::Factors;
use super::stages::{Slots, Stages};
use super::{Chain, ChainState, Command};
use crate::math::{Complex, Scalar};

/// Change of both stages' accelerations in an iteration.
pub(super) type Changes<T, const C: usize> = [[T; C]; 2];

impl<T, const LINKS: usize, const W: usize, const C: usize, const Q: usize> Chain<T, LINKS, W, C, Q>
where
    T: Scalar,
{
    /// Advances `state` by one tick in which the driven joints move as commanded. What is commanded
    /// of a joint that no motor turns is not looked at.
    #[inline(always)]
    pub fn step(&self, state: &mut ChainState<T, LINKS, W>, commands: &[Command<T>; LINKS]) {
        if let Some(pin) = state.pin {
            self.step_closed(state, commands, pin);
        } else {
            self.step_open(state, commands);
        }
    }

    #[inline(never)]
    fn step_open(&self, state: &mut ChainState<T, LINKS, W>, commands: &[Command<T>; LINKS]) {
        let free = &self.open;
        let mut stages = self.first_guess(state, commands, free);
        self.update(state, &mut stages, free);
        let poses = self.poses(&stages);
        let mass = self.model.mass::<C, false>(&poses[1]);
        let factors = Factors::new(&mass.matrix, &self.diagonal(), free);
        let residuals = self.residuals(&poses, &stages, None);
        let y = factors.solve(&self.right(&residuals, free), free);
        let changes = self.change(&mut stages, &y);
        state.torque = self.torques(&residuals[1], &mass, &changes, free);
        self.accept(state, commands, &stages, free);
    }

    #[inline(never)]
    fn step_closed(
        &self,
        state: &mut ChainState<T, LINKS, W>,
        commands: &[Command<T>; LINKS],
        pin: Vector<T>,
    ) {
        let free = &self.closed;
        let mut stages = self.first_guess(state, commands, free);
        self.update(state, &mut stages, free);
        let mut forces = [state.force; 2];
        for iteration in 0..ITERATIONS {
            if iteration > 0 {
                self.update(state, &mut stages, free);
            }
            // Anew in each iteration: the directions in which the pin acts turn with the links.
            let poses = self.poses(&stages);
            let mass = self.model.mass::<C, false>(&poses[1]);
            let factors = Factors::new(&mass.matrix, &self.diagonal(), free);
            let pinned = Pinned::new(&factors, self.model.tip_moves(&poses[1]), free);
            let residuals = self.residuals(&poses, &stages, Some(forces));
            let mut y = factors.solve(&self.right(&residuals, free), free);
            let missed = self.missed(&poses, &stages, pin);
            let pushed = self.hold_pin(&pinned, &missed, &mut y);
            let changes = self.change(&mut stages, &y);
            for stage in 0..2 {
                forces[stage] = plus(forces[stage], T::ONE, pushed[stage]);
            }
            if iteration + 1 == ITERATIONS {
                let torques = self.torques(&residuals[1], &mass, &changes, free);
                state.torque = pinned.torques(torques, &pushed[1], free);
            }
        }
        state.force = forces[1];
        self.accept(state, commands, &stages, free);
    }

    #[inline(always)]
    fn poses(&self, stages: &Stages<T, LINKS, W>) -> [[Pose<T, Q>; LINKS]; 2] {
        [self.model.pose(&stages.q[0]), self.model.pose(&stages.q[1])]
    }

    /// Contribution of the stiffness to the diagonal.
    #[inline(always)]
    fn diagonal(&self) -> [Complex<T>; C] {
        let mut diagonal = [Complex::ZERO; C];
        for j in 0..LINKS {
            for i in 1..W {
                let stiffness = self.model.links[j].stiffness[i];
                diagonal[j * W + i] = self.weights.stiffness.scaled(stiffness);
            }
        }
        diagonal
    }

    /// Residuals of both stages, elastic forces included.
    #[inline(always)]
    fn residuals(
        &self,
        poses: &[[Pose<T, Q>; LINKS]; 2],
        stages: &Stages<T, LINKS, W>,
        forces: Option<[Vector<T>; 2]>,
    ) -> [Slots<T, LINKS, W>; 2] {
        let model = &self.model;
        core::array::from_fn(|stage| {
            let (v, mut a) = (&stages.v[stage], stages.k[stage]);
            if model.alpha != T::ZERO {
                for j in 0..LINKS {
                    for i in 0..W {
                        a[j][i] += model.alpha * v[j][i];
                    }
                }
            }
            let force = forces.map(|forces| forces[stage]);
            let mut residual = model.inverse_dynamics(&poses[stage], v, &a, force);
            for j in 0..LINKS {
                for i in 1..W {
                    let bend = stages.q[stage][j][i] + model.beta * v[j][i];
                    residual[j][i] += model.links[j].stiffness[i] * bend;
                }
            }
            residual
        })
    }

    #[inline(always)]
    fn right(&self, residuals: &[Slots<T, LINKS, W>; 2], free: &[bool; C]) -> [Complex<T>; C] {
        let mut right = [Complex::ZERO; C];
        for j in 0..LINKS {
            for i in 0..W {
                if free[j * W + i] {
                    let right_side = self.weights.forward(residuals[0][j][i], residuals[1][j][i]);
                    right[j * W + i] = self.weights.mass * right_side;
                }
            }
        }
        right
    }

    /// Changes the stages' accelerations by a solution.
    #[inline(always)]
    fn change(&self, stages: &mut Stages<T, LINKS, W>, y: &[Complex<T>; C]) -> Changes<T, C> {
        let mut changes = [[T::ZERO; C]; 2];
        for j in 0..LINKS {
            for i in 0..W {
                let both = self.weights.back(y[j * W + i]);
                for stage in 0..2 {
                    changes[stage][j * W + i] = both[stage];
                    stages.k[stage][j][i] += both[stage];
                }
            }
        }
        changes
    }

    /// Torques at the tick's end: the residuals of the joints, and what the iteration's change of
    /// the accelerations changes of them.
    #[inline(always)]
    fn torques(
        &self,
        residual: &Slots<T, LINKS, W>,
        mass: &Mass<T, C>,
        changes: &Changes<T, C>,
        free: &[bool; C],
    ) -> [T; LINKS] {
        let damping = self.model.alpha * self.weights.h * self.weights.quarter;
        let mut change = changes[1];
        if damping != T::ZERO {
            for i in 0..C {
                change[i] += damping * (changes[1][i] + (T::TWO + T::ONE) * changes[0][i]);
            }
        }
        let mut torques = [T::ZERO; LINKS];
        for j in 0..LINKS {
            let row = j * W;
            if free[row] {
                continue;
            }
            torques[j] = residual[j][0];
            for i in 0..C {
                if free[i] {
                    let entry = if i < row { mass.matrix[row][i] } else { mass.matrix[i][row] };
                    torques[j] += entry * change[i];
                }
            }
        }
        torques
    }
}

/// Newton iterations of a tick of a closed chain.
const ITERATIONS: usize = 2;
