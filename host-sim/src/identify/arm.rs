//! The modes of a log put into a scene's arm.

use std::f64::consts::TAU;

use clap::ValueEnum;
use nalgebra::{DMatrix, DVector};
use stillbeam::Scene;
use stillbeam::model::{EightElements, Modes};
use stillbeam::scene::PointMass;

use super::log::Kind;
use super::report::{ArmFit, Fitted, ModeReport};
use super::warning::Warning;
use crate::arm::natural;
use crate::error::Error;

/// Parameters that the frequencies tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Free {
    /// EI of the whole link, by one factor.
    Stiffness,
    /// Mass of the payload.
    Payload,
    /// Stiffness of the joint between hub and link.
    Clamp,
}

/// A sensor that is on the arm while it is measured, and not part of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    /// Distance from the clamp, m.
    pub at: f64,
    /// Mass, kg.
    pub mass: f64,
}

/// Relative misfit of several frequencies that is worth a warning.
const MISFIT: f64 = 0.03;

/// Relative distance of the first frequency from the scene's that is worth a warning.
const FAR: f64 = 0.35;

/// Step of a logarithm in a central difference.
const STEP: f64 = 1e-5;

/// Joint that a search starts from, in EI/L.
const JOINT: f64 = 30.0;

/// Returns the arm with the sensor on it.
pub fn with_sensor(arm: &Scene, sensor: Option<Sensor>) -> Result<Scene, Error> {
    let Some(Sensor { at, mass }) = sensor else { return Ok(*arm) };
    let renamed = |error: stillbeam::Error| {
        let text = error.to_string();
        let text = text.replace("link.masses.position", "--sensor-at");
        Error::new(text.replace("link.masses.mass", "--sensor-mass"))
    };
    let point = PointMass { position: at, mass };
    let shape = arm.shape.with_mass(arm.link.length, point).map_err(renamed)?;
    Ok(Scene { shape, ..*arm })
}

/// Returns the gain from the hub's angle to a sensor at the tip, units per rad: `φ₁(L) φ₁ᵀF` for a
/// deflection in m. `None` for what has no theory without a calibration.
pub fn theoretical_gain(arm: &Scene, kind: Kind, unit: &str) -> Option<f64> {
    let model = EightElements::consistent(arm).ok()?;
    let modes = Modes::of(&model);
    let shape = &modes.shape[0];
    let dot = |other: &[f64]| shape.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
    let coupling = dot(model.coupling());
    match (kind, unit) {
        (Kind::Deflection, "m") => Some(shape[model.tip()] * coupling),
        (Kind::Deflection, "rad") => Some(shape[model.tip()] / arm.link.length * coupling),
        (Kind::Angle, "rad") => Some(dot(model.tip_slope()) * coupling),
        _ => None,
    }
}

/// Fits what is free of the arm to the modes. Returns the fitted arm, without the sensor, and the
/// report.
///
/// # Errors
/// An error is returned if more is free than there are modes, or if no arm of this kind has them.
pub fn fit(
    scene: &str,
    arm: &Scene,
    sensor: Option<Sensor>,
    free: &[Free],
    modes: &[ModeReport],
    warnings: &mut Vec<Warning>,
) -> Result<(Scene, ArmFit), Error> {
    if free.len() > modes.len() {
        return Err(Error::new(format_args!(
            "--free: {} things are free but the log shows {} mode; must be at most as many things as \
             modes",
            free.len(),
            modes.len()
        )));
    }
    let problem = Problem { arm, sensor, free };
    // One unknown is what the first mode says; higher ones depend more on how mass is spread.
    let used = if free.len() == 1 { 1 } else { modes.len() };
    let measured: Vec<f64> = modes[..used].iter().map(|mode| mode.frequency_hz).collect();
    let documented = natural::frequencies(&with_sensor(arm, sensor)?)?;
    if ((measured[0] / documented[0]).ln()).abs() > FAR {
        warnings.push(Warning::FarFromScene { measured: measured[0], theory: documented[0] });
    }
    let x = problem.solve(&measured)?;
    let ends = [0, 1].map(|end| {
        let moved = modes[0].frequency_interval_hz[end] / modes[0].frequency_hz;
        let measured: Vec<f64> = measured.iter().map(|hz| hz * moved).collect();
        problem.solve(&measured)
    });
    let mut fitted = problem.at(&x);
    let with = natural::frequencies(&with_sensor(&fitted, sensor)?)?;
    let bare = natural::frequencies(&fitted)?;
    warn_of_misfit(modes, &with, warnings);
    (fitted.damping.alpha, fitted.damping.beta) = damping(modes, warnings);
    fitted.damping.joint = 0.0;
    let values = free.iter().enumerate().map(|(k, &free)| {
        let mut interval = [0, 1].map(|end| ends[end].as_ref().map_or(f64::NAN, |x| x[k].exp()));
        interval.sort_by(f64::total_cmp);
        let (key, unit) = free.key();
        Fitted { key, unit, documented: free.documented(arm), fitted: x[k].exp(), interval }
    });
    let report = ArmFit {
        scene: scene.to_owned(),
        values: values.collect(),
        documented_frequency_hz: documented.to_vec(),
        fitted_frequency_hz: with.to_vec(),
        bare_frequency_hz: bare.to_vec(),
        alpha_per_s: fitted.damping.alpha,
        beta_s: fitted.damping.beta,
    };
    Ok((fitted.validate()?, report))
}

