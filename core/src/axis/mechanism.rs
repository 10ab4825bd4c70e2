//! The axes of one mechanism under one policy: its joints are switched on and off together, and a
//! stop brakes all of them along their common path.
//!
//! The table of [the module above](super) holds, each line for all joints. A joint's setpoint
//! is of the same type as that of a single hub: [`Drivetrain`](crate::motor::Drivetrain) and the
//! drives take it as it is.

use super::{Cause, Mode, Policy, Sequence, Supervisor, Timing, ticks};
use crate::Error;
use crate::chain::{Chain, ChainGenerator, ChainSetpoint};
use crate::hub::Angle;
use crate::math::Scalar;
use crate::motion::{MoveSummary, Plannable};

/// One tick's outcome for all joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MechanismTick<T, const LINKS: usize> {
    /// The tick's number, from 0.
    pub number: u32,
    /// The mode at this tick, of all joints.
    pub mode: Mode,
    /// The setpoints.
    pub setpoint: ChainSetpoint<T, LINKS>,
}

impl<T, const LINKS: usize> MechanismTick<T, LINKS> {
    /// Returns the number as it travels with a payload.
    pub fn sequence(&self) -> Sequence {
        Sequence(self.number as u16)
    }
}

/// A chain's generator and the policy of its joints.
#[derive(Clone, Debug)]
pub struct MechanismAxes<
    T: Scalar,
    const LINKS: usize,
    const W: usize,
    const C: usize,
    const Q: usize,
    const QUEUE: usize = 8,
> {
    generator: ChainGenerator<T, LINKS, W, C, Q, QUEUE>,
    supervisor: Supervisor,
    /// Ticks in a row that may be missed.
    allowed: u32,
}

impl<
    T: Scalar,
    const LINKS: usize,
    const W: usize,
    const C: usize,
    const Q: usize,
    const QUEUE: usize,
> MechanismAxes<T, LINKS, W, C, Q, QUEUE>
{
    /// Disabled axes that stand at `angles`, rad. Of each joint's policy the limits count for the
    /// joint. The least patience counts for all, and the least number of missed ticks. A stop keeps
    /// the limits of moves: limits of its own ([`Policy::stop`]) are not read.
    ///
    /// # Errors
    /// Those of [`ChainGenerator::new`] and [`ChainGenerator::limit`]; a driven joint without a
    /// limit of acceleration or deceleration, which a stop needs; a patience that is not within 0
    /// to 2³² ticks. What a policy says of a passive joint does not matter.
    pub fn new(
        chain: Chain<T, LINKS, W, C, Q>,
        angles: [f64; LINKS],
        policies: &[Policy; LINKS],
    ) -> Result<Self, Error> {
        let tick = chain.tick();
        let mut generator = ChainGenerator::new(chain, angles)?;
        let (mut patience, mut allowed) = (0, u32::MAX);
        for (joint, policy) in policies.iter().enumerate() {
            let closed = generator.state().is_closed();
            if !generator.chain().is_driven(joint, closed) {
                continue;
            }
            generator.limit(joint, policy.limits)?;
            let own = ticks("policy.patience", policy.patience, tick)?;
            // 0 waits for ever.
            patience = if patience == 0 || (own > 0 && own < patience) { own } else { patience };
            allowed = allowed.min(policy.missed);
        }
        generator.can_stop()?;
        Ok(Self { generator, supervisor: Supervisor::new(patience), allowed })
    }

    /// The next setpoints of all joints. The tick path: no allocation, no panic, no `Result`.
    #[inline(always)]
    pub fn tick(&mut self) -> MechanismTick<T, LINKS> {
        if self.supervisor.listen() {
            self.stop(Cause::LinkLost);
        }
        let setpoint = self.generator.tick();
        let number = self.supervisor.number();
        self.supervisor.end_stop(|| !self.generator.is_stopping());
        MechanismTick { number, mode: self.mode(), setpoint }
    }

    /// The next setpoints if the tick that came is due. `None` for one that is not due: nothing has
    /// changed, and nothing is to be sent.
    #[inline(always)]
    pub fn tick_if_due(&mut self, timing: &Timing) -> Option<MechanismTick<T, LINKS>> {
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
        if ticks > self.allowed {
            self.stop(Cause::MissedTicks);
        }
    }

    /// Notes a valid message from the host.
    pub fn heard(&mut self) {
        self.supervisor.heard();
    }

    /// Switches all joints on. Disabled axes begin at the measured angles, in static equilibrium;
    /// stopped ones go on where they hold. What is measured of a passive joint is not looked at.
    /// Computes in f64 and is not for the tick's interrupt.
    ///
    /// # Errors
    /// [`Error::WrongMode`] during a stop, those of [`Chain::at_rest`]. Nothing has changed then.
    pub fn enable(&mut self, measured: &[Angle<T>; LINKS]) -> Result<(), Error> {
        match self.mode() {
            Mode::Disabled => {
                self.generator.restart(&measured.map(|angle| angle.precise().radians()))?;
            }
            Mode::Stopped | Mode::Enabled => {}
            mode @ Mode::Stopping => return Err(Error::WrongMode { mode }),
        }
        self.supervisor.enable();
        Ok(())
    }

    /// Switches all joints off, after a stop if one of them turns.
    pub fn disable(&mut self) {
        if self.mode() != Mode::Disabled {
            self.stop(Cause::Requested);
            self.supervisor.disable();
        }
    }

    /// Brakes all joints along their common path, and holds.
    #[cold]
    #[inline(never)]
    pub fn stop(&mut self, cause: Cause) {
        if self.mode() != Mode::Enabled {
            return;
        }
        // Every driven joint has the limit that a stop needs: `new` has asked.
        let moves = !self.generator.rests() && self.generator.stop().is_ok();
        self.supervisor.stop(cause, moves);
    }

    /// Plans a move of `joint`, counted from 0, behind its others. Runs in f64 and is not for the
    /// tick's interrupt.
    ///
    /// # Errors
    /// [`Error::WrongMode`] unless the axes are enabled, those of [`ChainGenerator::push`].
    pub fn push(&mut self, joint: usize, motion: &impl Plannable) -> Result<MoveSummary, Error> {
        self.supervisor.check_enabled()?;
        self.generator.push(joint, motion)
    }

    /// The mode of all joints.
    pub fn mode(&self) -> Mode {
        self.supervisor.mode
    }

    /// Returns why the axes stopped, if they did.
    pub fn cause(&self) -> Option<Cause> {
        self.supervisor.cause
    }

    /// Number of the next tick.
    pub fn clock(&self) -> u32 {
        self.supervisor.clock
    }

    /// The generator.
    pub fn generator(&self) -> &ChainGenerator<T, LINKS, W, C, Q, QUEUE> {
        &self.generator
    }
}
