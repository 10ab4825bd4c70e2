//! Another target while the hub turns, planned in the tick's precision in a few thousand
//! instructions.

use super::{Generator, Part, hold};
use crate::Error;
use crate::hub::{Angle, HubState};
use crate::math::Scalar;
use crate::motion::{Move, Segment, admit};
use crate::stepper::Stepper;

/// The moves that a new target replaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Replaced {
    /// The move under way and all that wait.
    All,
    /// The move under way, of which so many ticks are left.
    Move(u32),
}

impl<S: Stepper, const QUEUE: usize> Generator<S, QUEUE> {
    /// Replaces all that follows: a quintic from the hub's present angle, rate and acceleration to
    /// `angle`, where it arrives `duration` s after the latest setpoint without acceleration and
    /// turns on at `rate` rad/s. Returns the ticks until then.
    ///
    /// # Errors
    /// A duration out of range, a limit that the quintic exceeds between the ticks or on them, or
    /// what the stepper was not set up for. Nothing has changed then.
    pub fn retarget(
        &mut self,
        angle: Angle<S::Scalar>,
        rate: S::Scalar,
        duration: f64,
    ) -> Result<u32, Error> {
        self.replace_motion(angle, rate, duration, Replaced::All)
    }

    /// Does the work of [`Self::retarget`]; what is not `replaced` follows the new quintic.
    pub(crate) fn replace_motion(
        &mut self,
        angle: Angle<S::Scalar>,
        rate: S::Scalar,
        duration: f64,
        replaced: Replaced,
    ) -> Result<u32, Error> {
        let tick = self.stepper.tick();
        let ticks = Move::Dwell { duration }.ticks(tick)?;
        let turn = angle.since(self.hub.angle);
        Error::check("target.angle", turn, -MAX_TURNS, MAX_TURNS, "turns from here")?;
        let (segment, peaks) = Segment::from_hub(&self.hub, turn, rate, ticks, tick);
        admit(&self.limits, &peaks, tick)?;
        self.stepper.admit(&peaks, rate.to_f64())?;
        match replaced {
            Replaced::All => {
                self.queue.clear();
                self.end = HubState::turning(angle.precise(), rate.to_f64());
                self.tail = hold(self.end, tick);
            }
            Replaced::Move(left) => self.drop_front(left),
        }
        self.end_acceleration = self.acceleration_before();
        self.revision = self.revision.wrapping_add(1);
        // Its tick 0 is the latest setpoint's, or the first one of all.
        let k = if self.current.is_unstarted() { u32::MAX } else { 0 };
        self.current.take_up(&segment, Part::Move, k, &self.stepper);
        Ok(ticks)
    }

    /// Drops the waiting segments of the move under way, which takes `left` ticks more.
    fn drop_front(&mut self, left: u32) {
        let under_way = self.current.segment().count().saturating_sub(self.current.k());
        let mut waiting = left.saturating_sub(under_way);
        while waiting > 0
            && let Some(segment) = self.queue.pop_front()
        {
            waiting = waiting.saturating_sub(segment.count());
        }
        // The quintic that takes their place ends at a tick.
        self.queue.front_mut().unwrap_or(&mut self.tail).set_kink_moment(S::Scalar::ZERO);
    }
}

/// Farthest target, turns: its angle is right to 2⁻¹⁶ turn in f32.
const MAX_TURNS: f64 = 128.0;
