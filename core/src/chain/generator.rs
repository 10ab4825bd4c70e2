//! A queue of moves a joint, and the chain that follows them.

use super::queue::JointQueue;
use super::stop::Stop;
use super::{Chain, ChainState, Command, JointState};
use crate::Error;
use crate::generator::Setpoint;
use crate::hub::Angle;
use crate::math::{Scalar, array};
use crate::mechanism::of_joint;
use crate::motion::{Limits, MoveSummary, Plannable};

/// Setpoints of all joints, one every tick, with the places that follow from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainSetpoint<T, const LINKS: usize> {
    /// Setpoint of each joint. Its angle is relative, its torque 0 if the joint is passive, its tip
    /// the end of the joint's own link in that link's frame: X along the clamp. Where the
    /// acceleration jumps all values are those before the jump.
    pub joints: [Setpoint<T>; LINKS],
    /// End of every link in the global frame `(x, y)`, m: the next joint, the last one the tip.
    pub ends: [[T; 2]; LINKS],
}

impl<T: Scalar, const LINKS: usize> ChainSetpoint<T, LINKS> {
    /// The tip in the global frame `(x, y)`, m.
    pub fn tip(&self) -> [T; 2] {
        self.ends[LINKS - 1]
    }
}

/// A chain and the moves of its joints: one [`Self::tick`] a tick.
///
/// Call k of `tick` (from 0) returns the setpoints at `t = k h`. A joint without a move holds its
/// angle, or its rate after a spin-up. Moves of different joints that are pushed before the same
/// tick begin together.
#[derive(Clone, Debug)]
pub struct ChainGenerator<
    T: Scalar,
    const LINKS: usize,
    const W: usize,
    const C: usize,
    const Q: usize,
    const QUEUE: usize = 8,
