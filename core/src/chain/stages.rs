//! Coordinates, rates and accelerations at the two stages of a tick.

use super::pose::Pose;
use super::weights::Weights;
use super::{Chain, ChainState, Command, JointState};
use crate::hub::Angle;
use crate::math::{Scalar, array};

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

/// Changes of the accelerations of both stages in an iteration, of the last `N` coordinates of each
/// link.
pub(super) type Changes<T, const LINKS: usize, const N: usize> = [[[T; 2]; N]; LINKS];

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
    /// True if joint `j` has no motor: never where all joints have one.
    #[inline(always)]
    pub(super) fn is_free<const N: usize>(
        &self,
        state: &ChainState<T, LINKS, W>,
        j: usize,
    ) -> bool {
        N == W && (if state.pin.is_some() { &self.closed } else { &self.open })[j * W]
    }

    /// Both stages accelerate as the last tick ended; driven joints as commanded.
    #[inline(always)]
    pub(super) fn first_guess<const N: usize>(
        &self,
        state: &ChainState<T, LINKS, W>,
        commands: &[Command<T>; LINKS],
    ) -> Stages<T, LINKS, W> {
        let Weights { h, half, third, sixth, .. } = self.weights;
        let zero = [[[T::ZERO; W]; LINKS]; 2];
        let mut stages = Stages { k: zero, q: zero, v: zero };
        for j in 0..LINKS {
            for i in 0..W {
                let (v, k) = (state.rate[j][i], state.acceleration[j][i]);
                if i == 0 && !self.is_free::<N>(state, j) {
                    let Command { third, end } = &commands[j];
                    for (stage, joint) in [third, end].into_iter().enumerate() {
                        stages.q[stage][j][0] = joint.angle.part;
                        stages.v[stage][j][0] = joint.rate;
                        stages.k[stage][j][0] = joint.acceleration;
                    }
                    continue;
                }
                let moved = [third * (v + sixth * k), h * (v + half * k)];
                for stage in 0..2 {
                    stages.q[stage][j][i] = if i == 0 {
                        state.joints[j].angle.part + self.model.turns * moved[stage]
                    } else {
                        state.shape[j][i] + moved[stage]
                    };
                    stages.k[stage][j][i] = k;
                }
                (stages.v[0][j][i], stages.v[1][j][i]) = (v + third * k, v + h * k);
            }
        }
        stages
    }

    /// Takes stage 2 with its changes, which is the tick's end, as the new state. `pose` is that of
    /// stage 2 as guessed.
    #[inline(always)]
    pub(super) fn accept<const N: usize>(
        &self,
        state: &mut ChainState<T, LINKS, W>,
        commands: &[Command<T>; LINKS],
        stages: &Stages<T, LINKS, W>,
        changes: &Changes<T, LINKS, N>,
        pose: &[Pose<T, Q>; LINKS],
    ) {
        let Weights { three_quarters, quarter, half_square, .. } = self.weights;
        let moved: Slots<T, LINKS, W> = array(|j| {
            array(|i| if i + N < W { T::ZERO } else { half_square * changes[j][i + N - W][0] })
        });
        for j in 0..LINKS {
            for i in W - N..W {
                let [first, second] = changes[j][i + N - W];
                state.rate[j][i] = stages.v[1][j][i] + (three_quarters * first + quarter * second);
                state.acceleration[j][i] = stages.k[1][j][i] + second;
                if i > 0 {
                    state.shape[j][i] = stages.q[1][j][i] + moved[j][i];
                }
            }
            if self.is_free::<N>(state, j) {
                let Angle { turns, .. } = state.joints[j].angle;
                let part = stages.q[1][j][0] + self.model.turns * moved[j][0];
                let angle = Angle { turns, part: T::ZERO }.plus(part);
                let (rate, acceleration) = (state.rate[j][0], state.acceleration[j][0]);
                state.joints[j] = JointState { angle, rate, acceleration };
            } else {
                let joint = commands[j].end;
                (state.rate[j][0], state.acceleration[j][0]) = (joint.rate, joint.acceleration);
                state.joints[j] = joint;
            }
        }
        if self.bound::<N>(state) && turns_little::<T, LINKS, W, N>(&moved) {
            self.locate_near(state, pose, &moved);
        } else {
            self.locate(state);
        }
    }

    /// Keeps a state finite, and returns true if it was. One comparison of a sum, as no state that
    /// a move makes is near.
    #[inline(always)]
    fn bound<const N: usize>(&self, state: &mut ChainState<T, LINKS, W>) -> bool {
        let (mut rates, mut kicks, mut bends) = (T::ZERO, T::ZERO, T::ZERO);
        let mut torques = T::ZERO;
        for j in 0..LINKS {
            for i in W - N..W {
                rates += state.rate[j][i].abs();
                kicks += state.acceleration[j][i].abs();
            }
            for i in 1..W {
                bends += state.shape[j][i].abs();
            }
            torques += state.torque[j].abs();
        }
        let rates = rates + self.weights.h * kicks;
        let bends = bends + T::from_f64(MOST_BEND / MOST) * torques;
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

/// True if the iteration has changed the coordinates by no more than [`TURN`].
#[inline(always)]
fn turns_little<T: Scalar, const LINKS: usize, const W: usize, const N: usize>(
    moved: &Slots<T, LINKS, W>,
) -> bool {
    let mut sum = T::ZERO;
    for row in moved {
        for i in W - N..W {
            sum += row[i].abs();
        }
    }
    sum <= T::from_f64(TURN)
}
