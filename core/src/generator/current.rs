//! The segment under way, how far the hub is in it, and what hub and arm do meanwhile.

use crate::math::Scalar;
use crate::motion::Segment;
use crate::stepper::Stepper;

/// Phase of the motion of hub and arm.
// In this order: to be asleep is to be zero, and the hub rests up to `Dwelling`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Phase {
    /// The moves have ended with the hub at rest, and the arm is at rest too, see
    /// [`Stepper::is_settled`]: it is left as it is.
    Asleep,
    /// The moves have ended with the hub at rest; the arm vibrates.
    Ringing,
    /// A segment of a move is under way in which the hub rests; the arm vibrates.
    Dwelling,
    /// A segment of a move is under way and the hub turns.
    Moving,
    /// The moves have ended with the hub turning, which keeps its rate.
    Cruising,
    /// No tick has been made yet; a move that is pushed now begins with the first.
    Unstarted,
}

/// Origin of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// A move that contains it.
    Move,
    /// The hold at the end of the moves, until the next one.
    Hold,
}

/// The segment under way. Its phase begins in [`Self::take_up`] and nowhere else.
#[repr(C)]
#[derive(Clone, Debug)]
pub(super) struct Current<T> {
    /// Index in the segment of the latest tick; `u32::MAX` if the first one is still to come.
    k: u32,
    /// Ticks with an index below this have a linear acceleration that the stepper has a fast path
    /// for.
    linear: u32,
    /// Ticks with an index below this have a hub at rest that the stepper has a fast path for.
    at_rest: u32,
    phase: Phase,
    /// True if the hub is followed, or holds what it was followed to.
    follows: bool,
    segment: Segment<T>,
}

impl<T: Scalar> Current<T> {
    /// Returns a hold that has no tick: the first tick takes up the first move, or else `hold`
    /// itself.
    pub(super) fn unstarted(hold: &Segment<T>) -> Self {
        let mut segment = *hold;
        segment.cut(0);
        Self {
            k: u32::MAX,
            linear: 0,
            at_rest: 0,
            phase: Phase::Unstarted,
            follows: false,
            segment,
        }
    }

    /// Takes up `segment`, in which `k` is the index of the latest tick.
    #[inline(always)]
    pub(super) fn take_up<S>(&mut self, segment: &Segment<T>, part: Part, k: u32, stepper: &S)
    where
        S: Stepper<Scalar = T>,
    {
        self.segment.copy_from(segment);
        self.phase = match (part, self.segment.is_rest()) {
            (Part::Move, false) => Phase::Moving,
            (Part::Move, true) => Phase::Dwelling,
            (Part::Hold, false) => Phase::Cruising,
            (Part::Hold, true) => Phase::Ringing,
        };
        self.k = k;
        self.follows &= part == Part::Hold;
        let fast = S::FAST.linear
            && self.segment.is_cubic()
            && stepper.is_linear_fast(self.segment.rate_bound());
        self.linear = if fast { self.segment.count() } else { 0 };
        let fast = S::FAST.at_rest && self.rests();
        self.at_rest = if fast { self.segment.count() } else { 0 };
    }

    /// Notes that the latest tick was given the hub, which would go on along `hold`, a segment
    /// without a tick.
    pub(super) fn follow(&mut self, hold: &Segment<T>) {
        self.phase = match (hold.is_rest(), self.phase) {
            (true, Phase::Asleep) => Phase::Asleep,
            (true, _) => Phase::Ringing,
            (false, _) => Phase::Cruising,
        };
        self.segment.copy_from(hold);
        (self.k, self.linear, self.at_rest, self.follows) = (0, 0, 0, true);
    }

    /// True if no tick has been made.
    pub(super) fn is_unstarted(&self) -> bool {
        self.phase == Phase::Unstarted
    }

    /// True if the hub is followed, or holds what it was followed to.
    #[inline(always)]
    pub(super) fn follows(&self) -> bool {
        self.follows
    }

    /// Ends the segment `count` ticks after its beginning, be it a hold or a move.
    pub(super) fn break_off(&mut self, count: u32) {
        self.segment = self.segment.broken_off(count);
        self.shorten_fast_paths(count);
    }

    /// Ends a hold with the latest tick, so that the next one takes up what is in the queue.
    ///
    /// The phase stays the same until then.
    pub(super) fn end_hold(&mut self) {
        if self.is_holding() {
            self.segment.cut(self.next_k());
            self.shorten_fast_paths(self.next_k());
        }
    }

    fn shorten_fast_paths(&mut self, count: u32) {
        self.linear = self.linear.min(count);
        self.at_rest = self.at_rest.min(count);
    }

    /// Notes that tick `k` is made.
    #[inline(always)]
    pub(super) fn advance_to(&mut self, k: u32) {
        self.k = k;
    }

    /// Puts an arm to sleep that no longer vibrates. `is_settled` is called only in the ringing
    /// phase.
    #[inline(always)]
    pub(super) fn sleep_if(&mut self, is_settled: impl FnOnce() -> bool) {
        if self.phase == Phase::Ringing && is_settled() {
            self.phase = Phase::Asleep;
        }
    }

    /// Ends the sleep: the arm has been given another state.
    pub(super) fn wake(&mut self) {
        if self.phase == Phase::Asleep {
            self.phase = Phase::Ringing;
        }
    }

    /// The segment.
    #[inline(always)]
    pub(super) fn segment(&self) -> &Segment<T> {
        &self.segment
    }

    /// The segment, to be given another end.
    pub(super) fn segment_mut(&mut self) -> &mut Segment<T> {
        &mut self.segment
    }

    /// Index in the segment of the latest tick.
    #[inline(always)]
    pub(super) fn k(&self) -> u32 {
        self.k
    }

    /// Index in the segment of the next tick.
    #[inline(always)]
    pub(super) fn next_k(&self) -> u32 {
        self.k.wrapping_add(1)
    }

    /// True if tick `k` of the segment may take the stepper's path for a linear acceleration.
    #[inline(always)]
    pub(super) fn is_linear(&self, k: u32) -> bool {
        k < self.linear
    }

    /// True if tick `k` of the segment may take the stepper's path for a hub at rest.
    #[inline(always)]
    pub(super) fn is_at_rest(&self, k: u32) -> bool {
        k < self.at_rest
    }

    /// True if the hub rests until the segment ends.
    #[inline(always)]
    pub(super) fn rests(&self) -> bool {
        self.phase <= Phase::Dwelling
    }

    /// True if the arm rests too and is left as it is.
    #[inline(always)]
    pub(super) fn is_asleep(&self) -> bool {
        self.phase == Phase::Asleep
    }

    /// True if no move is under way.
    #[inline(always)]
    pub(super) fn is_holding(&self) -> bool {
        !matches!(self.phase, Phase::Moving | Phase::Dwelling)
    }
}
