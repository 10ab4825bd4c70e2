//! A shaped motion as the core's trials follow it.

use std::ops::ControlFlow;

use stillbeam::Move;
use stillbeam::hub::HubState;
use stillbeam::motion::{Commanded, Kink, Peaks, Segment, Shaped, Shaper, Stretch};

use crate::limits::kinematic;
use crate::trajectory::{Side, Trajectory};

/// A motion that no generator commands. The stepper receives the hub's state itself.
pub struct Flight<'a> {
    trajectory: &'a Trajectory,
    /// The moves before they pass the shaper.
    segments: Vec<Segment<f32>>,
    shaper: &'a Shaper,
    from: f64,
    /// Borders of the stretches, ticks.
    borders: Vec<f64>,
    peaks: Peaks,
}

impl<'a> Flight<'a> {
    /// Creates the flight, from rest at `from` rad.
    pub fn new(trajectory: &'a Trajectory, shaper: &'a Shaper, from: f64) -> Self {
        let tick = trajectory.tick();
        let inner = trajectory.breaks().into_iter().map(|t| t / tick);
        let ends = [0.0, trajectory.ticks() as f64];
        let borders = ends[..1].iter().copied().chain(inner).chain(ends[1..].iter().copied());
        let found = kinematic::peaks(trajectory, 0.0, trajectory.ticks() as f64 * tick);
        let peaks = Peaks {
            rate: found.rate.value,
            acceleration: found.acceleration.value,
            jerk: found.jerk.value,
        };
        let plans = trajectory.plans().iter();
        let segments = plans.flat_map(|plan| plan.segments.iter().map(Segment::cast)).collect();
        Self { trajectory, segments, shaper, from, borders: borders.collect(), peaks }
    }

    /// Returns the hub's state `ticks` ticks after the beginning, within one stretch.
    fn within(&self, [begin, end]: [f64; 2], ticks: f64) -> HubState<f64> {
        let side = if ticks > 0.5 * (begin + end) { Side::Left } else { Side::Right };
        self.trajectory.at(ticks * self.trajectory.tick(), side)
    }
}

impl Commanded for Flight<'_> {
    fn from(&self) -> f64 {
        self.from
    }

    fn ticks(&self) -> u64 {
        self.trajectory.ticks()
    }

    fn peaks(&self) -> Peaks {
        self.peaks
    }

    fn moves(&self) -> Option<&[Move]> {
        None
    }

    fn kink(&self, tick: u64) -> Kink<f32> {
        Shaped::new(&self.segments, self.shaper, self.trajectory.tick()).kink(tick as u32)
    }

    fn fly(
        &self,
        each: &mut dyn FnMut(&Stretch<'_>) -> ControlFlow<()>,
    ) -> Result<(), stillbeam::Error> {
        for pair in self.borders.windows(2) {
            let (begin, end) = (pair[0], pair[1]);
            let at = |ticks| self.within([begin, end], ticks);
            let rests = [begin, 0.5 * (begin + end), end].into_iter().all(|ticks| {
                let hub = at(ticks);
                hub.rate == 0.0 && hub.acceleration == 0.0
            });
            let stretch = Stretch { begin, end, hub: &|ticks| single(&at(ticks)), rests };
            if each(&stretch).is_break() {
                break;
            }
        }
        Ok(())
    }
}

fn single(hub: &HubState<f64>) -> HubState<f32> {
    HubState {
        angle: hub.angle.cast(),
        rate: hub.rate as f32,
        acceleration: hub.acceleration as f32,
        sin: hub.sin as f32,
        cos: hub.cos as f32,
    }
}