> {
    pub(super) state: ChainState<T, LINKS, W>,
    pub(super) queues: [JointQueue<T, QUEUE>; LINKS],
    pub(super) chain: Chain<T, LINKS, W, C, Q>,
    pub(super) third: T,
    pub(super) stop: Option<Stop<T>>,
    /// Number of the coming tick.
    pub(super) next: u32,
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
    /// The chain at rest in static equilibrium, its driven joints at `from`, rad. What `from` says
    /// of a passive joint does not matter.
    ///
    /// # Errors
    /// Those of [`Chain::at_rest`].
    pub fn new(chain: Chain<T, LINKS, W, C, Q>, from: [f64; LINKS]) -> Result<Self, Error> {
        let state = chain.at_rest(&from)?;
        Ok(Self::from_state(chain, state))
    }

    /// The chain in that state, its driven joints at rest.
    pub fn from_state(chain: Chain<T, LINKS, W, C, Q>, state: ChainState<T, LINKS, W>) -> Self {
        Self {
            queues: state.joints.map(|joint| JointQueue::new(joint.angle)),
            state,
            chain,
            third: T::from_f64(1.0 / 3.0),
            stop: None,
            next: 0,
        }
    }

    /// Refuses from now on the moves of `joint` that exceed `limits`.
    ///
    /// # Errors
    /// A joint that does not exist or has no motor, or a limit of torque or moment, which a
    /// generator cannot keep.
    pub fn limit(&mut self, joint: usize, limits: Limits) -> Result<(), Error> {
        self.driven("limits.joint", joint)?.limit(limits).map_err(|error| of_joint(error, joint))
    }

    /// Plans a move of `joint`, counted from 0, behind its others. Runs in f64 and is not for the
    /// tick's interrupt. Either the whole move is taken or nothing changes.
    ///
    /// # Errors
    /// A joint that does not exist, [`Error::PassiveJoint`], [`Error::Moving`] during a stop,
    /// [`Error::BendsTooFar`] if the links of an open chain are expected to bend further than the
    /// tick follows, and those of [`Generator::push`](crate::Generator::push).
    pub fn push(&mut self, joint: usize, motion: &impl Plannable) -> Result<MoveSummary, Error> {
        self.driven("moves.joint", joint)?;
        if self.stop.is_some() {
            return Err(Error::Moving);
        }
        let mut peaks = array(|j| self.queues[j].peak());
        let (chain, closed) = (&self.chain, self.state.is_closed());
        self.queues[joint].push(motion, chain.tick(), |peak| {
            peaks[joint] = peak;
            chain.admit(&peaks, closed)
        })
    }

    fn driven(
        &mut self,
        parameter: &'static str,
        joint: usize,
    ) -> Result<&mut JointQueue<T, QUEUE>, Error> {
        let number = (joint + 1) as f64;
        Error::check(parameter, number, 1.0, LINKS as f64, "as the joint's number")?;
        if !self.chain.is_driven(joint, self.state.is_closed()) {
            return Err(Error::PassiveJoint { parameter, joint: joint + 1 });
        }
        Ok(&mut self.queues[joint])
    }

    /// The next setpoints. Never fails, never allocates; the same operations on host and target.
    #[inline(always)]
    pub fn tick(&mut self) -> ChainSetpoint<T, LINKS> {
        if self.next > 0 {
            let commands = self.commands();
            self.chain.step(&mut self.state, &commands);
        }
        let setpoint = self.setpoint();
        if self.chain.closes_at() == Some(self.next) {
            self.chain.close(&mut self.state);
        }
        self.next = self.next.saturating_add(1);
        setpoint
    }

    /// Motion of the joints in the coming tick; the queues go on by it.
    #[inline(always)]
    fn commands(&mut self) -> [Command<T>; LINKS] {
        if let Some(stop) = self.stop {
            let [third, end] = self.stopping_commands(stop);
            return core::array::from_fn(|j| Command { third: third[j], end: end[j] });
        }
        let still = JointState::at_rest(Angle { turns: 0, part: T::ZERO });
        let mut commands = [Command { third: still, end: still }; LINKS];
        for (queue, command) in self.queues.iter_mut().zip(&mut commands) {
            *command = queue.next_command(self.third);
        }
        commands
    }

    /// The latest setpoints again. Directly after a chain has closed, those after its impact.
    #[inline(always)]
    pub fn setpoint(&self) -> ChainSetpoint<T, LINKS> {
        self.chain.setpoint(&self.state)
    }

    /// The chain's state at the latest setpoints.
    pub fn state(&self) -> &ChainState<T, LINKS, W> {
        &self.state
    }

    /// The chain.
    pub fn chain(&self) -> &Chain<T, LINKS, W, C, Q> {
        &self.chain
    }

    /// True if every driven joint rests, and no move is under way or waiting.
    pub fn rests(&self) -> bool {
        let closed = self.state.is_closed();
        let still =
            |j: usize| !self.chain.is_driven(j, closed) || self.state.joints[j].rate == T::ZERO;
        self.is_holding() && (0..LINKS).all(still)
    }

    /// Begins anew, at rest in static equilibrium with the driven joints at `angles`, rad. Limits
    /// stay. Set-up only.
    ///
    /// # Errors
    /// Those of [`Chain::at_rest`]. Nothing has changed then.
    pub fn restart(&mut self, angles: &[f64; LINKS]) -> Result<(), Error> {
        self.state = self.chain.at_rest(angles)?;
        for (queue, joint) in self.queues.iter_mut().zip(&self.state.joints) {
            queue.rest_at(joint.angle);
        }
        (self.stop, self.next) = (None, 0);
        Ok(())
    }

    /// True if no joint has a move under way or waiting.
    pub fn is_holding(&self) -> bool {
        self.stop.is_none() && self.queues.iter().all(JointQueue::is_holding)
    }
}

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Chain<T, LINKS, W, C, Q>
{
    /// True if a motor turns the joint, on an open chain or when it is closed.
    pub fn is_driven(&self, joint: usize, closed: bool) -> bool {
        let free = if closed { &self.closed } else { &self.open };
        joint < LINKS && !free[joint * W]
    }

    /// Setpoints for a state.
    #[inline(always)]
    pub fn setpoint(&self, state: &ChainState<T, LINKS, W>) -> ChainSetpoint<T, LINKS> {
        ChainSetpoint {
            joints: core::array::from_fn(|j| {
                let joint = &state.joints[j];
                Setpoint {
                    angle: joint.angle,
                    rate: joint.rate,
                    acceleration: joint.acceleration,
                    torque: state.torque[j],
                    tip: state.tips[j],
                }
            }),
            ends: state.ends,
        }
    }
}
