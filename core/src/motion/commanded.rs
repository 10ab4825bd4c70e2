//! A commanded motion as a whole, along which a stepper is tried.

use core::fmt;
use core::ops::ControlFlow;

use super::{Kink, Limits, Move, Peaks, Plan};
use crate::Error;
use crate::hub::HubState;

/// A stretch of a commanded motion that has one formula.
pub struct Stretch<'a> {
    /// Time at which it begins, ticks from the motion's beginning; not whole in general.
    pub begin: f64,
    /// Time at which it ends, ticks from the motion's beginning.
    pub end: f64,
    /// The hub at any time of the stretch, ticks from the motion's beginning. At the ends it is the
    /// value inside the stretch.
    pub hub: &'a dyn Fn(f64) -> HubState<f32>,
    /// True if the hub stays where it is.
    pub rests: bool,
}

impl fmt::Debug for Stretch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Stretch")
            .field("begin", &self.begin)
            .field("end", &self.end)
            .field("rests", &self.rests)
            .finish_non_exhaustive()
    }
}

/// A motion from rest, known as a whole before it begins.
pub trait Commanded {
    /// First hub angle, rad.
    fn from(&self) -> f64;

    /// Ticks from beginning to end.
    fn ticks(&self) -> u64;

    /// Greatest magnitudes over the motion, between the ticks too.
    fn peaks(&self) -> Peaks;

    /// The moves that the motion consists of, if a [`Generator`](crate::Generator) that is given
    /// them commands it. A motion behind an input shaper has none: a stepper is then given the hub
    /// itself.
    fn moves(&self) -> Option<&[Move]>;

    /// The kink that the step from tick `tick` to the next is to be given. It is asked for only of
    /// a motion that does not consist of [moves](Self::moves), and only for ticks inside which a
    /// stretch begins.
    fn kink(&self, tick: u64) -> Kink<f32>;

    /// Hands over the stretches, first to last and without a gap, until `each` breaks off.
    fn fly(&self, each: &mut dyn FnMut(&Stretch<'_>) -> ControlFlow<()>) -> Result<(), Error>;
}

/// Moves end to end from rest, as a [`Generator`](crate::Generator) commands them.
#[derive(Clone, Copy, Debug)]
pub struct Moves<'a> {
    from: f64,
    moves: &'a [Move],
    tick: f64,
    ticks: u64,
    peaks: Peaks,
}

impl<'a> Moves<'a> {
    /// Plans the moves from rest at `from` rad, with setpoints every `tick` s.
    pub fn new(from: f64, moves: &'a [Move], tick: f64) -> Result<Self, Error> {
        let mut start = HubState::resting_at(from)?;
        let mut ticks = 0;
        let mut peaks = Peaks { rate: 0.0, acceleration: 0.0, jerk: 0.0 };
        for motion in moves {
            let summary = Plan::new(motion, start, &Limits::default(), tick)?.summary;
            peaks.rate = peaks.rate.max(summary.peaks.rate);
            peaks.acceleration = peaks.acceleration.max(summary.peaks.acceleration);
            peaks.jerk = peaks.jerk.max(summary.peaks.jerk);
            ticks += u64::from(summary.ticks);
            start = summary.end;
        }
        Ok(Self { from, moves, tick, ticks, peaks })
    }
}

impl Commanded for Moves<'_> {
    fn from(&self) -> f64 {
        self.from
    }

    fn ticks(&self) -> u64 {
        self.ticks
    }

    fn peaks(&self) -> Peaks {
        self.peaks
    }

    fn moves(&self) -> Option<&[Move]> {
        Some(self.moves)
    }

    /// Not used: the generator gives the stepper its kinks itself.
    fn kink(&self, _: u64) -> Kink<f32> {
        Kink::NONE
    }

    fn fly(&self, each: &mut dyn FnMut(&Stretch<'_>) -> ControlFlow<()>) -> Result<(), Error> {
        let mut start = HubState::resting_at(self.from)?;
        let mut first = 0u64;
        for motion in self.moves {
            let plan = Plan::new(motion, start, &Limits::default(), self.tick)?;
            start = plan.summary.end;
            for (i, segment) in plan.segments.iter().enumerate() {
                let after = plan.segments.get(i + 1).map_or(0.0, |next| next.ticks_before());
                let zero = first as f64;
                let single = segment.cast::<f32>();
                let stretch = Stretch {
                    begin: zero - segment.ticks_before(),
                    end: zero + f64::from(segment.count()) - after,
                    hub: &|ticks| single.hub_at((ticks - zero) as f32),
                    rests: segment.is_rest(),
                };
                first += u64::from(segment.count());
                if each(&stretch).is_break() {
                    return Ok(());
                }
            }
        }
        Ok(())
    }
}
