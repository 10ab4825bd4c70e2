//! One tick: Radau IIA with two stages, one simplified Newton iteration on both stages at once.
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
use super::solve::{Factors, Values};
use super::stages::{Changes, Slots, Stages};
use super::{Chain, ChainState, Command};
use crate::math::{Complex, Scalar};

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
        } else if self.passive {
            self.step_open::<0>(state, commands);
        } else {
            self.step_open::<1>(state, commands);
        }
    }

    /// A tick of an open chain; `FROM` is 1 if all joints are driven.
    #[inline(never)]
    fn step_open<const FROM: usize>(
        &self,
        state: &mut ChainState<T, LINKS, W>,
        commands: &[Command<T>; LINKS],
    ) {
        let free = &self.open;
        let stages = self.first_guess::<FROM>(state, commands);
        let poses = self.poses(&stages);
        let mass = self.model.mass::<C, false>(&poses[1]);
        let factors = Factors::<T, LINKS, W, FROM>::new(&mass.matrix, &self.diagonal, free);
        let residuals = self.residuals(&poses, &stages, None);
        let changes = self.changes::<FROM>(&factors.solve(&self.right::<FROM>(&residuals)));
        state.torque = self.torques::<FROM>(&residuals[1], &mass, &changes, free);
        self.accept::<FROM>(state, commands, &stages, &changes, &poses[1]);
    }

    #[inline(never)]
    fn step_closed(
        &self,
        state: &mut ChainState<T, LINKS, W>,
        commands: &[Command<T>; LINKS],
        pin: Vector<T>,
    ) {
        let free = &self.closed;
        let stages = self.first_guess::<0>(state, commands);
        let poses = self.poses(&stages);
        let mass = self.model.mass::<C, false>(&poses[1]);
        let factors = Factors::<T, LINKS, W, 0>::new(&mass.matrix, &self.diagonal, free);
        let residuals = self.residuals(&poses, &stages, Some(state.force));
        let right = self.right::<0>(&residuals);
        let pinned = Pinned::new(&factors, self.model.tip_moves(&poses[1]), &right);
        let (y, pushed) = pinned.solve(&factors, self.missed(&poses, &stages, pin));
        let (changes, pushed) = (self.changes::<0>(&y), self.push(pushed));
        state.torque = self.torques::<0>(&residuals[1], &mass, &changes, free);
        for j in 0..LINKS {
            if !free[j * W] {
                state.torque[j] -= pinned.torque(j, &pushed[1]);
            }
        }
        state.force = plus(state.force, T::ONE, pushed[1]);
        self.accept::<0>(state, commands, &stages, &changes, &poses[1]);
    }

    #[inline(always)]
    fn poses(&self, stages: &Stages<T, LINKS, W>) -> [[Pose<T, Q>; LINKS]; 2] {
        [self.model.pose(&stages.q[0]), self.model.pose(&stages.q[1])]
    }

    /// Residuals of both stages, elastic forces included. `force` is the pin's.
    #[inline(always)]
    fn residuals(
        &self,
        poses: &[[Pose<T, Q>; LINKS]; 2],
        stages: &Stages<T, LINKS, W>,
        force: Option<Vector<T>>,
    ) -> [Slots<T, LINKS, W>; 2] {
        let model = &self.model;
        let mut residuals: [Slots<T, LINKS, W>; 2] = core::array::from_fn(|stage| {
            let (q, v) = (&stages.q[stage], &stages.v[stage]);
            core::array::from_fn(|j| {
                core::array::from_fn(|i| {
                    model.links[j].stiffness[i] * (q[j][i] + model.beta * v[j][i])
                })
            })
        });
        for stage in 0..2 {
            let (v, k) = (&stages.v[stage], &stages.k[stage]);
            let residual = &mut residuals[stage];
            if model.alpha == T::ZERO {
                model.add_inverse_dynamics(&poses[stage], v, k, force, residual);
            } else {
                let damped = core::array::from_fn(|j| {
                    core::array::from_fn(|i| k[j][i] + model.alpha * v[j][i])
                });
                model.add_inverse_dynamics(&poses[stage], v, &damped, force, residual);
            }
        }
        residuals
    }

    #[inline(always)]
    fn right<const FROM: usize>(&self, residuals: &[Slots<T, LINKS, W>; 2]) -> Values<T, LINKS, W> {
        let mut right = [[Complex::ZERO; W]; LINKS];
        for j in 0..LINKS {
            for i in FROM..W {
                right[j][i] = self.weights.forward(residuals[0][j][i], residuals[1][j][i]);
                if self.model.alpha != T::ZERO {
                    right[j][i] = self.weights.mass * right[j][i];
                }
            }
        }
        right
    }

    /// Changes of both stages' accelerations by a solution.
    #[inline(always)]
    fn changes<const FROM: usize>(&self, y: &Values<T, LINKS, W>) -> Changes<T, LINKS, W> {
        let mut changes = [[[T::ZERO; W]; LINKS]; 2];
        for j in 0..LINKS {
            for i in FROM..W {
                [changes[0][j][i], changes[1][j][i]] = self.weights.back(y[j][i]);
            }
        }
        changes
    }

    /// Torques at the tick's end: the residuals of the joints, and what the iteration's change of
    /// the accelerations changes of them.
    #[inline(always)]
    fn torques<const FROM: usize>(
        &self,
        residual: &Slots<T, LINKS, W>,
        mass: &Mass<T, C>,
        changes: &Changes<T, LINKS, W>,
        free: &[bool; C],
    ) -> [T; LINKS] {
        let mut change = changes[1];
        if self.model.alpha != T::ZERO {
            let damping = self.model.alpha * self.weights.quarter;
            for j in 0..LINKS {
                for i in FROM..W {
                    let three = (T::TWO + T::ONE) * changes[0][j][i];
                    change[j][i] += damping * (changes[1][j][i] + three);
                }
            }
        }
        let mut torques = [T::ZERO; LINKS];
        for j in 0..LINKS {
            let row = j * W;
            if FROM == 0 && free[row] {
                continue;
            }
            torques[j] = residual[j][0];
            // What is driven does not change.
            for link in 0..LINKS {
                for i in FROM..W {
                    let (own, other) = (link * W + i, row);
                    let (below, beside) = if own < other { (other, own) } else { (own, other) };
                    torques[j] += mass.matrix[below][beside] * change[link][i];
                }
            }
        }
        torques
    }
}
