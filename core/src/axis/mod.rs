//! One axis under a policy: what happens when it is switched on and off, stopped, or left alone.
//! No clock and no bus: firmware calls [`Axis::tick_if_due`] in its interrupt, or [`Axis::tick`]
//! where ticks cannot come at the wrong time, and the requests from below.
//!
//! | event | what the setpoints do |
//! |---|---|
//! | power-up, enable | begin at the measured angle, at rest; no step |
//! | disable | brake along the path, then off |
//! | move refused, queue full, not enabled | nothing changes; the reason is returned |
//! | stop | brake along the path within the limits of a stop, then hold; moves are refused until enabled |
//! | link silent for the patience | as stop |
//! | another target, duration, hold, cancel | from the next tick on, without a jump |
//! | no state to follow | the acceleration is kept; beyond the allowed number of ticks, as stop |
//! | no next row of a path | brake along the path behind the last row, then hold |
//! | drive silent ([`Cause::DriveLost`]) | as stop |
//! | drive faults or switches itself off ([`Cause::DriveFault`]) | as stop, then off: enabling begins where the shaft is then |
//! | late tick | nothing: setpoints count ticks, not seconds |
//! | missed ticks | the path waits: the next setpoint is the next on the path; beyond the allowed number, as stop |
//! | tick not due (a burst after a freeze) | no tick is made and nothing is sent; the path does not run ahead of time |
//! | new arm (payload) | at rest only; the angle stays, the torque is the new arm's |

mod change;
mod follow;
mod mechanism;
mod pace;
mod path;
mod policy;
mod sequence;
mod still;
mod supervisor;

use core::fmt;

pub use change::Change;
use follow::Reach;
use heapless::Deque;
pub use mechanism::{MechanismAxes, MechanismTick};
pub use pace::{Pace, Timing};
pub use policy::{Policy, StopLimits};
pub use sequence::{Freshness, Sequence};
use supervisor::Supervisor;

pub use crate::error::Mode;

use crate::generator::Arrival;
use crate::hub::{Angle, HubState};
use crate::math::Scalar;
use crate::motion::Braking;
use crate::stepper::Stepper;
use crate::{Error, Generator, PlanContext, PlannedMove, Setpoint};

/// The reason why the axis stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Cause {
    /// A stop was requested.
    Requested,
    /// The host was silent for longer than [`Policy::patience`].
    LinkLost,
    /// More ticks in a row were missed than are allowed.
    MissedTicks,
    /// No state to follow has come for more ticks in a row than are allowed.
    FollowLost,
    /// The drive has said nothing of itself for too long.
    DriveLost,
    /// The drive reports a fault, or is off without having been told so.
    DriveFault,
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Requested => "asked to stop",
            Self::LinkLost => "nothing heard from the host for too long",
            Self::MissedTicks => "too many ticks missed in a row",
            Self::FollowLost => "no state to follow for too many ticks in a row",
            Self::DriveLost => "nothing heard from the drive for too long",
            Self::DriveFault => "the drive reports a fault or has switched itself off",
        })
    }
}

/// One tick's outcome.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tick<T> {
    /// The tick's number, from 0.
    pub number: u32,
    /// The mode at this tick.
    pub mode: Mode,
    /// The setpoint.
    pub setpoint: Setpoint<T>,
}

impl<T> Tick<T> {
    /// Returns the number as it travels with a payload.
    pub fn sequence(&self) -> Sequence {
        Sequence(self.number as u16)
    }
}

/// A generator and its policy.
pub struct Axis<S: Stepper, const QUEUE: usize = 8> {
    generator: Generator<S, QUEUE>,
    policy: Policy,
    supervisor: Supervisor,
    /// Brakes as a move does, for a change of mind.
    braking: Braking<S::Scalar>,
    /// Brakes as a stop does.
    stopping: Braking<S::Scalar>,
    /// Ticks in a row without a state to follow.
    unfollowed: u32,
    reach: Reach<S::Scalar>,
    moves: Deque<Accepted, QUEUE>,
}

