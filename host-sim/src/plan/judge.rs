//! The residual vibration of a motion, simulated with the reference rod.

use stillbeam::motion::Shaper;
use stillbeam::{Move, Scene};

use crate::error::Error;
use crate::reference::Sample;
use crate::reference::rod::{self, Options};
use crate::residual;
use crate::step::Motion as Step;
use crate::trajectory::{Side, Trajectory};

/// Default options of the rod. With finer ones a residual changes by less than 1e-6 of L.
const FINE: Options = Options { order: 6, tolerance: 1e-8, integrator: None };

/// Options for comparing many motions of one arm with payload, in half the time. A residual changes
/// by less than 1e-7 of L, a torque by 2e-3. A bare arm wants the finer default.
pub const BRISK: Options = Options { order: 5, tolerance: 1e-6, integrator: None };

/// Instants over a first period at which the rest is sampled.
const LOOKS: usize = 120;

/// Effect of a motion on an arm.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// Residual vibration, fraction of L: see [`crate::residual`].
    pub residual: f64,
    /// Largest deflection, fraction of L.
    pub deflection: f64,
    /// Largest hub torque, N m.
    pub torque: f64,
    /// Largest hub rate, rad/s.
    pub rate: f64,
    /// Largest hub acceleration, rad/s².
    pub acceleration: f64,
    /// Length of the motion including the delay of a shaper, s.
    pub duration: f64,
    /// The run, the time after the motion included.
    pub samples: Vec<Sample>,
}

/// A rest-to-rest motion to be judged.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Hub angle at the beginning, rad.
    pub from: f64,
    /// The motion.
    pub motion: Step,
    /// Shaper that the moves pass, if any.
    pub shaper: Option<Shaper>,
    /// h, s.
    pub tick: f64,
}

impl Motion {
    /// Returns one move or path, unshaped.
    pub fn of(from: f64, motion: impl Into<Step>, tick: f64) -> Self {
        Self { from, motion: motion.into(), shaper: None, tick }
    }

    /// Returns the motion through a shaper.
    pub fn shaped(self, shaper: Shaper) -> Self {
        Self { shaper: Some(shaper), ..self }
    }

    /// Returns the trajectory of the motion with at least `rest` s after it.
    fn trajectory(&self, rest: f64) -> Result<Trajectory, Error> {
        let mut trajectory = Trajectory::resting(self.from, self.tick)?;
        trajectory.append(&self.motion)?;
        trajectory.append(&Move::Dwell { duration: rest + self.tick }.into())?;
        Ok(match &self.shaper {
            Some(shaper) => trajectory.shaped(shaper.clone()),
            None => trajectory,
        })
    }

    /// Simulates the arm along the motion. The arm's frequencies differ by the fraction `error`
    /// from those for which the motion was made.
    pub fn judge(&self, arm: &Scene, error: f64) -> Result<Judgement, Error> {
        self.judge_with(arm, error, &FINE)
    }

    /// [`Self::judge`] by a rod of another fineness.
    pub fn judge_with(
        &self,
        arm: &Scene,
        error: f64,
        options: &Options,
    ) -> Result<Judgement, Error> {
        let arm = arm.stiffened((1.0 + error) * (1.0 + error));
        let period = rod::first_period(&arm)?;
        let trajectory = self.trajectory(period)?;
        let end = trajectory.arrivals().last().unwrap_or(0.0);
        let during = (end / self.tick * 2.0).round().clamp(60.0, 2000.0);
        let mut times: Vec<f64> = (0..during as usize).map(|k| end * k as f64 / during).collect();
        let before = times.len();
        times.extend((0..=LOOKS).map(|k| end + period * k as f64 / LOOKS as f64));
        let samples = rod::solve(&arm, &trajectory, &times, options)?;
        let rest = rod::rest_deflection(&arm, trajectory.at(end, Side::Right).angle)?;
        let length = arm.link.length;
        let after: Vec<(f64, f64)> = samples[before..]
            .iter()
            .map(|sample| (sample.t, (sample.deflection - rest) / length))
            .collect();
        let most = |of: &dyn Fn(&Sample) -> f64| samples.iter().map(of).fold(0.0, f64::max);
        Ok(Judgement {
            residual: residual::largest(&after, end, period),
            deflection: most(&|sample| sample.deflection.abs() / length),
            torque: most(&|sample| sample.torque.abs()),
            rate: most(&|sample| sample.rate.abs()),
            acceleration: most(&|sample| sample.acceleration.abs()),
            duration: end,
            samples,
        })
    }
}
