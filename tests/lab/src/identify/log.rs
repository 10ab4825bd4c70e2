//! The log of a case.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector2};
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::{Limits, Move, Profile, Scene};
use stillbeam_sim::error::Error;
use stillbeam_sim::identify::log::{Kind as Sensor, Log};
use stillbeam_sim::reference::rod::{self, Options};
use stillbeam_sim::trajectory::{Side, Trajectory};

use super::arm::{Case, Kind};

/// Options of the rod. In five polynomials its first frequency is within 1e-5 of a uniform link's,
/// a sensor of a fifth of its mass on it.
const ROD: Options = Options { order: 5, tolerance: 1e-8, integrator: None };

/// Largest vibration, fraction of L. Larger ones have another frequency: 1e-5 at this.
const SWING: f64 = 0.005;

/// Half of the step over which the acceleration is the second difference of the deflection, in
/// first periods.
const DIFFERENCE: f64 = 0.02;

/// Points of the rod's grid in a first period, and points of an interpolation.
const GRID: f64 = 64.0;
const POINTS: usize = 8;

/// Samples of the rod between those of a log behind a low-pass.
const FINER: usize = 4;

/// Begin of a Unix clock, s.
const UNIX: f64 = 1_764_000_000.0;

impl Case {
    /// Simulates the arm and measures it.
    pub fn log(&self) -> Result<Log, Error> {
        let rng = &mut StdRng::seed_from_u64(self.seed);
        let arm = self.measured()?;
        let trajectory = self.trajectory(&arm, rng)?;
        let arrival = trajectory.arrivals().next().unwrap_or(0.0);
        let begin = if self.kind.is_forced() { 0.2 / self.frequency[0] } else { arrival };
        let times = self.times(begin, rng);
        let clean = self.sensor(&arm, &trajectory, &times)?;
        let size = (clean.iter().map(|x| x * x).sum::<f64>() / clean.len() as f64).sqrt();
        let deviation = size * 10_f64.powf(-self.noise / 20.0);
        let largest = clean.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let step = if self.steps > 0.0 { 2.5 * largest / self.steps } else { 0.0 };
        let sensor = clean
            .iter()
            .map(|x| rounded(x + deviation * normal(rng) + 0.1 * largest, step))
            .collect();
        let hub = self.kind.is_forced().then(|| {
            let turn = trajectory.at(arrival, Side::Right).angle.radians().abs();
            // An encoder with 4096 steps over the turn.
            let angle = |t: &f64| trajectory.at(*t, Side::Right).angle.radians();
            times.iter().map(|t| rounded(angle(t), turn / 4096.0)).collect()
        });
        let first = UNIX + times[0];
        Ok(Log {
            name: "synthetic".to_owned(),
            // As far as a Unix time of 64 bits tells them apart.
            time: times.iter().map(|t| (UNIX + t) - first).collect(),
            hub,
            sensor,
            column: "sensor".to_owned(),
            kind: self.sensor_kind(),
            unit: if self.kind == Kind::Accelerometer { "m/s²" } else { "m" }.to_owned(),
            same_time: 0,
            empty: 0,
        })
    }

    fn sensor_kind(&self) -> Sensor {
        match self.kind {
            Kind::Accelerometer => Sensor::Acceleration,
            _ => Sensor::Deflection,
        }
    }

    /// Returns a move that excites the arm, and a rest after it.
    fn trajectory(&self, arm: &Scene, rng: &mut StdRng) -> Result<Trajectory, Error> {
        let period = 1.0 / self.frequency[0];
        let duration = period * rng.random_range(0.35..0.6);
        let limits = Limits::default();
        let tick = duration / 32.0;
        // A turn of 1 rad in T makes about 6/T² of acceleration, which bends the arm by that times
        // its reach over ω².
        let bend = 6.0 / (duration * TAU / period).powi(2) * (arm.link.length + arm.hub.radius);
        let to = SWING * arm.link.length / bend;
        let mut moves = vec![Move::To { profile: Profile::Cubic, duration, to }];
        let mut length = duration;
        if self.kind.is_forced() {
            // The arm is shaken a few times more.
            for _ in 0..3 {
                let pause = period * rng.random_range(0.3..2.0);
                let duration = (period * rng.random_range(0.35..0.8) / tick).round() * tick;
                let to = to * rng.random_range(-1.0..1.0);
                moves.push(Move::Dwell { duration: pause });
                moves.push(Move::To { profile: Profile::Cubic, duration, to });
                length += pause + duration;
            }
        }
        let rest = period * (self.periods + 4.0);
        moves.push(Move::Dwell {
            duration: if self.kind.is_forced() { (rest - length).max(period) } else { rest },
        });
        Ok(Trajectory::plan(0.0, &moves, &limits, tick)?)
    }

