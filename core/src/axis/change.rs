//! A change of mind: another target, another duration, hold, cancel, at any tick.

use super::{Accepted, Axis, before};
use crate::Error;
use crate::generator::{Arrival, Replaced};
use crate::hub::{Angle, HubState};
use crate::math::Scalar;
use crate::stepper::Stepper;

/// A change of an axis' motion, from the next tick on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change<T> {
    /// Meets a target, by a quintic from the hub's present angle, rate and acceleration. All moves
    /// are dropped.
    Target {
        /// The target's angle at the latest setpoint.
        angle: Angle<T>,
        /// The target's rate, rad/s, which is fed forward: the hub meets the target where it will
        /// be then, and turns on with it.
        rate: T,
        /// Time from the latest setpoint until they meet, s; rounded to the nearest whole tick.
        duration: f64,
    },
    /// Reaches an angle in the shortest time that the policy's limits of rate, acceleration,
    /// deceleration and jerk allow. All moves are dropped. It is planned in f64, and takes up to
    /// ten segments: a queue of nine has room for any.
    Reach {
        /// Angle to reach.
        angle: Angle<T>,
        /// Rate with which the hub turns on from there, rad/s.
        rate: T,
    },
    /// The move under way ends as it would have, this time after the latest setpoint, s. It becomes
    /// a quintic from the hub's present state. Moves behind it follow as planned.
    Duration(f64),
    /// Brakes along the path and holds. All moves are dropped; the axis stays enabled.
    Hold,
    /// Drops the moves behind the one under way. A path is broken off, as by [`Self::Hold`].
    Cancel,
}

impl<S: Stepper, const QUEUE: usize> Axis<S, QUEUE> {
    /// Changes the motion from the next tick on: angle, rate and acceleration go on without a jump,
    /// and the limits are kept.
    ///
    /// It plans in the precision of the tick, in a few thousand instructions: fit for a target that
    /// moves thirty times a second. Between two ticks, not in the tick's interrupt.
    ///
    /// # Errors
    /// A duration out of range, a limit that the new motion exceeds, or what the stepper was not
    /// set up for; [`Error::NoMove`] for a new duration while no move is under way;
    /// [`Error::WrongMode`] if the axis is not enabled. Nothing has changed then.
    // Inlined, so that a program which makes one kind of change holds no code for the others: the
    // shortest way alone takes 40 kB.
    #[inline(always)]
    pub fn change(&mut self, change: &Change<S::Scalar>) -> Result<(), Error> {
        self.supervisor.check_enabled()?;
        match *change {
            Change::Target { angle, rate, duration } => self.meet(angle, rate, duration),
            Change::Reach { angle, rate } => {
                let end = HubState::turning(angle.precise(), rate.to_f64());
                let summary = self.generator.reach(&end)?;
                self.under_way_to(summary.end, summary.ticks);
                Ok(())
            }
            Change::Duration(duration) => self.lasting(duration),
            Change::Hold => {
                self.generator.brake(&self.braking, self.arrival());
                self.moves.clear();
                Ok(())
            }
            Change::Cancel => {
                self.cancel();
                Ok(())
            }
        }
    }

    fn meet(
        &mut self,
        angle: Angle<S::Scalar>,
        rate: S::Scalar,
        duration: f64,
    ) -> Result<(), Error> {
        let turns = S::Scalar::from_f64(duration / core::f64::consts::TAU);
        let met = angle.plus(rate * turns);
        let ticks = self.generator.retarget(met, rate, duration)?;
        self.under_way_to(HubState::turning(met.precise(), rate.to_f64()), ticks);
        Ok(())
    }

    /// Takes note of the one move that is left: it began with the latest setpoint.
    fn under_way_to(&mut self, end: HubState<f64>, ticks: u32) {
        let begin = self.clock().wrapping_sub(1);
        let arrival = begin.wrapping_add(ticks);
        self.moves.clear();
        // There is room: none is left.
        let _ = self.moves.push_back(Accepted { begin, arrival, end });
    }

    fn lasting(&mut self, duration: f64) -> Result<(), Error> {
        let Some(Arrival { ticks: left, end }) = self.under_way() else {
            return Err(Error::NoMove);
        };
        let (angle, rate) = (end.angle.cast(), S::Scalar::from_f64(end.rate));
        let replaced = Replaced::Move(left);
        let ticks = self.generator.replace_motion(angle, rate, duration, replaced)?;
        let later = ticks.wrapping_sub(left);
        for (i, accepted) in self.moves.iter_mut().enumerate() {
            if i > 0 {
                accepted.begin = accepted.begin.wrapping_add(later);
            }
            accepted.arrival = accepted.arrival.wrapping_add(later);
        }
        Ok(())
    }

    fn cancel(&mut self) {
        match self.under_way() {
            Some(arrival) => {
                self.generator.end_with(arrival);
                while self.moves.len() > 1 {
                    self.moves.pop_back();
                }
            }
            None => {
                self.generator.brake(&self.braking, None);
                self.moves.clear();
            }
        }
    }

    /// Returns the end of the move under way, if there is one.
    pub(super) fn under_way(&self) -> Option<Arrival> {
        let current = self.moves.front()?;
        let latest = self.clock().wrapping_sub(1);
        let ticks = current.arrival.wrapping_sub(latest);
        (!before(latest, current.begin)).then_some(Arrival { ticks, end: current.end })
    }
}
