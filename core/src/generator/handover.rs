//! Planning beside the tick: a move is planned where nothing is urgent, from a copy of what a plan
//! needs to know, and handed over in a few hundred instructions.

use heapless::Vec;

use super::{Generator, MotionEnd, Part};
use crate::Error;
use crate::hub::{Angle, HubState};
use crate::math::Scalar;
use crate::motion::{Limits, MAX_SEGMENTS, MoveSummary, Plannable, Segment};
use crate::stepper::Stepper;

/// Start of a generator's next move, with the limits that it must keep.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct PlanContext {
    start: HubState<f64>,
    limits: Limits,
    tick: f64,
}

/// A move ready for the generator that its [`PlanContext`] came from.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedMove<T> {
    /// Those that hold a tick.
    segments: Vec<Segment<T>, MAX_SEGMENTS>,
    /// Moment for the hold behind them, see [`Segment::kink_moment`].
    kink_moment: T,
    start: HubState<f64>,
    summary: MoveSummary,
}

impl<T> PlannedMove<T> {
    /// Returns duration, end and peaks of the move.
    pub fn summary(&self) -> &MoveSummary {
        &self.summary
    }
}

impl PlanContext {
    /// Plans `motion` from here. Runs in f64.
    ///
    /// Moves that come over a wire are planned here, so it demands more than [`Generator::push`]: a
    /// move turns by 2⁻¹⁶/ε turns at most, 128 in f32, so that its angle is right to 2⁻¹⁶ turn.
    pub fn plan<T: Scalar>(&self, motion: &impl Plannable) -> Result<PlannedMove<T>, Error> {
        let (mut segments, mut motion_end) = (Vec::new(), MotionEnd::new());
        let summary =
            motion.plan_segments(self.start, &self.limits, self.tick, &mut |segment| {
                if motion_end.holds_tick(segment) {
                    // No move has more.
                    let _ = segments.push(*segment);
                }
            })?;
        if !motion.keeps_rate() {
            resolved::<T>(&self.start, &summary)?;
        }
        let kink_moment = motion_end.close(segments.last_mut());
        Ok(PlannedMove { segments, kink_moment, start: self.start, summary })
    }

    pub(crate) fn start(&self) -> &HubState<f64> {
        &self.start
    }

    pub(crate) fn limits(&self) -> &Limits {
        &self.limits
    }
}

/// Refuses a move that turns so far that its angle would advance in steps: the rounding error of a
/// segment's angle is a fraction of the segment's own turn. A longer way is a spin-up, a dwell and
/// a spin-down. The angle is then exact.
fn resolved<T: Scalar>(start: &HubState<f64>, summary: &MoveSummary) -> Result<(), Error> {
    let turned = summary.end.angle.since(start.angle);
    let most = 1.0 / 65_536.0 / T::EPSILON.to_f64();
    Error::check("move: turns", turned, -most, most, "turns").map(drop)
}

impl<S: Stepper, const QUEUE: usize> Generator<S, QUEUE> {
    /// Returns start and limits of a move that is planned now.
    pub fn plan_context(&self) -> PlanContext {
        PlanContext { start: self.next_start(), limits: self.limits, tick: self.stepper.tick() }
    }

    /// Puts a planned move behind the others. Either the whole move is taken or nothing changes.
    ///
    /// # Errors
    /// [`Error::Stale`] if the hub's motion has changed since the context was copied: plan again.
    /// [`Error::QueueFull`], or what the stepper was not set up for.
    pub fn take(&mut self, planned: &PlannedMove<S::Scalar>) -> Result<(), Error> {
        let start = self.next_start();
        // A hub that turns has turned on meanwhile; its moves are relative.
        let turned = start.angle.in_turns() - planned.start.angle.in_turns();
        if start.rate != planned.start.rate || (turned != 0.0 && start.rate == 0.0) {
            return Err(Error::Stale);
        }
        let (needed, free) = (planned.segments.len(), QUEUE - self.queue.len());
        if needed > free {
            return Err(Error::QueueFull { needed, free });
        }
        let MoveSummary { peaks, end, .. } = &planned.summary;
        self.stepper.admit(peaks, end.rate)?;
        // Whole turns apart: a fraction of many turns would be rounded with them.
        let by = Angle::default().plus(turned).cast();
        let mut first = Some(start.angle.cast());
        let mut moment = self.border_moment();
        for segment in &planned.segments {
            // There is room: just counted.
            let segment = segment.shifted(by, first.take()).behind(&mut moment);
            let _ = self.queue.push_back(segment);
        }
        self.current.end_hold();
        self.revision = self.revision.wrapping_add(1);
        let end = planned.summary.end;
        self.end = HubState::turning(end.angle.plus(turned), end.rate);
        self.tail = super::hold(self.end, self.stepper.tick());
        self.tail.set_kink_moment(planned.kink_moment);
        Ok(())
    }

    /// Returns the hub at the end of the queue.
    pub(crate) fn end(&self) -> HubState<f64> {
        self.end
    }

    /// Begins anew, at rest and in static equilibrium at `angle`; no move waits.
    pub fn restart(&mut self, angle: Angle<S::Scalar>) {
        self.hub = HubState { angle, ..HubState::ZERO };
        self.stepper.gravity().aim(&mut self.hub);
        self.end_acceleration = S::Scalar::ZERO;
        self.state = self.stepper.equilibrium(&self.hub);
        self.rest_at(angle);
        self.current.take_up(&self.tail, Part::Hold, 0, &self.stepper);
    }

    /// Replaces the arm on the same hub, from the angle where the hub rests.
    pub fn replace(&mut self, stepper: S) {
        self.tick = S::Scalar::from_f64(stepper.tick());
        self.stepper = stepper;
        self.restart(self.hub.angle);
    }
}
