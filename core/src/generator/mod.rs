//! The one type the firmware drives.

mod handover;
mod redirect;
mod stop;

pub use handover::{Departure, Planned};
use heapless::Deque;
pub(crate) use redirect::Branch;
pub(crate) use stop::Arrival;

use crate::Error;
use crate::hub::{Angle, HubState};
use crate::math::Scalar;
use crate::motion::{Limits, Move, Outline, Plan, Remedy, Segment, lay};
use crate::stepper::{Response, Stepper};

/// What the motor controller gets every tick. SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Setpoint<T> {
    /// Hub angle θ.
    pub angle: Angle<T>,
    /// θ̇, rad/s.
    pub rate: T,
    /// θ̈, rad/s²; where it jumps, the right-hand value.
    pub acceleration: T,
    /// Torque into the hub by inverse dynamics, N m.
    pub torque: T,
    /// The tip in the hub frame `(X, Y)`, m: X along the link where it is clamped.
    pub tip: [T; 2],
}

impl<T: Scalar> Setpoint<T> {
    /// The tip's deflection, its hub-frame Y, m.
    #[inline(always)]
    pub fn deflection(&self) -> T {
        self.tip[1]
    }

    /// The tip in the global frame `(x, y)`, m: the hub's angle turns it, by sine and cosine that
    /// a tick has no need of.
    #[inline(always)]
    pub fn global_tip(&self) -> [T; 2] {
        let ([x, y], (sin, cos)) = (self.tip, self.angle.sin_cos());
        [x * cos - y * sin, x * sin + y * cos]
    }
}

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
    /// Ticks since the current segment's first; wraps to 0 at the very first tick.
    k: u32,
    /// Below this many, ticks of the current segment are [plain](Stepper::is_plain) ones in a cubic.
    plain: u32,
    holding: bool,
    /// The hub rests until the current segment ends.
    resting: bool,
    /// The hub is at rest and the arm with it: see [`Stepper::is_settled`].
    asleep: bool,
    hub: HubState<S::Scalar>,
    /// θ̈ just before the current segment began; within it, there is no other than the hub's.
    landing: S::Scalar,
    current: Segment<S::Scalar>,
    state: S::State,
    stepper: S,
    /// What follows the queue: its end, held.
    tail: Segment<S::Scalar>,
    /// The tail's start in set-up's precision.
    end: HubState<f64>,
    limits: Limits,
    queue: Deque<Segment<S::Scalar>, QUEUE>,
}

