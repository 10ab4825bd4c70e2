//! The one type the firmware drives.

mod change;
mod current;
mod follow;
mod handover;
mod motion_end;
mod reach;
mod redirect;
mod setpoint;
mod stop;
mod stream;

pub(crate) use change::Replaced;
use current::{Current, Part};
pub use handover::{PlanContext, PlannedMove};
use heapless::Deque;
use motion_end::MotionEnd;
pub(crate) use redirect::Branch;
pub use setpoint::Setpoint;
pub(crate) use stop::Arrival;

use crate::Error;
use crate::hub::HubState;
use crate::math::Scalar;
use crate::motion::{Limits, Move, MoveSummary, Plan, Plannable, Remedy, Segment};
use crate::stepper::{AnyMotion, AtRest, KinkMoments, Linear, Response, Stepper};

/// A queue of moves and the arm that follows them: one [`Generator::tick`] a tick.
///
/// `S` is the stepper, `QUEUE` the segments that can wait: a cubic, quintic, cycloid, spin-up or
/// dwell takes one, a trapezoid three, an S-curve seven.
///
/// Call k of `tick` (from 0) returns the setpoint at `t = k h`. With the queue empty the hub holds
/// its angle, or its rate after a spin-up.
// In this order, because a Cortex-M4 reaches floats up to 1,020 bytes from a base address in one
// instruction: with the queue in between, a tick of one element can take 45 more of them.
#[repr(C)]
#[derive(Clone, Debug)]
pub struct Generator<S: Stepper, const QUEUE: usize = 8> {
    current: Current<S::Scalar>,
    hub: HubState<S::Scalar>,
    /// θ̈ just before the current segment began, rad/s². Within a segment θ̈ does not jump.
    end_acceleration: S::Scalar,
    state: S::State,
    stepper: S,
    /// Segment behind the queue: holds the queue's end.
    tail: Segment<S::Scalar>,
    /// The tail's start in set-up's precision.
    end: HubState<f64>,
    limits: Limits,
    queue: Deque<Segment<S::Scalar>, QUEUE>,
    /// Counts the changes of the queue, but for those that a tick makes.
    revision: u32,
    /// h in the precision of the tick, s.
    tick: S::Scalar,
}

impl<S: Stepper, const QUEUE: usize> Generator<S, QUEUE> {
    /// An arm at rest in static equilibrium at hub angle `from`, rad.
    pub fn new(stepper: S, from: f64) -> Result<Self, Error> {
        let end = HubState::resting_at(from)?;
        let mut hub = HubState::at_rest(end.angle.cast());
        stepper.gravity().aim(&mut hub);
        let state = stepper.equilibrium(&hub);
        Ok(Self::resting(stepper, state, hub, end))
    }

    /// An arm in the state `state` on a hub that rests, `hub` and, in set-up's precision, `end`.
    /// Apart from what may fail, so that it is made where it is kept: a copy would take as much of
    /// the stack again.
    #[inline]
    fn resting(stepper: S, state: S::State, hub: HubState<S::Scalar>, end: HubState<f64>) -> Self {
        let tail = hold(end, stepper.tick());
        Self {
            tick: S::Scalar::from_f64(stepper.tick()),
            stepper,
            state,
            hub,
            end_acceleration: S::Scalar::ZERO,
            current: Current::unstarted(&tail),
            queue: Deque::new(),
            tail,
            end,
            limits: Limits::default(),
            revision: 0,
        }
    }

    /// Refuses from now on the moves that exceed `limits`, which are those of the hub's motion.
    ///
    /// # Errors
    /// A limit of torque or moment, which a generator cannot keep: see [`Limits`].
    pub fn limit(&mut self, limits: Limits) -> Result<(), Error> {
        self.limits = limits.validate()?.of_motion()?;
        Ok(())
    }

    /// Plans a move and puts it behind the others; with none waiting it begins at the next tick.
    ///
    /// Runs in f64 and is not for the tick's interrupt. Either the whole move is taken or nothing
    /// changes.
    pub fn push(&mut self, motion: &impl Plannable) -> Result<MoveSummary, Error> {
        let (start, tick) = (self.next_start(), self.stepper.tick());
        let (mut needed, free) = (0, QUEUE - self.queue.len());
        let (mut moment, mut motion_end) = (self.border_moment(), MotionEnd::new());
        let summary = motion.plan_segments(start, &self.limits, tick, &mut |segment| {
            if motion_end.holds_tick(segment) {
                needed += 1;
                // A full queue gives it back; told below.
                let _ = self.queue.push_back(segment.behind(&mut moment));
            }
        })?;
        let fits = if needed > free { Err(Error::QueueFull { needed, free }) } else { Ok(()) };
        if let Err(error) = fits.and(self.stepper.admit(&summary.peaks, summary.end.rate)) {
            for _ in 0..needed.min(free) {
                self.queue.pop_back();
            }
            return Err(error);
        }
        self.current.end_hold();
        self.revision = self.revision.wrapping_add(1);
        self.end = summary.end;
        self.tail = hold(summary.end, tick);
        self.tail.set_kink_moment(motion_end.close(self.queue.back_mut()));
        Ok(summary)
    }

