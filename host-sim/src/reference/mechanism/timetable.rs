//! Stretches of a run in which nothing jumps, and the times to be sampled in each.

use stillbeam::mechanism::Mechanism;

use crate::mechanism::{Drives, Moving, closes_at};
use crate::reference::ReferenceError;
use crate::trajectory::Side;

/// A stretch with one formula for every joint's motion, and one set of free joints.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch<'a> {
    /// Beginning, s.
    pub begin: f64,
    /// End, s.
    pub end: f64,
    /// Sample times after `begin` up to and including `end`.
    pub times: &'a [f64],
    /// True if the tip is pinned.
    pub closed: bool,
}

/// The checked sample times of a run, and its stretches.
pub(super) struct Timetable<'a> {
    drives: &'a Drives,
    times: &'a [f64],
    stretches: Vec<Stretch<'a>>,
    /// Distance below which two times count as one, s.
    close: f64,
}

impl<'a> Timetable<'a> {
    /// Checks that the times ascend within the run.
    pub fn new(
        mechanism: &Mechanism,
        drives: &'a Drives,
        times: &'a [f64],
    ) -> Result<Self, ReferenceError> {
        let duration = drives.duration();
        let close = 1e-6 * drives.tick();
        let mut before = -close;
        for &time in times {
            if !(before..=duration + close).contains(&time) {
                return Err(ReferenceError::Time { time, duration });
            }
            before = time;
        }
        let closes = closes_at(mechanism);
        let mut borders = vec![0.0, duration];
        borders.extend(drives.breaks());
        borders.extend(closes.filter(|&t| t < duration));
        borders.sort_by(f64::total_cmp);
        borders.dedup_by(|b, a| *b - *a <= close);
        let until = |t: f64| times.partition_point(|&time| time <= t + close);
        let stretch = |w: &[f64]| Stretch {
            begin: w[0],
            end: w[1],
            times: &times[until(w[0])..until(w[1])],
            closed: closes.is_some_and(|t| w[0] >= t - close),
        };
        let stretches = borders.windows(2).map(stretch).collect();
        Ok(Self { drives, times, stretches, close })
    }

    /// Returns the sample times at the very beginning.
    pub fn initial(&self) -> &'a [f64] {
        &self.times[..self.times.partition_point(|&time| time <= self.close)]
    }

    /// Returns the stretches, in order.
    pub fn stretches(&self) -> &[Stretch<'a>] {
        &self.stretches
    }

    /// Length of the run, s.
    pub fn duration(&self) -> f64 {
        self.drives.duration()
    }

    /// Returns what a joint is commanded at `t` inside a stretch or on its border, from within.
    pub fn within(&self, stretch: &Stretch<'_>, joint: usize, t: f64) -> Moving {
        let first_half = t < 0.5 * (stretch.begin + stretch.end);
        self.drives.at(joint, t, if first_half { Side::Right } else { Side::Left })
    }

    /// Returns what a joint is commanded at `t`, from the left.
    pub fn before(&self, joint: usize, t: f64) -> Moving {
        self.drives.at(joint, t, Side::Left)
    }
}
