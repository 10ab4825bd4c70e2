//! Motions that the driven joints are given.

use stillbeam::Move;
use stillbeam::hub::HubState;
use stillbeam::mechanism::Mechanism;

use crate::error::Error;
use crate::step::Motion;
use crate::trajectory::{Side, Trajectory};

/// Most ticks of a run: its table is held in memory.
const MOST_TICKS: u64 = 1_000_000;

/// A motion of one joint from a time on.
#[derive(Clone, Debug, PartialEq)]
pub struct JointDrive {
    /// Index of the joint, from 0.
    pub joint: usize,
    /// Time at which it begins, s. It is rounded to whole ticks.
    pub start: f64,
    /// The motion.
    pub motion: Motion,
}

/// State that a drive commands: relative angle (rad), its rate and its acceleration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moving {
    /// θ, rad, not wrapped.
    pub angle: f64,
    /// θ̇, rad/s.
    pub rate: f64,
    /// θ̈, rad/s².
    pub acceleration: f64,
}

/// The commanded motion of every joint of a mechanism over a run.
#[derive(Clone, Debug)]
pub struct Drives {
    joints: Vec<Trajectory>,
    /// h, s.
    tick: f64,
    /// Ticks of the run.
    ticks: u64,
}

impl Drives {
    /// Plans the drives, in order of their start at each joint, for a run of `duration` s. A joint
    /// rests before, between and after its motions.
    ///
    /// # Errors
    /// `moves[k]` of a motion that the core refuses, that overlaps the one before it at the same
    /// joint, or that ends behind the run.
    pub fn plan(
        mechanism: &Mechanism,
        drives: &[JointDrive],
        duration: f64,
        tick: f64,
    ) -> Result<Self, Error> {
        let ticks = (duration / tick).round() as u64;
        if !(1..=MOST_TICKS).contains(&ticks) {
            return Err(Error::new(format_args!(
                "run.duration = {duration}: must be 1 to {MOST_TICKS} ticks of {tick} s"
            )));
        }
        let joint = |index| plan_joint(mechanism, drives, index, ticks, tick);
        let joints = (0..mechanism.joints.len()).map(joint).collect::<Result<_, _>>()?;
        Ok(Self { joints, tick, ticks })
    }

    /// h, s.
    pub fn tick(&self) -> f64 {
        self.tick
    }

    /// Ticks of the run.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Length of the run, s.
    pub fn duration(&self) -> f64 {
        self.ticks as f64 * self.tick
    }

    /// Returns the commanded state of a joint at `t` s. Before the run it rests.
    pub fn at(&self, joint: usize, t: f64, side: Side) -> Moving {
        let begins = side == Side::Left && t <= 1e-9 * self.tick;
        let HubState { angle, rate, acceleration, .. } = self.joints[joint].at(t, side);
        let (rate, acceleration) = if begins { (0.0, 0.0) } else { (rate, acceleration) };
        Moving { angle: angle.radians(), rate, acceleration }
    }

    /// Returns the times strictly inside the run at which the motion of a joint changes its
    /// formula, s, rising.
    pub fn breaks(&self) -> Vec<f64> {
        let mut all: Vec<f64> = self.joints.iter().flat_map(Trajectory::breaks).collect();
        all.sort_by(f64::total_cmp);
        all.dedup_by(|b, a| *b - *a < 1e-6 * self.tick);
        all
    }

    /// Returns the times at which the commanded acceleration of a joint jumps, s, rising.
    pub fn jumps(&self) -> Vec<f64> {
        let jumps = |t: &f64| {
            (0..self.joints.len()).any(|joint| {
                let [left, right] = [Side::Left, Side::Right].map(|side| self.at(joint, *t, side));
                let size = left.acceleration.abs().max(right.acceleration.abs());
                (left.acceleration - right.acceleration).abs() > 1e-6 * size.max(1e-6)
            })
        };
        std::iter::once(0.0).chain(self.breaks()).filter(jumps).collect()
    }

    /// Returns the time at which the last motion of any joint ends, s; 0 without motions.
    pub fn arrival(&self) -> f64 {
        let last = |joint: &Trajectory| joint.arrivals().last().unwrap_or(0.0);
        self.joints.iter().map(last).fold(0.0, f64::max)
    }
}

/// Plans one joint: its motions with the rests between them.
fn plan_joint(
    mechanism: &Mechanism,
    drives: &[JointDrive],
    joint: usize,
    ticks: u64,
    tick: f64,
) -> Result<Trajectory, Error> {
    let mut own: Vec<_> = drives.iter().enumerate().filter(|(_, d)| d.joint == joint).collect();
    own.sort_by(|a, b| a.1.start.total_cmp(&b.1.start));
    let mut trajectory = Trajectory::resting(mechanism.joints[joint].angle, tick)?;
    let mut before: Option<usize> = None;
    for (index, drive) in own {
        let place = || format!("moves[{index}]");
        let start = (drive.start / tick).round() as u64;
        let here = trajectory.ticks();
        if start < here {
            return Err(Error::new(format_args!(
                "moves[{index}].start = {}: joint {} still makes moves[{}] then; must be {} s or \
                 later, its end",
                drive.start,
                joint + 1,
                before.unwrap_or(0),
                here as f64 * tick
            )));
        }
        rest(&mut trajectory, start - here).map_err(|error| error.within(place()))?;
        trajectory.append(&drive.motion).map_err(|error| error.within(place()))?;
        if trajectory.ticks() > ticks {
            return Err(Error::new(format_args!(
                "moves[{index}]: ends at {} s, after the run; run.duration must be as long",
                trajectory.duration()
            )));
        }
        before = Some(index);
    }
    let left = ticks - trajectory.ticks();
    rest(&mut trajectory, left)?;
    Ok(trajectory)
}

/// Appends a rest of that many ticks.
fn rest(trajectory: &mut Trajectory, ticks: u64) -> Result<(), Error> {
    if ticks == 0 {
        return Ok(());
    }
    let duration = ticks as f64 * trajectory.tick();
    trajectory.append(&Move::Dwell { duration }.into())
}