    /// Returns the times at which the log has rows, s.
    fn times(&self, begin: f64, rng: &mut StdRng) -> Vec<f64> {
        let interval = 1.0 / (self.rate * self.frequency[0]);
        let count = (self.periods * self.rate) as usize;
        let mut times = Vec::with_capacity(count);
        let mut gap = 0;
        for k in 0..count {
            // Gaps of two to eight samples.
            if gap == 0 && rng.random_bool(self.lost / 5.0) {
                gap = rng.random_range(2..=8);
            }
            let shift = self.jitter * normal(rng).clamp(-2.0, 2.0);
            if gap > 0 {
                gap -= 1;
                continue;
            }
            times.push(begin + (k as f64 + 0.5 + shift) * interval);
        }
        times.sort_by(f64::total_cmp);
        times.dedup_by(|a, b| *a - *b < 1e-3 * interval);
        times
    }

    /// Returns what a perfect sensor shows at those times.
    fn sensor(
        &self,
        arm: &Scene,
        trajectory: &Trajectory,
        times: &[f64],
    ) -> Result<Vec<f64>, Error> {
        let late: Vec<f64> = times.iter().map(|t| t - self.delay).collect();
        match (self.kind, self.lowpass) {
            (Kind::Accelerometer, _) => {
                let h = DIFFERENCE / self.frequency[0];
                let all: Vec<f64> = late.iter().flat_map(|t| [*t, t + h, t + 2.0 * h]).collect();
                let three = deflections(arm, trajectory, &all, 1.0 / self.frequency[0])?;
                let second = |y: &[f64]| (y[0] - 2.0 * y[1] + y[2]) / (h * h);
                Ok(three.chunks_exact(3).map(second).collect())
            }
            (_, None) => deflections(arm, trajectory, &late, 1.0 / self.frequency[0]),
            (_, Some(lowpass)) => {
                let interval = 1.0 / (self.rate * self.frequency[0] * FINER as f64);
                let end = late[late.len() - 1] + 2.0 * interval;
                let count = (end / interval).ceil() as usize;
                let grid: Vec<f64> = (0..=count).map(|k| k as f64 * interval).collect();
                let deflection = deflections(arm, trajectory, &grid, 1.0 / self.frequency[0])?;
                let smooth =
                    filtered(&deflection, interval, TAU * lowpass.frequency, lowpass.ratio);
                let at = |t: f64| {
                    let k = ((t / interval) as usize).min(count - 1);
                    let share = t / interval - k as f64;
                    smooth[k] + share * (smooth[k + 1] - smooth[k])
                };
                Ok(late.into_iter().map(at).collect())
            }
        }
    }
}

/// Returns the tip's deflections at those times, m, in any order. `period` is the first one, s.
///
/// The rod is solved on an even grid and interpolated by polynomials through eight points: the
/// solver steps to every point that is asked for. The error is 1e-7 of a vibration of the first
/// mode.
fn deflections(
    arm: &Scene,
    trajectory: &Trajectory,
    times: &[f64],
    period: f64,
) -> Result<Vec<f64>, Error> {
    let spacing = period / GRID;
    let end = times.iter().copied().fold(0.0, f64::max);
    let count = (end / spacing).ceil() as usize + POINTS;
    let grid: Vec<f64> = (0..count).map(|k| k as f64 * spacing).collect();
    let samples = rod::solve(arm, trajectory, &grid, &ROD)?;
    let at = |&t: &f64| {
        let place = t.max(0.0) / spacing;
        let first = (place as usize + 1).saturating_sub(POINTS / 2).min(count - POINTS);
        let near = (first..first + POINTS).map(|k| (k as f64, samples[k].deflection));
        lagrange(&near.collect::<Vec<_>>(), place)
    };
    Ok(times.iter().map(at).collect())
}

/// Returns the polynomial through the points at `x`.
fn lagrange(points: &[(f64, f64)], x: f64) -> f64 {
    let weight = |i: usize| {
        let others = points.iter().enumerate().filter(|(k, _)| *k != i);
        others.map(|(_, other)| (x - other.0) / (points[i].0 - other.0)).product::<f64>()
    };
    (0..points.len()).map(|i| weight(i) * points[i].1).sum()
}

/// Passes samples through `ω²/(s² + 2ζωs + ω²)`, by the exponential of the matrix of filter and
/// constant input.
fn filtered(values: &[f64], interval: f64, omega: f64, ratio: f64) -> Vec<f64> {
    let matrix = Matrix3::new(
        0.0,
        1.0,
        0.0,
        -omega * omega,
        -2.0 * ratio * omega,
        omega * omega,
        0.0,
        0.0,
        0.0,
    );
    let step = (matrix * interval).exp();
    let state = step.fixed_view::<2, 2>(0, 0).into_owned();
    let input = step.fixed_view::<2, 1>(0, 2).into_owned();
    let mut x = Vector2::zeros();
    let mut out = vec![0.0];
    for pair in values.windows(2) {
        x = state * x + input * (0.5 * (pair[0] + pair[1]));
        out.push(x[0]);
    }
    out
}

/// Returns a number of the normal distribution, by Box and Muller.
fn normal(rng: &mut StdRng) -> f64 {
    let (u, v): (f64, f64) = (1.0 - rng.random::<f64>(), rng.random());
    (-2.0 * u.ln()).sqrt() * (TAU * v).cos()
}

fn rounded(value: f64, step: f64) -> f64 {
    if step > 0.0 { (value / step).round() * step } else { value }
}
