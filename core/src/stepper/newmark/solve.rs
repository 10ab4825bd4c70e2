//! The implicit step: `q*` and `d*`, and what restores them.

use super::{Newmark, NewmarkState};
use crate::hub::HubState;
use crate::math::{Band, Each, Scalar, clip};
use crate::stepper::HubMotion;

impl<T: Scalar, const N: usize, const W: usize, const AXES: bool> Newmark<T, N, W, AXES> {
    /// `K q`.
    #[inline(always)]
    pub(super) fn stiff(&self, q: &[T; N]) -> [T; N] {
        if Self::PRINCIPAL { *q } else { self.stiffness.times(q) }
    }

    /// `G q`.
    #[inline(always)]
    pub(super) fn spun(&self, q: &[T; N]) -> [T; N] {
        if Self::PRINCIPAL { self.spin.diagonal_times(q) } else { self.spin.times(q) }
    }

    /// Turns `q` and `d` into `q*` and `d*`, the hub having gained that much rate. In place, as no
    /// copy of an array is free.
    #[inline(always)]
    pub(super) fn predict<M: HubMotion>(
        &self,
        q: &mut [T; N],
        d: &mut [T; N],
        restoring: &[T; N],
        gained: T,
    ) {
        for i in 0..N {
            let d0 = d[i];
            let mut next = d0 - restoring[i];
            if !M::AT_REST {
                next -= self.turn[i] * gained;
            }
            d[i] = next;
            q[i] += d0 + next;
        }
    }

    /// The state from `q*` and `d*` and what restores them.
    #[inline(always)]
    pub(super) fn correct(mut q: [T; N], mut d: [T; N], restoring: [T; N]) -> NewmarkState<T, N> {
        for i in 0..N {
            q[i] -= restoring[i];
            d[i] -= restoring[i];
        }
        NewmarkState { deflection: q, gain: d, restoring }
    }

    /// `[E + θ̇²G] c = f + θ̇²G q`, `E` the effective matrix.
    #[inline(always)]
    pub(super) fn solve_turning(&self, mut force: [T; N], q: &[T; N], rate: T) -> [T; N] {
        let square = rate * rate;
        if Self::PRINCIPAL {
            let change = self.spin.diagonal().each(|g| square * g);
            for i in 0..N {
                force[i] += change[i] * q[i];
            }
            self.effective.plus_diagonal(&change).solve(&force)
        } else {
            let change = self.spin.scaled(square);
            let changed = change.times(q);
            for i in 0..N {
                force[i] += changed[i];
            }
            self.effective.plus(T::ONE, &change).solve(&force)
        }
    }

    /// `c` from `[4/h² M + 2/h C + K_t] c = K_t q + 2/h C d + αFθ̇ + g cosχ f_g`, with
    /// `K_t = K + θ̇²G − g sinχ K_P`; the factors of set-up serve while `K_t` is `K`.
    #[inline(always)]
    pub(super) fn solve<M: HubMotion>(&self, q: &[T; N], d: &[T; N], hub: &HubState<T>) -> [T; N] {
        let mut force = self.stiff(q);
        if M::LINEAR {
            return self.solve_turning(force, q, hub.rate);
        }
        self.damp::<M>(&mut force, d, hub.rate);
        let turns = !M::AT_REST && self.terms.spin && hub.rate != T::ZERO;
        if !self.terms.gravity {
            return if turns {
                self.solve_turning(force, q, hub.rate)
            } else {
                self.factors.solve(&force)
            };
        }
        let mut change = self.tension.scaled(-hub.sin);
        if turns {
            change = change.plus(hub.rate * hub.rate, &self.spin);
        }
        self.solve_hanging(force, q, change, hub.cos)
    }

    /// Takes from an arm that nothing damps what the rounding of `K q` may feed it.
    #[inline(always)]
    pub(super) fn damp_numerically(&self, restoring: &mut [T; N], d: &[T; N]) {
        if Self::PRINCIPAL || self.terms.damping {
            return;
        }
        // Of the deflections: the slopes go with them.
        for i in (0..N).step_by(2) {
            restoring[i] += self.numerical_damping * d[i];
        }
    }

    /// `[E + A] c = f + A q + g cosχ f_g`, `A` being `change`.
    #[inline(never)]
    pub(super) fn solve_hanging(
        &self,
        mut force: [T; N],
        q: &[T; N],
        change: Band<T, N, W>,
        cos: T,
    ) -> [T; N] {
        let changed = change.times(q);
        for i in 0..N {
            force[i] += changed[i] + self.weight[i] * cos;
        }
        let restoring = self.effective.plus(T::ONE, &change).solve(&force);
        restoring.each(|c| clip(c, self.most))
    }

    /// Adds what damping puts on the arm.
    #[inline(always)]
    fn damp<M: HubMotion>(&self, force: &mut [T; N], d: &[T; N], rate: T) {
        if !self.terms.damping {
            return;
        }
        let damping = self.damping.times(d);
        for i in 0..N {
            force[i] += if M::AT_REST { damping[i] } else { damping[i] + self.drag[i] * rate };
        }
    }
}
