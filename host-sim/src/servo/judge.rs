//! How far hub and tip are from the commanded motion.

use stillbeam::Scene;
use stillbeam::hub::Angle;

use super::Trace;
use super::bench::SAMPLES;
use crate::error::Error;
use crate::reference::{Sample, rod};
use crate::residual;
use crate::trajectory::Trajectory;

/// The commanded motion and what the arm makes of it if its hub follows exactly.
#[derive(Clone, Debug)]
pub struct Commanded {
    /// The prescribed motion, [`SAMPLES`] times a tick.
    samples: Vec<Sample>,
    /// Time between two samples, s.
    every: f64,
    /// Time of the last arrival, s.
    arrival: f64,
    /// First period of the arm, s.
    period: f64,
}

/// Outcome of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// Largest difference of the hub's angle from the command, later by the drive's lag, rad.
    pub hub: f64,
    /// Largest distance of the tip from where it is if the hub follows exactly, fraction of L.
    pub tip: f64,
    /// Residual vibration, fraction of L: the largest deflection of the tip from its rest over a
    /// first period after arrival.
    pub residual: f64,
    /// Largest distance of the tip from where it is to rest, over the same time, fraction of L.
    pub off: f64,
    /// Largest torque of the motor, N m.
    pub torque: f64,
    /// Fraction of the time in which the motor could not give what was asked for.
    pub saturated: f64,
}

/// Fineness of the prescribed motion.
const FINE: rod::Options = rod::Options { order: 6, tolerance: 1e-8, integrator: None };

impl Commanded {
    /// Solves the arm along the trajectory with its hub on the command.
    ///
    /// # Errors
    /// Refusals of the reference rod.
    pub fn of(arm: &Scene, trajectory: &Trajectory) -> Result<Self, Error> {
        let every = trajectory.tick() / f64::from(SAMPLES);
        let count = (trajectory.duration() / every).round() as u64;
        let end = trajectory.duration();
        let times: Vec<f64> = (0..=count).map(|k| (every * k as f64).min(end)).collect();
        Ok(Self {
            samples: rod::solve(arm, trajectory, &times, &FINE)?,
            every,
            arrival: trajectory.arrivals().last().unwrap_or(0.0),
            period: rod::first_period(arm)?,
        })
    }

    /// Returns the residual of the arm `actual`, whose hub follows exactly, fraction of L.
    ///
    /// # Errors
    /// Refusals of the reference rod.
    pub fn exact_residual(actual: &Scene, trajectory: &Trajectory) -> Result<f64, Error> {
        let own = Self::of(actual, trajectory)?;
        let deflections = own.samples.iter().map(|sample| (sample.t, sample.deflection));
        own.residual(actual, deflections, 0.0)
    }

    /// Judges a run of a machine that carries the arm `actual` and whose drive lags by `lag` s.
    ///
    /// # Errors
    /// An arm that does not rest.
    pub fn judge(&self, actual: &Scene, trace: &Trace, lag: f64) -> Result<Judged, Error> {
        let length = actual.link.length;
        let shift = (lag / self.every).round() as usize;
        let (mut hub, mut tip) = (0.0_f64, 0.0_f64);
        for (k, shown) in trace.shown.iter().enumerate() {
            let Some(wanted) = self.samples.get(k.saturating_sub(shift)) else { break };
            hub = hub.max((shown.angle - wanted.angle).abs());
            tip = tip.max(distance(shown.tip, wanted.tip) / length);
        }
        let deflections = trace.shown.iter().map(|shown| (shown.t, shown.deflection));
        let residual = self.residual(actual, deflections, lag)?;
        let after = self.arrival + lag - 1e-9;
        let until = self.arrival + lag + self.period;
        let rest = self.rest(actual)?;
        let off = trace
            .shown
            .iter()
            .filter(|shown| shown.t >= after && shown.t <= until)
            .map(|shown| distance(shown.tip, rest) / length)
            .fold(0.0, f64::max);
        let (torque, saturated) = (trace.peak, trace.saturated);
        Ok(Judged { hub, tip, residual, off, torque, saturated })
    }

    fn residual(
        &self,
        actual: &Scene,
        deflections: impl Iterator<Item = (f64, f64)>,
        lag: f64,
    ) -> Result<f64, Error> {
        let rest = rod::rest_deflection(actual, Angle::from_radians(self.target()))?;
        let length = actual.link.length;
        let samples: Vec<_> = deflections.map(|(t, y)| (t, (y - rest) / length)).collect();
        Ok(residual::largest(&samples, self.arrival + lag, self.period))
    }

    /// Returns where the tip rests at the end, m.
    fn rest(&self, actual: &Scene) -> Result<[f64; 2], Error> {
        let angle = self.target();
        let [x, y] = rod::rest_tip(actual, Angle::from_radians(angle))?;
        let (sin, cos) = angle.sin_cos();
        Ok([x * cos - y * sin, x * sin + y * cos])
    }

    /// Returns the angle at the end, rad.
    fn target(&self) -> f64 {
        self.samples.last().map_or(0.0, |sample| sample.angle)
    }

    /// Returns `(t, θ)` of the command, a drive's lag later.
    pub fn angles(&self, lag: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.samples.iter().map(move |sample| (sample.t + lag, sample.angle))
    }

    /// Time of the last arrival, s.
    pub fn arrival(&self) -> f64 {
        self.arrival
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