    /// Returns a change that keeps the limits, for a move that [`Self::push`] now refuses because
    /// of one of them. Separate from the refusal, so that a target which does not call it does not
    /// link it.
    pub fn remedy(&self, motion: &Move) -> Remedy {
        Plan::remedy(motion, self.next_start(), &self.limits, self.stepper.tick())
    }

    /// Returns `motion` with the shortest duration in whole ticks in which [`Self::push`] now takes
    /// it: see [`Plan::shortest`].
    ///
    /// # Errors
    /// As in [`Plan::shortest`].
    pub fn shortest(&self, motion: &Move) -> Result<Move, Error> {
        Plan::shortest(motion, self.next_start(), &self.limits, self.stepper.tick())
    }

    /// The next setpoint. Never fails, never allocates; the same operations on host and target.
    #[inline(always)]
    pub fn tick(&mut self) -> Setpoint<S::Scalar> {
        let k = self.current.next_k();
        if S::FAST.linear && self.current.is_linear(k) {
            let before = self.hub;
            self.current.advance_to(k);
            self.current.segment().drive_cubic(&mut self.hub, k);
            self.stepper.step::<Linear>(&mut self.state, &before, &self.hub);
            respond(&self.hub, self.stepper.response::<Linear>(&self.state, &self.hub))
        } else if S::FAST.at_rest && self.current.is_at_rest(k) {
            self.tick_at_rest(k)
        } else {
            self.tick_any(k)
        }
    }

    /// Makes a tick of any kind. Apart from the linear ones, which then need not save the registers
    /// that these take.
    #[inline(never)]
    fn tick_any(&mut self, k: u32) -> Setpoint<S::Scalar> {
        let before = self.hub;
        let rests = self.current.rests();
        let mut end_acceleration = None;
        self.current.advance_to(k);
        if k >= self.current.segment().count() {
            self.take_up_next();
            end_acceleration = Some(self.end_acceleration);
        } else if S::FAST.at_rest || !rests {
            self.current.segment().drive(&mut self.hub, k);
            self.aim();
        } else if self.current.is_asleep() {
            return self.setpoint();
        }
        let acceleration = end_acceleration.unwrap_or(self.hub.acceleration);
        let arrival = HubState { acceleration, ..self.hub };
        if S::FAST.at_rest && rests {
            if S::FAST.large {
                self.end_rest();
            } else {
                // The last tick of a rest as all others of it, to the bit.
                self.stepper.step::<AtRest>(&mut self.state, &arrival, &arrival);
            }
        } else {
            // The first tick too: the arm was at rest before it, and stays so.
            self.stepper.step::<AnyMotion>(&mut self.state, &before, &arrival);
        }
        if !S::FAST.at_rest && rests && end_acceleration.is_none() {
            self.current.sleep_if(|| self.stepper.is_settled(&self.state));
        }
        self.setpoint()
    }

    /// Advances the arm by the last tick of a rest as by all others of it, to the bit: by the same
    /// code, which is then linked once. The hub is at the first tick of the next segment.
    #[inline(never)]
    fn end_rest(&mut self) {
        let acceleration = core::mem::replace(&mut self.hub.acceleration, self.end_acceleration);
        self.tick_at_rest(self.current.k());
        self.hub.acceleration = acceleration;
        // It may sleep from the next tick on.
        self.current.wake();
    }

    /// Makes a tick of a hub that rests: the arm vibrates, or sleeps.
    #[inline(never)]
    fn tick_at_rest(&mut self, k: u32) -> Setpoint<S::Scalar> {
        self.current.advance_to(k);
        if !self.current.is_asleep() {
            self.stepper.step::<AtRest>(&mut self.state, &self.hub, &self.hub);
            self.current.sleep_if(|| self.stepper.is_settled(&self.state));
        }
        respond(&self.hub, self.stepper.response::<AtRest>(&self.state, &self.hub))
    }