fn warn_of_misfit(modes: &[ModeReport], fitted: &[f64], warnings: &mut Vec<Warning>) {
    let off = |(mode, hz): (&ModeReport, &f64)| (mode.frequency_hz / hz - 1.0).abs();
    let worst = modes.iter().zip(fitted).map(off).fold(0.0, f64::max);
    if worst > MISFIT {
        warnings.push(Warning::ModesMisfit { percent: 100.0 * worst });
    }
}

/// Returns α and β of `ζᵢ = (α/ωᵢ + βωᵢ)/2`: of one mode by β alone, of two by both. Where they
/// would be negative, the first mode's damping is kept by one of them.
pub fn damping(modes: &[ModeReport], warnings: &mut Vec<Warning>) -> (f64, f64) {
    let of = |mode: &ModeReport| (TAU * mode.frequency_hz, mode.damping_ratio);
    let (first, ratio) = of(&modes[0]);
    let alone = (0.0, 2.0 * ratio / first);
    let Some((second, other)) = modes.get(1).map(of) else { return alone };
    let span = second * second - first * first;
    let alpha = 2.0 * first * second * (ratio * second - other * first) / span;
    let beta = 2.0 * (other * second - ratio * first) / span;
    if alpha >= 0.0 && beta >= 0.0 {
        return (alpha, beta);
    }
    warnings.push(Warning::DampingNotRayleigh { first: ratio, second: other });
    if beta < 0.0 { (2.0 * ratio * first, 0.0) } else { alone }
}

impl Free {
    /// Returns the key of the scene file, and its unit.
    pub fn key(self) -> (&'static str, &'static str) {
        match self {
            Self::Stiffness => ("link.bending_stiffness", "N m²"),
            Self::Payload => ("payload.mass", "kg"),
            Self::Clamp => ("hub.stiffness", "N m/rad"),
        }
    }

    fn documented(self, arm: &Scene) -> Option<f64> {
        match self {
            Self::Stiffness => Some(arm.link.bending_stiffness),
            Self::Payload => (arm.payload.mass > 0.0).then_some(arm.payload.mass),
            Self::Clamp => arm.hub.stiffness,
        }
    }

    /// Returns the value that a search starts from.
    fn start(self, arm: &Scene) -> f64 {
        self.documented(arm).unwrap_or(match self {
            Self::Stiffness => arm.link.bending_stiffness,
            Self::Payload => 0.1 * arm.link.mass,
            Self::Clamp => JOINT * arm.link.bending_stiffness / arm.link.length,
        })
    }
}

/// Unknowns are the logarithms of what is free.
struct Problem<'a> {
    arm: &'a Scene,
    sensor: Option<Sensor>,
    free: &'a [Free],
}

impl Problem<'_> {
    fn at(&self, x: &[f64]) -> Scene {
        let mut arm = *self.arm;
        for (free, x) in self.free.iter().zip(x) {
            match free {
                Free::Stiffness => arm.link.bending_stiffness = x.exp(),
                Free::Payload => arm.payload.mass = x.exp(),
                Free::Clamp => arm.hub.stiffness = Some(x.exp()),
            }
        }
        arm
    }

    fn logarithms(&self, x: &[f64], count: usize) -> Result<DVector<f64>, Error> {
        let arm = with_sensor(&self.at(x), self.sensor)?;
        let frequencies = natural::frequencies(&arm)?;
        Ok(DVector::from_iterator(count, frequencies[..count].iter().map(|hz| hz.ln())))
    }

    /// Solves by Gauss's and Newton's steps, none longer than a factor of e.
    fn solve(&self, measured: &[f64]) -> Result<Vec<f64>, Error> {
        let count = measured.len();
        let wanted = DVector::from_iterator(count, measured.iter().map(|hz| hz.ln()));
        let start: Vec<f64> = self.free.iter().map(|free| free.start(self.arm).ln()).collect();
        let mut x = start.clone();
        for _ in 0..100 {
            let errors = self.logarithms(&x, count)? - &wanted;
            let mut slopes = DMatrix::zeros(count, x.len());
            for k in 0..x.len() {
                let at = |step: f64| {
                    let mut x = x.clone();
                    x[k] += step;
                    self.logarithms(&x, count)
                };
                slopes.set_column(k, &((at(STEP)? - at(-STEP)?) / (2.0 * STEP)));
            }
            let step = slopes.svd(true, true).solve(&errors, 1e-10).map_err(Error::new)?;
            let step = &step / step.amax().max(1.0);
            x.iter_mut().zip(step.iter()).for_each(|(x, step)| *x -= step);
            if x.iter().zip(&start).any(|(x, start)| x.is_nan() || (x - start).abs() >= 12.0) {
                break;
            }
            if step.amax() < 1e-10 {
                break;
            }
        }
        let left = (self.logarithms(&x, count)? - &wanted).amax();
        let exact = if count > self.free.len() { 0.2 } else { 1e-6 };
        if left < exact {
            return Ok(x);
        }
        let (key, unit) = self.free[self.free.len() - 1].key();
        Err(Error::new(format_args!(
            "--free: no {key} in {unit} gives this arm its first frequency of {:.4} Hz; must be what \
             the frequency depends on: free stiffness, or look at the scene's masses",
            measured[0]
        )))
    }
}