impl<S, const QUEUE: usize> fmt::Debug for Axis<S, QUEUE>
where
    S: Stepper + fmt::Debug,
    S::State: fmt::Debug,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Axis")
            .field("supervisor", &self.supervisor)
            .field("policy", &self.policy)
            .field("generator", &self.generator)
            .finish_non_exhaustive()
    }
}

/// A move that was accepted and is not over.
#[derive(Clone, Copy, Debug)]
struct Accepted {
    /// Number of its first tick.
    begin: u32,
    /// Number of the tick at which the hub is at `end`.
    arrival: u32,
    end: HubState<f64>,
}

impl<S: Stepper, const QUEUE: usize> Axis<S, QUEUE> {
    /// A disabled axis that stands at `angle`.
    ///
    /// # Errors
    /// `policy.patience` is not within 0 to 2³² ticks; limits that are not
    /// [those of a policy](Policy::limits); a stop that is softer than a move.
    pub fn new(stepper: S, angle: Angle<S::Scalar>, policy: Policy) -> Result<Self, Error> {
        let patience = ticks("policy.patience", policy.patience, stepper.tick())?;
        let braking = Braking::new(&policy.limits, stepper.tick())?;
        let stopping = Braking::new(&policy.limits_of_stop()?, stepper.tick())?;
        let reach = Reach::new(&policy.limits, stepper.tick());
        let mut generator = Generator::new(stepper, 0.0)?;
        generator.limit(policy.limits)?;
        generator.restart(angle);
        Ok(Self {
            generator,
            policy,
            supervisor: Supervisor::new(patience),
            braking,
            stopping,
            unfollowed: 0,
            reach,
            moves: Deque::new(),
        })
    }

    /// The next setpoint. The tick path: no allocation, no panic, no `Result`.
    #[inline(always)]
    pub fn tick(&mut self) -> Tick<S::Scalar> {
        self.tick_by(Generator::tick)
    }

    /// The next setpoint, as [`Axis::tick`] makes it. `advance` is [`Generator::tick`], or a
    /// function of a user's that calls it: one in a crate of its own can be compiled for speed
    /// while the policy is compiled for size.
    #[inline(always)]
    pub fn tick_by(
        &mut self,
        advance: impl FnOnce(&mut Generator<S, QUEUE>) -> Setpoint<S::Scalar>,
    ) -> Tick<S::Scalar> {
        self.listen();
        let setpoint = advance(&mut self.generator);
        self.done(setpoint)
    }

    /// Stops if the host has been silent for too long.
    #[inline(always)]
    fn listen(&mut self) {
        if self.supervisor.listen() {
            self.stop(Cause::LinkLost);
        }
    }

    /// Numbers a tick and notes what ends with it.
    #[inline(always)]
    fn done(&mut self, setpoint: Setpoint<S::Scalar>) -> Tick<S::Scalar> {
        let number = self.supervisor.number();
        while self.moves.front().is_some_and(|first| !before(number, first.arrival)) {
            self.moves.pop_front();
        }
        self.supervisor.end_stop(|| self.generator.is_holding());
        Tick { number, mode: self.mode(), setpoint }
    }

    /// The next setpoint if the tick that came is due: the same path as [`Axis::tick`], with the
    /// policy for ticks that come at the wrong time. `None` for one that is not due: nothing has
    /// changed, nothing is to be sent, and the drive keeps the setpoint that it has.
    #[inline(always)]
    pub fn tick_if_due(&mut self, timing: &Timing) -> Option<Tick<S::Scalar>> {
        if !timing.due {
            return None;
        }
        self.missed(timing.missed);
        Some(self.tick())
    }

    /// Notes that `ticks` ticks did not take place before the coming one. The time without a
    /// message from the host includes them.
    #[inline(always)]
    pub fn missed(&mut self, ticks: u32) {
        self.supervisor.missed(ticks);
        if ticks > self.policy.missed {
            self.stop(Cause::MissedTicks);
        }
    }