impl<S: Stepper, const QUEUE: usize> Generator<S, QUEUE> {
    /// An arm at rest in static equilibrium at hub angle `from`, rad.
    pub fn new(stepper: S, from: f64) -> Result<Self, Error> {
        let end = HubState::resting_at(from)?;
        let tail = hold(end, stepper.tick());
        // The hold before the first tick has no length: a move pushed now begins at t = 0.
        let mut current = tail;
        current.cut(0);
        let mut hub = HubState::ZERO;
        current.begin(&mut hub);
        if stepper.is_directed() {
            hub.update_sin_cos();
        }
        let state = stepper.equilibrium(&hub);
        Ok(Self {
            stepper,
            state,
            hub,
            landing: S::Scalar::ZERO,
            current,
            k: u32::MAX,
            plain: 0,
            queue: Deque::new(),
            tail,
            end,
            limits: Limits::default(),
            holding: true,
            resting: false,
            asleep: false,
        })
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
    pub fn push(&mut self, motion: &Move) -> Result<Outline, Error> {
        let (start, tick) = (self.next_start(), self.stepper.tick());
        let (mut needed, free) = (0, QUEUE - self.queue.len());
        let outline = lay(motion, start, &self.limits, tick, &mut |segment| {
            needed += 1;
            // A full queue gives it back; told below.
            let _ = self.queue.push_back(*segment);
        })?;
        let fits = if needed > free { Err(Error::QueueFull { needed, free }) } else { Ok(()) };
        if let Err(error) = fits.and(self.stepper.admit(&outline.peaks, outline.end.rate)) {
            for _ in 0..needed.min(free) {
                self.queue.pop_back();
            }
            return Err(error);
        }
        self.end_hold();
        self.end = outline.end;
        self.tail = hold(outline.end, tick);
        Ok(outline)
    }

    /// What would keep the limits, for a move that [`Self::push`] refuses now for one of them. Computed
    /// apart from the refusal: a target that does not ask does not link it.
    pub fn remedy(&self, motion: &Move) -> Remedy {
        Plan::remedy(motion, self.next_start(), &self.limits, self.stepper.tick())
    }

    /// The next setpoint. Never fails, never allocates; the same operations on host and target.
    #[inline(always)]
    pub fn tick(&mut self) -> Setpoint<S::Scalar> {
        let k = self.next_k();
        if S::PLAIN && k < self.plain {
            let before = self.hub;
            self.k = k;
            self.current.drive_cubic(&mut self.hub, k);
            let response = self.stepper.advance_in_cubic(&mut self.state, &before, &self.hub);
            respond(&self.hub, response)
        } else if S::RESTS && self.resting {
            self.tick_at_rest(k)
        } else {
            self.tick_otherwise(k)
        }
    }

    /// All other ticks, out of the way of the plain ones, which then need not save the registers that
    /// these take.
    #[inline(never)]
    fn tick_otherwise(&mut self, k: u32) -> Setpoint<S::Scalar> {
        let before = self.hub;
        let mut landing = None;
        let mut at_rest = false;
        let mut rested = false;
        self.k = k;
        if k >= self.current.count() {
            rested = self.resting;
            self.turn_over();
            landing = Some(self.landing);
        } else if S::RESTS || !self.resting {
            self.current.drive(&mut self.hub, k);
            if self.stepper.is_directed() {
                self.hub.update_sin_cos();
            }
        } else if self.asleep {
            return self.setpoint();
        } else {
            at_rest = true;
        }
        let acceleration = landing.unwrap_or(self.hub.acceleration);
        let arrival = HubState { acceleration, ..self.hub };
        if S::RESTS && rested {
            // The last tick of a rest as all others of it, to the bit.
            self.stepper.swing(&mut self.state, &arrival);
        } else {
            // The first tick too: the arm was at rest before it, and stays so.
            self.stepper.step(&mut self.state, &before, &arrival);
        }
        if at_rest {
            self.asleep = self.holding && self.stepper.is_settled(&self.state);
        }
        self.setpoint()
    }

    /// A tick of a hub that rests: the arm rings, or sleeps.
    #[inline(never)]
    fn tick_at_rest(&mut self, k: u32) -> Setpoint<S::Scalar> {
        if k >= self.current.count() {
            return self.tick_otherwise(k);
        }
        self.k = k;
        if !self.asleep {
            self.stepper.swing(&mut self.state, &self.hub);
            self.asleep = self.holding && self.stepper.is_settled(&self.state);
        }
        respond(&self.hub, self.stepper.response_at_rest(&self.state, &self.hub))
    }

    /// The latest setpoint again.
    #[inline(always)]
    pub fn setpoint(&self) -> Setpoint<S::Scalar> {
        respond(&self.hub, self.stepper.response(&self.state, &self.hub))
    }

    /// The latest setpoint as it was just before: it differs where a move has ended with an
    /// acceleration, which the torque jumps with.
    pub fn setpoint_before(&self) -> Setpoint<S::Scalar> {
        let hub = HubState { acceleration: self.landing(), ..self.hub };
        respond(&hub, self.stepper.response(&self.state, &hub))
    }

    /// The hub rests and the arm with it, within [`SLEEP`](crate::stepper::SLEEP): it is left as it is
    /// until the next move.
    pub fn is_asleep(&self) -> bool {
        self.asleep
    }

    /// No move under way or waiting.
    pub fn is_holding(&self) -> bool {
        self.queue.is_empty() && self.holding
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

    /// Index of the coming tick in the current segment.
    #[inline(always)]
    fn next_k(&self) -> u32 {
        self.k.wrapping_add(1)
    }

    /// θ̈ just before the latest setpoint.
    fn landing(&self) -> S::Scalar {
        if self.next_k() <= 1 { self.landing } else { self.hub.acceleration }
    }

    /// Ends a hold at the next tick, where the queue goes on.
    ///
    /// The path of its ticks stays as it is: a hold is no cubic, so none of its ticks is plain, and
    /// whether the hub rests does not depend on the count.
    fn end_hold(&mut self) {
        if self.holding {
            self.current.cut(self.next_k());
        }
    }

    /// Decides which way the ticks of the current segment go. To be called whenever the current
    /// segment is another one, and when a cubic is broken off, whose plain ticks are counted.
    #[inline(always)]
    fn set_path(&mut self) {
        let plain =
            S::PLAIN && self.current.is_cubic() && self.stepper.is_plain(self.current.rate_bound());
        self.plain = if plain { self.current.count() } else { 0 };
        self.resting = self.current.is_rest();
    }

    /// Where a move that is pushed now begins.
    fn next_start(&self) -> HubState<f64> {
        if self.queue.is_empty() && self.holding {
            let angle = self.current.angle(self.next_k());
            let angle = Angle { turns: angle.turns, part: angle.part.to_f64() };
            HubState::turning(angle, self.end.rate)
        } else {
            self.end
        }
    }

    /// Takes up the next segment, or the hold: apart, for the registers that it takes.
    #[inline(never)]
    fn turn_over(&mut self) {
        self.asleep = false;
        self.landing = self.current.landing();
        match self.queue.front() {
            Some(segment) => {
                // Copied once, not by way of what `pop_front` returns.
                self.current.become_like(segment);
                let _ = self.queue.pop_front();
                self.holding = false;
            }
            None if self.holding => self.current = self.renewed(),
            None => {
                self.current.become_like(&self.tail);
                self.holding = true;
            }
        }
        self.k = 0;
        self.set_path();
        self.current.begin(&mut self.hub);
        if self.stepper.is_directed() {
            self.hub.update_sin_cos();
        }
        self.stepper.shift(&mut self.state, self.current.entry());
    }

    /// A hold that has run out (after 497 days at 10 ms) goes on from where it is.
    #[cold]
    #[inline(never)]
    fn renewed(&self) -> Segment<S::Scalar> {
        self.tail.moved(self.current.angle(self.k))
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
