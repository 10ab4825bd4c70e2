//! Following a hub that another program moves, tick by tick, in place of planned moves.

use super::{Generator, Setpoint};
use crate::hub::HubState;
use crate::math::Scalar;
use crate::motion::Segment;
use crate::stepper::{AnyMotion, AtRest, HubMotion, Linear, Stepper};

impl<S: Stepper, const QUEUE: usize> Generator<S, QUEUE> {
    /// The setpoint of a tick at which the hub is in the state `hub`, in place of [`Self::tick`].
    ///
    /// θ̈ is continuous in the tick and at its end. Angle, rate and acceleration are taken as they
    /// are: the caller answers for it that they belong together and keep the limits. Sine and
    /// cosine are computed here. Moves that wait are dropped. A [`Self::tick`] without a state goes
    /// on at the last one's rate.
    ///
    /// The bits are those of a queue that commands the same states, as long as it takes no fast
    /// path for a linear acceleration and its segments begin at ticks: see
    /// [`Self::follow_exactly`].
    #[inline(always)]
    pub fn follow(&mut self, hub: &HubState<S::Scalar>) -> Setpoint<S::Scalar> {
        self.follow_exactly(hub, hub.acceleration, false)
    }

    /// The setpoint of a tick, as [`Self::follow`], with all that a segment knows of it: θ̈ just
    /// before the tick, `acceleration_before` in rad/s², where it jumps there; and whether θ̈ is a
    /// straight line within the tick that ends there, as in a cubic.
    ///
    /// The bits are then those of a queue that commands the same states, if `linear` is true for
    /// every tick of a cubic but its first.
    #[inline(always)]
    pub fn follow_exactly(
        &mut self,
        hub: &HubState<S::Scalar>,
        acceleration_before: S::Scalar,
        linear: bool,
    ) -> Setpoint<S::Scalar> {
        let fast = |rate: S::Scalar| self.stepper.is_linear_fast(rate.abs());
        if S::FAST.linear && linear && fast(hub.rate) && fast(self.hub.rate) {
            self.step_to::<Linear>(hub, acceleration_before)
        } else {
            self.step_to::<AnyMotion>(hub, acceleration_before)
        }
    }

    #[inline(never)]
    fn step_to<M: HubMotion>(
        &mut self,
        hub: &HubState<S::Scalar>,
        acceleration_before: S::Scalar,
    ) -> Setpoint<S::Scalar> {
        let before = self.hub;
        let rested = self.current.rests();
        (self.hub.angle, self.hub.rate, self.hub.acceleration) =
            (hub.angle, hub.rate, hub.acceleration);
        self.aim();
        self.end_acceleration = acceleration_before;
        let arrival = HubState { acceleration: acceleration_before, ..self.hub };
        let stays = rested
            && hub.angle == before.angle
            && hub.rate == S::Scalar::ZERO
            && acceleration_before == S::Scalar::ZERO;
        if !stays {
            self.stepper.step::<M>(&mut self.state, &before, &arrival);
        } else if !self.current.is_asleep() {
            if S::FAST.at_rest {
                self.stepper.step::<AtRest>(&mut self.state, &arrival, &arrival);
            } else {
                self.stepper.step::<AnyMotion>(&mut self.state, &before, &arrival);
            }
            self.current.sleep_if(|| self.stepper.is_settled(&self.state));
        }
        self.queue.clear();
        self.revision = self.revision.wrapping_add(1);
        self.current.follow(&Segment::carried_on(&self.hub, self.tick));
        self.setpoint()
    }
}
