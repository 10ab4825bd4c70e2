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

use super::factors::{Factors, Values};
use super::mass::Mass;
use super::pin::Pinned;
use super::pose::{Pose, Vector, plus};
use super::stages::{Changes, Slots, Stages};
use super::{Chain, ChainState, Command};
use crate::math::{Scalar, array};

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
            self.step_open::<W>(state, commands);
        } else if W == 3 {
            self.step_open::<2>(state, commands);
        } else {
            self.step_open::<3>(state, commands);
        }
    }

    /// A tick of an open chain. The last `N` coordinates of each link are unknown: all `W`, or all
    /// but the joints' if those are driven.
    #[inline(never)]
    fn step_open<const N: usize>(
        &self,
        state: &mut ChainState<T, LINKS, W>,
        commands: &[Command<T>; LINKS],
    ) {
        let free = &self.open;
        let stages = self.first_guess::<N>(state, commands);
        let poses = self.poses(&stages);
        let mut mass = Mass::NONE;
        self.model.write_mass::<C, false>(&poses[1], &mut mass);
        let mut factors = Factors::<T, LINKS, N>::NONE;
        factors.factor(&mass.matrix, &self.diagonal, free);
        let residuals = self.residuals(&poses, &stages, None);
        let changes = self.changes::<N>(&factors.solve(&self.right::<N>(&residuals)));
        state.torque = self.torques::<N>(&residuals[1], &mass, &changes, free);
        self.accept::<N>(state, commands, &stages, &changes, &poses[1]);
    }

    #[inline(never)]
    fn step_closed(
        &self,
        state: &mut ChainState<T, LINKS, W>,
        commands: &[Command<T>; LINKS],
        pin: Vector<T>,
    ) {
        let free = &self.closed;
        let stages = self.first_guess::<W>(state, commands);
        let poses = self.poses(&stages);
        let mut mass = Mass::NONE;
        self.model.write_mass::<C, false>(&poses[1], &mut mass);
        let mut factors = Factors::<T, LINKS, W>::NONE;
        factors.factor(&mass.matrix, &self.diagonal, free);
        let residuals = self.residuals(&poses, &stages, Some(state.force));
        let right = self.right::<W>(&residuals);
        let pinned = Pinned::new(&factors, self.model.tip_moves(&poses[1]), &right);
        let (y, pushed) = pinned.solve(&factors, self.missed(&poses, &stages, pin));
        let (changes, pushed) = (self.changes::<W>(&y), self.push(pushed));
        state.torque = self.torques::<W>(&residuals[1], &mass, &changes, free);
        for j in 0..LINKS {
            if !free[j * W] {
                state.torque[j] -= pinned.torque(j, &pushed[1]);
            }
        }
        state.force = plus(state.force, T::ONE, pushed[1]);
        self.accept::<W>(state, commands, &stages, &changes, &poses[1]);
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
        let mut residuals: [Slots<T, LINKS, W>; 2] = array(|stage| {
            let (q, v) = (&stages.q[stage], &stages.v[stage]);
            array(|j| array(|i| model.links[j].stiffness[i] * (q[j][i] + model.beta * v[j][i])))
        });
        for stage in 0..2 {
            let (v, k) = (&stages.v[stage], &stages.k[stage]);
            let residual = &mut residuals[stage];
            if model.alpha == T::ZERO {
                model.add_inverse_dynamics(&poses[stage], v, k, force, residual);
            } else {
                let damped = array(|j| array(|i| k[j][i] + model.alpha * v[j][i]));
                model.add_inverse_dynamics(&poses[stage], v, &damped, force, residual);
            }
        }
        residuals
    }

    #[inline(always)]
    fn right<const N: usize>(&self, residuals: &[Slots<T, LINKS, W>; 2]) -> Values<T, LINKS, N> {
        array(|j| {
            array(|k| {
                let i = W - N + k;
                let right = self.weights.forward(residuals[0][j][i], residuals[1][j][i]);
                if self.model.alpha == T::ZERO { right } else { self.weights.mass * right }
            })
        })
    }

    /// Changes of both stages' accelerations by a solution.
    #[inline(always)]
    fn changes<const N: usize>(&self, y: &Values<T, LINKS, N>) -> Changes<T, LINKS, N> {
        y.map(|row| row.map(|y| self.weights.back(y)))
    }

    /// Torques at the tick's end: the residuals of the joints, and what the iteration's change of
    /// the accelerations changes of them.
    #[inline(always)]
    fn torques<const N: usize>(
        &self,
        residual: &Slots<T, LINKS, W>,
        mass: &Mass<T, C>,
        changes: &Changes<T, LINKS, N>,
        free: &[bool; C],
    ) -> [T; LINKS] {
        let damping = self.model.alpha * self.weights.quarter;
        let change: [[T; N]; LINKS] = changes.map(|row| {
            row.map(|[first, second]| {
                if self.model.alpha == T::ZERO {
                    return second;
                }
                second + damping * (second + (T::TWO + T::ONE) * first)
            })
        });
        array(|j| {
            let row = j * W;
            if N == W && free[row] {
                return T::ZERO;
            }
            let mut torque = residual[j][0];
            // What is driven does not change.
            for link in 0..LINKS {
                for k in 0..N {
                    let (own, other) = (link * W + W - N + k, row);
                    let (below, beside) = if own < other { (other, own) } else { (own, other) };
                    torque += mass.matrix[below][beside] * change[link][k];
                }
            }
            torque
        })
    }
}
