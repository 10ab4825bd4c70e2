//! Coordinates, rates and accelerations at the two stages of a tick.

use super::{Chain, ChainState, Command, JointState};
use crate::hub::Angle;
use crate::math::Scalar;

/// Coordinates of all links: slot 0 a joint's, the others curvature.
pub(super) type Slots<T, const LINKS: usize, const W: usize> = [[T; W]; LINKS];

/// Both stages of a tick.
pub(super) struct Stages<T, const LINKS: usize, const W: usize> {
    /// Accelerations: the unknowns.
    pub k: [Slots<T, LINKS, W>; 2],
    /// Joints' angles in turns, curvature in rad.
    pub q: [Slots<T, LINKS, W>; 2],
    /// Rates.
    pub v: [Slots<T, LINKS, W>; 2],
}

/// Bounds of what is carried on, so that a chain that is asked for too much stays finite: of a
/// curvature coordinate, rad; of a rate, rad a tick; of torques and forces, N m and N.
const MOST_BEND: f64 = 8.0;
const MOST_TURN: f64 = 32.0;
const MOST: f64 = 1e12;

/// `x` within `±most`; 0 for what is no number.
#[inline(always)]
fn bounded<T: Scalar>(x: T, most: T) -> T {
    if x > most {
        most
    } else if x >= -most {
        x
    } else if x < T::ZERO {
        -most
    } else {
        T::ZERO
    }
}

impl<T, const LINKS: usize, const W: usize, const C: usize, const Q: usize> Chain<T, LINKS, W, C, Q>
where
    T: Scalar,
{
    /// Both stages accelerate as the last tick ended; driven joints as commanded.
    #[inline(always)]
    pub(super) fn first_guess(
        &self,
        state: &ChainState<T, LINKS, W>,
        commands: &[Command<T>; LINKS],
        free: &[bool; C],
    ) -> Stages<T, LINKS, W> {
        let mut stages =
            Stages { k: [state.acceleration; 2], q: [state.shape; 2], v: [state.rate; 2] };
        for j in 0..LINKS {
            if !free[j * W] {
                for (stage, joint) in [&commands[j].third, &commands[j].end].into_iter().enumerate()
                {
                    stages.q[stage][j][0] = joint.angle.part;
                    stages.v[stage][j][0] = joint.rate;
                    stages.k[stage][j][0] = joint.acceleration;
                }
            }
        }
        stages
    }

    /// Coordinates and rates of both stages from their accelerations.
    #[inline(always)]
    pub(super) fn update(
        &self,
        state: &ChainState<T, LINKS, W>,
        stages: &mut Stages<T, LINKS, W>,
        free: &[bool; C],
    ) {
        let weights = &self.weights;
        let h = weights.h;
        for j in 0..LINKS {
            for i in 0..W {
                if !free[j * W + i] {
                    continue;
                }
                let (v, k1, k2) = (state.rate[j][i], stages.k[0][j][i], stages.k[1][j][i]);
                let moved = h * (weights.third * v + h * (weights.ninth * (k1 - T::HALF * k2)));
                stages.q[0][j][i] = self.moved(state, j, i, moved);
                stages.v[0][j][i] = v + h * (weights.five * k1 - weights.twelfth * k2);
                (stages.q[1][j][i], stages.v[1][j][i]) = self.end(state, j, i, [k1, k2]);
            }
        }
    }

    /// Coordinate and rate at the tick's end.
    #[inline(always)]
    fn end(&self, state: &ChainState<T, LINKS, W>, j: usize, i: usize, [k1, k2]: [T; 2]) -> (T, T) {
        let (h, v) = (self.weights.h, state.rate[j][i]);
        let moved = h * (v + h * (T::HALF * k1));
        let rate = v + h * (k2 + (T::TWO + T::ONE) * k1) * self.weights.quarter;
        (self.moved(state, j, i, moved), rate)
    }

    #[inline(always)]
    fn moved(&self, state: &ChainState<T, LINKS, W>, j: usize, i: usize, moved: T) -> T {
        if i == 0 {
            state.joints[j].angle.part + self.model.turns * moved
        } else {
            state.shape[j][i] + moved
        }
    }

    /// Takes stage 2, which is the tick's end, as the new state.
    #[inline(always)]
    pub(super) fn accept(
        &self,
        state: &mut ChainState<T, LINKS, W>,
        commands: &[Command<T>; LINKS],
        stages: &Stages<T, LINKS, W>,
        free: &[bool; C],
    ) {
        for j in 0..LINKS {
            for i in 0..W {
                if free[j * W + i] {
                    let k = [stages.k[0][j][i], stages.k[1][j][i]];
                    let (q, v) = self.end(state, j, i, k);
                    state.rate[j][i] = v;
                    state.acceleration[j][i] = k[1];
                    if i == 0 {
                        let Angle { turns, .. } = state.joints[j].angle;
                        let angle = Angle { turns, part: T::ZERO }.plus(q);
                        state.joints[j] = JointState { angle, rate: v, acceleration: k[1] };
                    } else {
                        state.shape[j][i] = q;
                    }
                }
            }
            if !free[j * W] {
                state.joints[j] = commands[j].end;
                state.rate[j][0] = commands[j].end.rate;
                state.acceleration[j][0] = commands[j].end.acceleration;
            }
        }
        self.bound(state);
    }

    /// Keeps a state finite. One comparison of a sum, as no state that a move makes is near.
    #[inline(always)]
    fn bound(&self, state: &mut ChainState<T, LINKS, W>) {
        let (mut rates, mut bends) = (T::ZERO, T::ZERO);
        for j in 0..LINKS {
            for i in 0..W {
                rates += state.rate[j][i].abs() + self.weights.h * state.acceleration[j][i].abs();
                bends += state.shape[j][i].abs();
            }
            bends += T::from_f64(MOST_BEND / MOST) * state.torque[j].abs();
        }
        let sum = bends + T::from_f64(MOST_BEND / MOST_TURN) * self.weights.h * rates;
        // NaN is not below it either.
        if !(..=T::from_f64(MOST_BEND)).contains(&sum) {
            self.bound_each(state);
        }
    }

    #[cold]
    #[inline(never)]
    fn bound_each(&self, state: &mut ChainState<T, LINKS, W>) {
        let per_tick = self.weights.per_tick;
        let most_rate = T::from_f64(MOST_TURN) * per_tick;
        for j in 0..LINKS {
            for i in 0..W {
                state.rate[j][i] = bounded(state.rate[j][i], most_rate);
                state.acceleration[j][i] = bounded(state.acceleration[j][i], most_rate * per_tick);
                state.shape[j][i] = bounded(state.shape[j][i], T::from_f64(MOST_BEND));
            }
            let joint = &mut state.joints[j];
            joint.angle.part = bounded(joint.angle.part, T::HALF);
            (joint.rate, joint.acceleration) = (state.rate[j][0], state.acceleration[j][0]);
            state.torque[j] = bounded(state.torque[j], T::from_f64(MOST));
        }
        state.force = state.force.map(|force| bounded(force, T::from_f64(MOST)));
    }
}
