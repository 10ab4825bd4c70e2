//! A stop of all joints along their common path: time itself is brought to rest.
//!
//! Where the joints would be after σ ticks is where they are when the path's own time has run by σ.
//! From `σ̇ = 1` it runs slower and slower, `σ̇ = 1 − 3u² + 2u³` over the stop, `u = 0..1`, and
//! ends where half the stop's length of it has passed. No joint leaves the path, and none turns
//! back that would not have done so.

use super::{ChainGenerator, JointState};
use crate::Error;
use crate::math::Scalar;
use crate::mechanism::of_joint;

/// A stop under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop<T> {
    /// Length in ticks, and how many of them have passed.
    ticks: u32,
    passed: u32,
    /// Whole ticks of the path that have passed.
    whole: T,
}

/// Longest stop, ticks.
const LONGEST: f64 = 16_000.0;
/// Lengths that are tried, each longer than the one before by a quarter.
const LENGTHS: usize = 24;
/// Instants of a stop at which its accelerations are looked at.
const INSTANTS: u32 = 16;

/// Time of the path, ticks, its rate and the change of that a tick, `x` ticks into a stop of
/// `ticks`.
#[inline(always)]
fn clock<T: Scalar>(x: T, ticks: T) -> [T; 3] {
    let u = x / ticks;
    let (two, three) = (T::TWO, T::TWO + T::ONE);
    let square = u * u;
    let sigma = x * (T::ONE - square + T::HALF * square * u);
    [sigma, T::ONE - square * (three - two * u), -(two * three) * u * (T::ONE - u) / ticks]
}

/// The joint on its path, `at`, where the path's time runs at `rate` and changes by `change` a
/// tick.
#[inline(always)]
fn slowed<T: Scalar>(at: JointState<T>, rate: T, change: T, per_tick: T) -> JointState<T> {
    JointState {
        angle: at.angle,
        rate: at.rate * rate,
        acceleration: at.acceleration * (rate * rate) + at.rate * (change * per_tick),
    }
}

impl<
    T: Scalar,
    const LINKS: usize,
    const W: usize,
    const C: usize,
    const Q: usize,
    const QUEUE: usize,
> ChainGenerator<T, LINKS, W, C, Q, QUEUE>
{
    /// Brings all joints to rest along their common path, from the next tick on, as fast as the
    /// limits of deceleration, or else of acceleration, allow every one. No move waits any more
    /// then. A stop that is under way goes on. Needs some ten thousand instructions.
    ///
    /// # Errors
    /// A driven joint without a limit of deceleration or acceleration. Nothing has changed then.
    pub fn stop(&mut self) -> Result<(), Error> {
        if self.stop.is_some() {
            return Ok(());
        }
        let limits = self.can_stop()?;
        let ticks = self.stopping_ticks(&limits);
        self.stop = Some(Stop { ticks, passed: 0, whole: T::ZERO });
        Ok(())
    }

    /// The limits that a stop keeps, rad/s²; 0 of a passive joint, which keeps none.
    ///
    /// # Errors
    /// A driven joint without a limit of deceleration or acceleration.
    pub(crate) fn can_stop(&self) -> Result<[T; LINKS], Error> {
        let mut limits = [T::ZERO; LINKS];
        for j in 0..LINKS {
            if self.chain.is_driven(j, self.state.is_closed()) {
                limits[j] = self.queues[j].braking();
                if limits[j] == T::ZERO {
                    return Err(of_joint(
                        Error::OutOfRange {
                            parameter: "limits.acceleration",
                            value: f64::INFINITY,
                            min: 1e-9,
                            max: 1e12,
                            unit: "rad/s^2",
                        },
                        j,
                    ));
                }
            }
        }
        Ok(limits)
    }

    /// True while a stop is under way.
    pub fn is_stopping(&self) -> bool {
        self.stop.is_some()
    }

    /// The shortest of the lengths in which all joints keep their limits of acceleration.
    fn stopping_ticks(&self, limits: &[T; LINKS]) -> u32 {
        let per_tick = self.chain.per_tick();
        let slowest = T::ONE + T::HALF;
        let mut ticks = T::TWO;
        for (queue, limit) in self.queues.iter().zip(limits) {
            if *limit > T::ZERO {
                let needed = slowest * queue.far(T::ZERO).rate.abs() * per_tick / *limit;
                ticks = if needed > ticks { needed } else { ticks };
            }
        }
        for _ in 0..LENGTHS {
            if ticks >= T::from_f64(LONGEST) || self.keeps(limits, ticks) {
                break;
            }
            ticks = ticks + T::from_f64(0.25) * ticks;
        }
        let most = T::from_f64(LONGEST);
        let (whole, rest) = (if ticks < most { ticks } else { most }).split();
        whole.max(1) as u32 + u32::from(rest > T::ZERO)
    }

    fn keeps(&self, limits: &[T; LINKS], ticks: T) -> bool {
        let per_tick = self.chain.per_tick();
        let room = T::from_f64(1.001);
        (0..INSTANTS).all(|instant| {
            let x =
                ticks * (T::from_u32(instant) + T::HALF) * T::from_f64(1.0 / f64::from(INSTANTS));
            let [sigma, rate, change] = clock(x, ticks);
            self.queues.iter().zip(limits).all(|(queue, limit)| {
                let joint = slowed(queue.far(sigma), rate, change, per_tick);
                *limit == T::ZERO || joint.acceleration.abs() <= room * *limit
            })
        })
    }

    /// The joints `x` ticks into the stop.
    fn stopping_at(&self, stop: &Stop<T>, x: T) -> [JointState<T>; LINKS] {
        let [sigma, rate, change] = clock(x, T::from_u32(stop.ticks));
        let per_tick = self.chain.per_tick();
        core::array::from_fn(|j| {
            slowed(self.queues[j].far(sigma - stop.whole), rate, change, per_tick)
        })
    }

    /// The commands of a tick of a stop, at its third and its end.
    #[inline(never)]
    pub(super) fn stopping_commands(&mut self, stop: Stop<T>) -> [[JointState<T>; LINKS]; 2] {
        let passed = T::from_u32(stop.passed);
        let ends = [passed + self.third, passed + T::ONE].map(|x| self.stopping_at(&stop, x));
        let mut stop = Stop { passed: stop.passed + 1, ..stop };
        let [sigma, ..] = clock(T::from_u32(stop.passed), T::from_u32(stop.ticks));
        if sigma - stop.whole >= T::ONE {
            for queue in &mut self.queues {
                queue.advance();
            }
            stop.whole += T::ONE;
        }
        self.stop = if stop.passed < stop.ticks {
            Some(stop)
        } else {
            for (queue, joint) in self.queues.iter_mut().zip(&ends[1]) {
                queue.rest_at(joint.angle);
            }
            None
        };
        ends
    }
}
