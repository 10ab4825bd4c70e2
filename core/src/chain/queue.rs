//! The commanded motion of one joint: segments one behind the other.

use heapless::Deque;

use super::{Command, JointState};
use crate::Error;
use crate::hub::{Angle, HubState};
use crate::math::Scalar;
use crate::motion::{Limits, MoveSummary, Plannable, Segment};

/// The moves of one joint, the one under way first.
#[derive(Clone, Debug)]
pub(super) struct JointQueue<T, const QUEUE: usize> {
    current: Segment<T>,
    /// Index in it of the latest tick.
    k: u32,
    waiting: Deque<Segment<T>, QUEUE>,
    /// Holds the end of the queue.
    tail: Segment<T>,
    /// State behind the last move. Of a joint that holds only the rate counts: its angle is that of
    /// the latest tick, and a stop in the tick has no f64 to give.
    end: HubState<f64>,
    limits: Limits,
    /// Limit of deceleration, or else of acceleration, rad/s²; zero without one. A stop needs it in
    /// the tick's precision.
    braking: T,
    /// True while no move is under way.
    holds: bool,
    /// Peak acceleration of the moves that wait or are under way, rad/s².
    peak: f64,
}

impl<T: Scalar, const QUEUE: usize> JointQueue<T, QUEUE> {
    /// A joint that rests at `angle`.
    pub fn new(angle: Angle<T>) -> Self {
        let tail = Segment::rest(angle);
        Self {
            current: tail,
            k: 0,
            waiting: Deque::new(),
            tail,
            end: HubState::at_rest(Angle::default()),
            limits: Limits::default(),
            braking: T::ZERO,
            holds: true,
            peak: 0.0,
        }
    }

    /// Rests at `angle` from now on; no move waits.
    pub fn rest_at(&mut self, angle: Angle<T>) {
        *self = Self { limits: self.limits, braking: self.braking, ..Self::new(angle) };
    }

    pub fn limit(&mut self, limits: Limits) -> Result<(), Error> {
        self.limits = limits.validate()?.of_motion()?;
        let braking = self.limits.deceleration.or(self.limits.acceleration);
        self.braking = T::from_f64(braking.unwrap_or(0.0));
        Ok(())
    }

    pub fn braking(&self) -> T {
        self.braking
    }

    /// Start of a move that is pushed now.
    pub fn next_start(&self) -> HubState<f64> {
        if self.is_holding() {
            let angle = state(&self.current, T::from_u32(self.k)).angle;
            HubState::turning(angle.precise(), self.end.rate)
        } else {
            self.end
        }
    }

    /// True if no move is under way or waiting.
    pub fn is_holding(&self) -> bool {
        self.holds && self.waiting.is_empty()
    }

    /// Peak acceleration of all that is commanded from now on, rad/s².
    pub fn peak(&self) -> f64 {
        if self.is_holding() { 0.0 } else { self.peak }
    }

    /// Plans a move behind the others, if `admit` takes its peak acceleration, rad/s². Either the
    /// whole move is taken or nothing changes.
    pub fn push(
        &mut self,
        motion: &impl Plannable,
        tick: f64,
        admit: impl FnOnce(f64) -> Result<(), Error>,
    ) -> Result<MoveSummary, Error> {
        let start = self.next_start();
        let (mut needed, free) = (0, QUEUE - self.waiting.len());
        let summary = motion.plan_segments(start, &self.limits, tick, &mut |segment| {
            needed += 1;
            // A full queue gives it back; told below.
            let _ = self.waiting.push_back(*segment);
        })?;
        let peak = self.peak().max(summary.peaks.acceleration);
        let fits = if needed > free { Err(Error::QueueFull { needed, free }) } else { Ok(()) };
        if let Err(error) = fits.and_then(|()| admit(peak)) {
            for _ in 0..needed.min(free) {
                self.waiting.pop_back();
            }
            return Err(error);
        }
        self.peak = peak;
        if self.holds {
            // It begins where the latest tick is: a hold is as long as it has lasted.
            self.current.cut(self.k);
        }
        self.end = summary.end;
        self.tail = Segment::cruise(self.end.angle, self.end.rate, u32::MAX, tick);
        Ok(summary)
    }

    /// Motion in the coming tick, `third` of it ahead and at its end; where two segments meet
    /// there, by the one before. The queue goes on by that tick.
    #[inline(always)]
    pub fn next_command(&mut self, third: T) -> Command<T> {
        if self.k + 1 < self.current.count() {
            let k = T::from_u32(self.k);
            self.k += 1;
            let (third, end) = (state(&self.current, k + third), state(&self.current, k + T::ONE));
            return Command { third, end };
        }
        self.command_at_border(third)
    }