    /// Returns the latest setpoint again.
    #[inline(always)]
    pub fn setpoint(&self) -> Setpoint<S::Scalar> {
        respond(&self.hub, self.stepper.response::<AnyMotion>(&self.state, &self.hub))
    }

    /// Returns the left-hand value of the latest setpoint. It differs where a move has ended with
    /// an acceleration: there the torque jumps with the acceleration.
    pub fn setpoint_before(&self) -> Setpoint<S::Scalar> {
        let hub = HubState { acceleration: self.acceleration_before(), ..self.hub };
        respond(&hub, self.stepper.response::<AnyMotion>(&self.state, &hub))
    }

    /// True if hub and arm rest, the arm within [`SLEEP`](crate::stepper::SLEEP). Its state is left
    /// unchanged until the next move.
    pub fn is_asleep(&self) -> bool {
        self.current.is_asleep()
    }

    /// True if no move is under way or waiting.
    pub fn is_holding(&self) -> bool {
        self.queue.is_empty() && self.current.is_holding()
    }

    /// The arm's state at the latest setpoint.
    pub fn state(&self) -> &S::State {
        &self.state
    }

    /// The hub at the latest setpoint.
    pub fn hub(&self) -> &HubState<S::Scalar> {
        &self.hub
    }

    /// The stepper.
    pub fn stepper(&self) -> &S {
        &self.stepper
    }

    /// θ̈ just before the latest setpoint, rad/s².
    fn acceleration_before(&self) -> S::Scalar {
        if self.current.next_k() <= 1 { self.end_acceleration } else { self.hub.acceleration }
    }

    /// Returns the start of a move that is pushed now.
    fn next_start(&self) -> HubState<f64> {
        if self.is_holding() {
            let angle = self.current.segment().angle(self.current.next_k());
            let follows = self.current.follows();
            let rate = if follows { self.hub.rate.to_f64() } else { self.end.rate };
            HubState::turning(angle.precise(), rate)
        } else {
            self.end
        }
    }

    /// Moment of the queue's end within the tick before the next move, see
    /// [`Segment::kink_moment`]: not zero if the motion before ends inside a tick, or with a
    /// stretch that holds none.
    fn border_moment(&self) -> S::Scalar {
        if self.is_holding() { S::Scalar::ZERO } else { self.tail.kink_moment() }
    }

    /// Takes up the next segment of the queue, or the hold behind it, and moves the hub to its
    /// first tick. A function of its own, for the registers that it takes.
    #[inline(never)]
    fn take_up_next(&mut self) {
        self.end_acceleration = self.current.segment().end_acceleration();
        if let Some(segment) = self.queue.front() {
            // Copied once, not by way of what `pop_front` returns.
            self.current.take_up(segment, Part::Move, 0, &self.stepper);
            let _ = self.queue.pop_front();
        } else {
            if self.current.is_holding() {
                self.renew_hold();
            }
            self.current.take_up(&self.tail, Part::Hold, 0, &self.stepper);
        }
        self.current.segment().begin(&mut self.hub);
        self.aim();
        let moment = self.current.segment().kink_moment();
        self.stepper.kink(&mut self.state, KinkMoments::First(moment));
    }

    /// Updates sine and cosine of gravity's angle in the hub frame, if it changes with the hub's.
    #[inline(always)]
    fn aim(&mut self) {
        let gravity = self.stepper.gravity();
        if gravity.follows_hub() {
            self.hub.update_sin_cos(gravity.in_turns());
        }
    }

    /// Lets a hold that has run out (after 497 days at 10 ms) go on from where it is, or a hub that
    /// is no longer [followed](Self::follow) from where it would be.
    #[cold]
    #[inline(never)]
    fn renew_hold(&mut self) {
        if self.current.follows() {
            self.tail = *self.current.segment();
            self.tail.cut(u32::MAX);
        }
        self.tail = self.tail.moved(self.current.segment().angle(self.current.k()));
        self.tail.set_kink_moment(S::Scalar::ZERO);
    }
}

/// The end of a move, held for as long as ticks can be counted.
#[inline(never)]
fn hold<T: Scalar>(end: HubState<f64>, tick: f64) -> Segment<T> {
    Segment::cruise(end.angle, end.rate, u32::MAX, tick)
}

#[inline(always)]
fn respond<T: Scalar>(hub: &HubState<T>, response: Response<T>) -> Setpoint<T> {
    let Response { torque, tip } = response;
    Setpoint { angle: hub.angle, rate: hub.rate, acceleration: hub.acceleration, torque, tip }
}

#[cfg(test)]
mod tests;
