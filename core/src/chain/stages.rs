//! Coordinates, rates and accelerations at the two stages of a tick.

use super::pose::Pose;
use super::weights::Weights;
use super::{Chain, ChainState, Command, JointState};
use crate::hub::Angle;
use crate::math::Scalar;

/// Coordinates of all links: slot 0 a joint's, the others curvature.
pub(super) type Slots<T, const LINKS: usize, const W: usize> = [[T; W]; LINKS];

/// Both stages of a tick, as the last tick's acceleration makes them.
pub(super) struct Stages<T, const LINKS: usize, const W: usize> {
    /// Accelerations: the unknowns.
    pub k: [Slots<T, LINKS, W>; 2],
    /// Joints' angles in turns, curvature in rad.
    pub q: [Slots<T, LINKS, W>; 2],
    /// Rates.
    pub v: [Slots<T, LINKS, W>; 2],
}

/// Change of both stages' accelerations in an iteration.
pub(super) type Changes<T, const LINKS: usize, const W: usize> = [Slots<T, LINKS, W>; 2];

/// Change of the coordinates by the iteration, rad in all, up to which the directions of the guess
/// are turned by it: the fourth power, over 24, is the error.
const TURN: f64 = 0.1;
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
        let Weights { h, half, third, sixth, .. } = self.weights;
        let mut stages =
            Stages { k: [state.acceleration; 2], q: [state.shape; 2], v: [state.rate; 2] };
        for j in 0..LINKS {
            for i in 1..W {
                let (v, k) = (state.rate[j][i], state.acceleration[j][i]);
                stages.q[0][j][i] += third * (v + sixth * k);
                stages.v[0][j][i] += third * k;
                stages.q[1][j][i] += h * (v + half * k);
                stages.v[1][j][i] += h * k;
            }
            if free[j * W] {
                let (part, turns) = (state.joints[j].angle.part, self.model.turns);
                let (v, k) = (state.rate[j][0], state.acceleration[j][0]);
                stages.q[0][j][0] = part + turns * (third * (v + sixth * k));
                stages.v[0][j][0] += third * k;
                stages.q[1][j][0] = part + turns * (h * (v + half * k));
                stages.v[1][j][0] += h * k;
            } else {
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

    /// Takes stage 2 with its changes, which is the tick's end, as the new state. `pose` is that of
    /// stage 2 as guessed.
    #[inline(always)]
    pub(super) fn accept(
        &self,
        state: &mut ChainState<T, LINKS, W>,
        commands: &[Command<T>; LINKS],
        stages: &Stages<T, LINKS, W>,
        changes: &Changes<T, LINKS, W>,
        pose: &[Pose<T, Q>; LINKS],
        free: &[bool; C],
    ) {
        let Weights { three_quarters, quarter, half_square, .. } = self.weights;
        let mut moved = [[T::ZERO; W]; LINKS];
        for j in 0..LINKS {
            for i in 0..W {
                let (first, second) = (changes[0][j][i], changes[1][j][i]);
                moved[j][i] = half_square * first;
                state.rate[j][i] = stages.v[1][j][i] + (three_quarters * first + quarter * second);
                state.acceleration[j][i] = stages.k[1][j][i] + second;
                if i > 0 {
                    state.shape[j][i] = stages.q[1][j][i] + moved[j][i];
                }
            }
            state.joints[j] = if free[j * W] {
                let Angle { turns, .. } = state.joints[j].angle;
                let part = stages.q[1][j][0] + self.model.turns * moved[j][0];
                let angle = Angle { turns, part: T::ZERO }.plus(part);
                let (rate, acceleration) = (state.rate[j][0], state.acceleration[j][0]);
                JointState { angle, rate, acceleration }
            } else {
                commands[j].end
            };
        }
        if self.bound(state) && self.turns_little(&moved) {
            self.locate_near(state, pose, &moved);
        } else {
            self.locate(state);
        }
    }

    /// True if the iteration has changed the coordinates by no more than [`TURN`].
    #[inline(always)]
    fn turns_little(&self, moved: &Slots<T, LINKS, W>) -> bool {
        let mut sum = T::ZERO;
        for row in moved {
            for moved in row {
                sum += moved.abs();
            }
        }
        sum <= T::from_f64(TURN)
    }

    /// Keeps a state finite, and returns true if it was. One comparison of a sum, as no state that a
    /// move makes is near.
    #[inline(always)]
    fn bound(&self, state: &mut ChainState<T, LINKS, W>) -> bool {
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
        let bounded = (..=T::from_f64(MOST_BEND)).contains(&sum);
        if !bounded {
            self.bound_each(state);
        }
        bounded
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
