//! Changing course: another move from a coming tick on, whatever is under way then.

use super::{Generator, hold};
use crate::Error;
use crate::hub::{Angle, HubState};
use crate::math::Scalar;
use crate::motion::{Peaks, Segment, admit};
use crate::stepper::Stepper;

/// A curve that leaves the motion at a coming tick and ends without acceleration.
pub(crate) struct Branch {
    /// The hub where the curve begins.
    pub from: HubState<f64>,
    /// The curve.
    pub segment: Segment<f64>,
    /// Greatest magnitudes on the curve.
    pub peaks: Peaks,
    /// Angle of the hub at the end, rad.
    pub to: f64,
    /// Rate of the hub at the end, rad/s.
    pub rate: f64,
}

/// A coming tick: which segment it falls into, and where.
enum Place {
    Current(u32),
    /// Position in the queue.
    Waiting(usize, u32),
    /// Behind the queue.
    Held(u32),
}

impl<S: Stepper, const QUEUE: usize> Generator<S, QUEUE> {
    /// Replaces all that follows by `branch`, which begins with the coming tick number `lead`; 0 is
    /// the next one. Nothing changes if it is refused.
    pub(crate) fn branch(&mut self, lead: u32, branch: &Branch) -> Result<(), Error> {
        let tick = self.stepper.tick();
        admit(&self.limits, &branch.peaks, tick)?;
        self.stepper.admit(&branch.peaks, branch.rate)?;
        let place = self.place(lead);
        let here = self.hub_of(&place).precise();
        if here != branch.from {
            let (hub, begins) = (here.angle.radians(), branch.from.angle.radians());
            return Err(Error::Elsewhere { hub, begins });
        }
        let kept = match place {
            Place::Current(_) => 0,
            Place::Waiting(index, k) => index + usize::from(k > 0),
            Place::Held(k) => self.queue.len() + usize::from(k > 0),
        };
        let (needed, free) = (1, QUEUE.saturating_sub(kept));
        if needed > free {
            return Err(Error::QueueFull { needed, free });
        }
        // What the arm feels of a border within the tick before.
        let moment = match place {
            Place::Waiting(index, 0) => {
                self.queue.iter().nth(index).map_or(S::Scalar::ZERO, Segment::kink_moment)
            }
            Place::Held(0) => self.border_moment(),
            _ => S::Scalar::ZERO,
        };
        match place {
            Place::Current(k) => self.current.break_off(k),
            Place::Waiting(index, k) => {
                if let Some(segment) = self.queue.iter_mut().nth(index) {
                    *segment = segment.broken_off(k);
                }
            }
            Place::Held(0) => {}
            Place::Held(k) => {
                // There is room: just counted.
                let _ = self.queue.push_back(self.tail.broken_off(k));
            }
        }
        while self.queue.len() > kept {
            self.queue.pop_back();
        }
        let mut segment = branch.segment.cast();
        segment.set_kink_moment(moment);
        let _ = self.queue.push_back(segment);
        self.revision = self.revision.wrapping_add(1);
        let end = HubState::turning(Angle::from_radians(branch.to), branch.rate);
        self.end = end;
        self.tail = hold(end, tick);
        Ok(())
    }

    /// The arm's state from now on, e.g. as measured: see
    /// [`Elastica::state_of`](crate::stepper::Elastica::state_of).
    pub fn set_state(&mut self, state: S::State) {
        self.state = state;
        self.current.wake();
    }

    fn place(&self, lead: u32) -> Place {
        let (count, next_k) = (self.current.segment().count(), self.current.next_k());
        let left = count - next_k.min(count);
        // A current segment of no length has ended already.
        if lead < left {
            return Place::Current(next_k + lead);
        }
        let mut lead = lead - left;
        for (index, segment) in self.queue.iter().enumerate() {
            if lead < segment.count() {
                return Place::Waiting(index, lead);
            }
            lead -= segment.count();
        }
        Place::Held(lead)
    }

    fn hub_of(&self, place: &Place) -> HubState<S::Scalar> {
        let waiting = |index| self.queue.iter().nth(index).unwrap_or(&self.tail);
        let (segment, k): (&Segment<_>, u32) = match *place {
            Place::Current(k) => (self.current.segment(), k),
            Place::Waiting(index, k) => (waiting(index), k),
            Place::Held(k) => (&self.tail, k),
        };
        segment.hub(k)
    }
}