    /// Notes a valid message from the host.
    pub fn heard(&mut self) {
        self.supervisor.heard();
    }

    /// Switches on. A disabled axis begins at the measured angle, a stopped one goes on where it
    /// holds.
    pub fn enable(&mut self, measured: Angle<S::Scalar>) -> Result<(), Error> {
        match self.mode() {
            Mode::Disabled => self.generator.restart(measured),
            Mode::Stopped | Mode::Enabled => {}
            mode @ Mode::Stopping => return Err(Error::WrongMode { mode }),
        }
        self.supervisor.enable();
        self.unfollowed = 0;
        Ok(())
    }

    /// Switches off, after a stop if the hub turns.
    pub fn disable(&mut self) {
        if self.mode() != Mode::Disabled {
            self.stop(Cause::Requested);
            self.supervisor.disable();
        }
    }

    /// Brakes and holds.
    #[cold]
    pub fn stop(&mut self, cause: Cause) {
        if self.mode() != Mode::Enabled {
            return;
        }
        self.generator.brake(&self.stopping, self.arrival());
        self.moves.clear();
        self.supervisor.stop(cause, !self.generator.is_holding());
    }

    /// Returns the start and the limits of a move that is planned now, for [`PlanContext::plan`]
    /// and [`PlanContext::plan_still`]. Those run outside of the tick.
    pub fn plan_context(&self) -> Result<PlanContext, Error> {
        self.supervisor.check_enabled()?;
        Ok(self.generator.plan_context())
    }

    /// Takes a planned move and returns the number of its first tick.
    pub fn take(&mut self, planned: &PlannedMove<S::Scalar>) -> Result<u32, Error> {
        self.supervisor.check_enabled()?;
        if self.moves.is_full() {
            return Err(Error::QueueFull { needed: 1, free: 0 });
        }
        self.generator.take(planned)?;
        let begin = self.moves.back().map_or(self.clock(), |last| last.arrival);
        let arrival = begin.wrapping_add(planned.summary().ticks);
        // There is room: just asked.
        let end = self.generator.end();
        let _ = self.moves.push_back(Accepted { begin, arrival, end });
        Ok(begin)
    }

    /// Replaces the arm on the same hub, as when a payload is taken up or put down. At rest only.
    pub fn replace(&mut self, stepper: S) -> Result<(), Error> {
        if !self.rests() {
            return Err(Error::Moving);
        }
        self.generator.replace(stepper);
        Ok(())
    }

    /// True if the hub is at rest and no move waits.
    pub fn rests(&self) -> bool {
        self.generator.is_holding() && self.generator.hub().rate == S::Scalar::ZERO
    }

    /// The mode.
    pub fn mode(&self) -> Mode {
        self.supervisor.mode
    }

    /// Returns why the axis stopped, if it did.
    pub fn cause(&self) -> Option<Cause> {
        self.supervisor.cause
    }

    /// Number of the next tick.
    pub fn clock(&self) -> u32 {
        self.supervisor.clock
    }

    /// The generator.
    pub fn generator(&self) -> &Generator<S, QUEUE> {
        &self.generator
    }

    /// Returns the end of the move under way, if it comes to rest.
    fn arrival(&self) -> Option<Arrival> {
        self.under_way().filter(|arrival| arrival.end.rate == 0.0)
    }
}

/// A time in ticks, to the nearest; a time that is not 0 is one tick at least.
fn ticks(parameter: &'static str, time: f64, tick: f64) -> Result<u32, Error> {
    Error::check(parameter, time, 0.0, f64::from(u32::MAX) * tick, "s")?;
    let ticks = (time / tick + 0.5) as u32;
    Ok(if time > 0.0 { ticks.max(1) } else { 0 })
}

/// True if tick number `a` comes before `b`. Numbers wrap after 2³² ticks, 497 days at 10 ms.
fn before(a: u32, b: u32) -> bool {
    b.wrapping_sub(a) as i32 > 0
}
