//! An axis that follows a hub which another program moves, and what it does when that is silent.

use super::{Axis, Cause, Tick};
use crate::error::Mode;
use crate::hub::HubState;
use crate::math::Scalar;
use crate::motion::Limits;
use crate::stepper::Stepper;

/// Bounds of the hub's motion from one tick to the next, in the scalar of the tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach<T> {
    tick: T,
    /// rad/s.
    rate: T,
    /// rad/s².
    acceleration: T,
    /// Change of the acceleration in a tick, rad/s².
    jerk: Option<T>,
    /// Change of the rate in a tick, rad/s.
    gain: T,
    /// Departure of the angle from the mean of the two rates, turns.
    departure: T,
}

/// Room for the rounding of given states.
const ROOM: f64 = 1.0 + 1e-4;

impl<T: Scalar> Reach<T> {
    pub(super) fn new(limits: &Limits, tick: f64) -> Self {
        let n = |value: f64| T::from_f64(ROOM * value);
        let unlimited = f64::from(f32::MAX);
        let acceleration = limits.acceleration.unwrap_or(unlimited);
        // A quarter of A h²: with full acceleration of one sign and then of the other.
        let departure = 0.25 * acceleration * tick * tick / core::f64::consts::TAU;
        Self {
            tick: T::from_f64(tick),
            rate: n(limits.rate.map_or(1.0 / tick, |rate| rate.min(1.0 / tick))),
            acceleration: n(acceleration),
            jerk: limits.jerk.map(|jerk| n(jerk * tick)),
            gain: n(acceleration * tick),
            departure: n(departure + T::EPSILON.to_f64()),
        }
    }

    /// True if a motion within the limits leads from one state to the other in a tick. False if
    /// anything is no number.
    fn spans(&self, from: &HubState<T>, to: &HubState<T>) -> bool {
        let mean = T::HALF * (from.rate + to.rate) * self.tick;
        let turned = to.angle.since(from.angle);
        let departure = turned - mean * T::from_f64(1.0 / core::f64::consts::TAU);
        let jerk = (to.acceleration - from.acceleration).abs();
        to.angle.part.abs() <= T::HALF
            && to.rate.abs() <= self.rate
            && to.acceleration.abs() <= self.acceleration
            && (to.rate - from.rate).abs() <= self.gain
            && departure.abs() <= self.departure
            && self.jerk.is_none_or(|most| jerk <= most)
    }

    /// The hub a tick later with the acceleration kept, or with none if it would turn too fast.
    fn carried_on(&self, hub: &HubState<T>) -> HubState<T> {
        let mut next = *hub;
        next.rate = hub.rate + hub.acceleration * self.tick;
        if next.rate.abs() > self.rate {
            (next.rate, next.acceleration) = (hub.rate, T::ZERO);
        }
        let mean = T::HALF * (hub.rate + next.rate) * self.tick;
        next.angle = hub.angle.plus(mean * T::from_f64(1.0 / core::f64::consts::TAU));
        next
    }
}

impl<S: Stepper, const QUEUE: usize> Axis<S, QUEUE> {
    /// The next setpoint of a hub that another program moves, in place of [`Axis::tick`]; `None` if
    /// no state has come for this tick. The tick path: no allocation, no panic, no `Result`.
    ///
    /// A state is followed if a motion within the limits leads there in a tick; else it counts as
    /// none. Without one the hub keeps its acceleration, for as many ticks in a row as
    /// [`Policy::missed`](super::Policy::missed) allows. Then the axis stops along the path, with
    /// [`Cause::FollowLost`]. Moves that wait are dropped. An axis that is not enabled does what
    /// [`Axis::tick`] does.
    #[inline(always)]
    pub fn follow(&mut self, hub: Option<&HubState<S::Scalar>>) -> Tick<S::Scalar> {
        self.listen();
        if self.mode() != Mode::Enabled {
            return self.tick_without_state();
        }
        let from = *self.generator.hub();
        let next = match hub {
            Some(hub) if self.reach.spans(&from, hub) => {
                self.unfollowed = 0;
                *hub
            }
            _ => {
                self.unfollowed = self.unfollowed.saturating_add(1);
                self.reach.carried_on(&from)
            }
        };
        if self.unfollowed > self.policy.missed {
            self.stop(Cause::FollowLost);
            return self.tick_without_state();
        }
        self.moves.clear();
        let setpoint = self.generator.follow(&next);
        self.done(setpoint)
    }

    /// Makes a tick of the axis' own motion. Apart, because behind a stop the compiler takes the
    /// code for cold: it would leave the stepper's closures out of line, and there the checks of
    /// their indices.
    #[inline(never)]
    fn tick_without_state(&mut self) -> Tick<S::Scalar> {
        let setpoint = self.generator.tick();
        self.done(setpoint)
    }
}