    /// The same where a segment ends in the tick.
    #[inline(never)]
    fn command_at_border(&mut self, third: T) -> Command<T> {
        if self.k >= self.current.count() {
            // A hold that a push has cut at the latest tick.
            self.take_up_next();
            if self.k + 1 < self.current.count() {
                return self.next_command(third);
            }
        }
        let next = self.waiting.front().unwrap_or(&self.tail);
        let whole = self.k + 1 == self.current.count() && next.ticks_before() == T::ZERO;
        let command = if whole {
            let end = JointState {
                acceleration: self.current.end_acceleration(),
                ..state(next, T::ZERO)
            };
            Command { third: state(&self.current, T::from_u32(self.k) + third), end }
        } else {
            Command { third: self.far(third), end: self.far(T::ONE) }
        };
        self.advance();
        command
    }

    /// The joint any number of ticks ahead; where two segments meet there, by the one before.
    #[inline(never)]
    pub fn far(&self, ahead: T) -> JointState<T> {
        let mut segment = &self.current;
        let mut ticks = T::from_u32(self.k) + ahead;
        let mut waiting = self.waiting.iter();
        loop {
            let (next, is_tail) = waiting.next().map_or((&self.tail, true), |next| (next, false));
            let (count, before) = (T::from_u32(segment.count()), next.ticks_before());
            let border = count - before;
            if ticks < border {
                return state(segment, ticks);
            }
            if ticks == border {
                // From the left, but exactly where the next one begins.
                let exact = before == T::ZERO;
                let at = if exact { state(next, T::ZERO) } else { state(segment, ticks) };
                return JointState { acceleration: segment.end_acceleration(), ..at };
            }
            ticks -= count;
            segment = next;
            if is_tail {
                return state(segment, ticks);
            }
        }
    }

    /// Goes on by one tick.
    #[inline(always)]
    pub fn advance(&mut self) {
        self.k = self.k.wrapping_add(1);
        if self.k >= self.current.count() {
            self.take_up_next();
        }
    }

    /// Takes up what follows; segments without a tick are passed over.
    #[inline(never)]
    fn take_up_next(&mut self) {
        for _ in 0..=QUEUE {
            if self.k < self.current.count() {
                break;
            }
            self.k -= self.current.count();
            if let Some(next) = self.waiting.front() {
                self.current.copy_from(next);
                // Its copy has been taken.
                let _ = self.waiting.pop_front();
                self.holds = false;
            } else {
                // A hold that has run out goes on from where it is.
                if self.holds {
                    self.tail = self.tail.moved(state(&self.current, T::from_u32(u32::MAX)).angle);
                }
                self.current.copy_from(&self.tail);
                self.holds = true;
            }
        }
    }
}

#[inline(never)]
fn state<T: Scalar>(segment: &Segment<T>, ticks: T) -> JointState<T> {
    let (angle, rate, acceleration) = segment.angle_at(ticks);
    JointState { angle, rate, acceleration }
}

#[cfg(test)]
mod tests {
    use super::JointQueue;
    use crate::hub::Angle;
    use crate::{Move, Profile};

    /// In f32, ticks of a hold this long are counted in steps of two.
    #[test]
    fn a_move_begins_alike_after_a_long_hold() {
        let third = 1.0 / 3.0;
        let begun = |held: u32| {
            let mut queue = JointQueue::<f32, 4>::new(Angle { turns: 0, part: 0.1 });
            for _ in 0..held {
                queue.advance();
            }
            let turn = Move::To { profile: Profile::Quintic, duration: 0.5, to: 2.0 };
            queue.push(&turn, 0.01, |_| Ok(())).expect("a move");
            [queue.next_command(third), queue.next_command(third)]
        };
        assert_eq!(begun(1 << 25), begun(0));
    }

    /// Three ticks hold three of an S-curve's seven stretches, and the joint passes through all.
    #[test]
    fn a_move_is_followed_through_stretches_without_a_tick() {
        let (tick, third) = (0.01, 1.0 / 3.0);
        let turn = Move::To { profile: Profile::SCurve, duration: 3.0 * tick, to: 0.2 };
        let pushed = |tick| {
            let mut queue = JointQueue::<f64, 8>::new(Angle { turns: 0, part: 0.0 });
            queue.push(&turn, tick, |_| Ok(())).expect("a move");
            queue
        };
        // In sevenths of a tick every stretch holds three.
        let fine = pushed(tick / 7.0);
        let mut queue = pushed(tick);
        for k in 0..5 {
            let next = queue.next_command(third);
            for (at, ahead) in [(next.third, third), (next.end, 1.0)] {
                let same = fine.far(7.0 * (f64::from(k) + ahead));
                assert!(at.angle.since(same.angle).abs() < 1e-14, "{at:?} {same:?}");
                assert!((at.rate - same.rate).abs() < 1e-11, "{at:?} {same:?}");
                assert!((at.acceleration - same.acceleration).abs() < 1e-8, "{at:?} {same:?}");
            }
        }
    }
}
