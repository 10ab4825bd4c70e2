//! Times at which a solver has to stop, and the side from which it sees the commanded motion there.

use stillbeam::hub::HubState;

use super::ReferenceError;
use crate::trajectory::{Side, Trajectory};

/// The checked sample times of a run, between the breaks of its motion.
pub(super) struct Schedule<'a> {
    trajectory: &'a Trajectory,
    times: &'a [f64],
    /// Ends of the moves, s.
    ends: Vec<f64>,
    /// Distance below which two times count as one, s.
    close: f64,
}

/// A stretch with one formula of the motion. The integrator restarts at its beginning.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch<'a> {
    /// Beginning, s.
    pub begin: f64,
    /// End, s.
    pub end: f64,
    /// Sample times after `begin` up to and including `end`.
    pub times: &'a [f64],
}

impl<'a> Schedule<'a> {
    pub fn new(trajectory: &'a Trajectory, times: &'a [f64]) -> Result<Self, ReferenceError> {
        let (tick, duration) = (trajectory.tick(), trajectory.duration());
        let close = 1e-6 * tick;
        let mut before = -close;
        for &time in times {
            if !(before..=duration + close).contains(&time) {
                return Err(ReferenceError::Time { time, duration });
            }
            before = time;
        }
        Ok(Self { trajectory, times, ends: trajectory.arrivals().collect(), close })
    }

    /// Returns the sample times at the very beginning.
    pub fn initial(&self) -> &'a [f64] {
        &self.times[..self.count_until(0.0)]
    }

    /// Returns the stretches between the breaks, in order.
    pub fn stretches(&self) -> Vec<Stretch<'a>> {
        let mut borders = vec![0.0];
        borders.extend(self.trajectory.breaks());
        borders.push(self.trajectory.duration());
        borders.dedup_by(|b, a| *b - *a <= self.close);
        borders
            .windows(2)
            .map(|w| Stretch {
                begin: w[0],
                end: w[1],
                times: &self.times[self.count_until(w[0])..self.count_until(w[1])],
            })
            .collect()
    }

    fn count_until(&self, t: f64) -> usize {
        self.times.partition_point(|&time| time <= t + self.close)
    }

    /// Returns the hub at a sample time, from the side that [`super::Sample`] promises.
    pub fn hub(&self, t: f64) -> HubState<f64> {
        let ends = self.ends.iter().any(|end| (t - end).abs() <= self.close);
        self.trajectory.at(t, if ends { Side::Left } else { Side::Right })
    }

    /// Returns the hub at `t` inside a stretch or on its border, from within.
    pub fn hub_within(&self, stretch: &Stretch<'_>, t: f64) -> HubState<f64> {
        let first_half = t < 0.5 * (stretch.begin + stretch.end);
        self.trajectory.at(t, if first_half { Side::Right } else { Side::Left })
    }

    /// h, s.
    pub fn tick(&self) -> f64 {
        self.trajectory.tick()
    }

    /// Length of the run, s.
    pub fn duration(&self) -> f64 {
        self.trajectory.duration()
    }
}
