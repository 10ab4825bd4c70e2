//! A request to identify an arm, and its answer.

use std::path::PathBuf;

use stillbeam::Scene;

use super::arm::{self, Free, Sensor};
use super::clean::{Clipping, clean};
use super::forced::{self, Forced, Lowpass, Record};
use super::log::{Columns, Log, Sign};
use super::report::{ModeReport, Report};
use super::ringdown::{self, Estimate, Excerpt, Ringdown};
use super::warning::Warning;
use crate::arm::natural;
use crate::error::Error;

/// Modes that are looked for unless asked otherwise: of a ring-down, and of forced logs.
const MODES: (usize, usize) = (3, 1);

/// Hub motion below which it counts as at rest: in rad, and in steps of its encoder.
const AT_REST: f64 = 1e-6;
const STEPS: f64 = 3.0;

/// Fit below which a ring-down is doubted, %.
const DOUBTED: f64 = 70.0;

/// Periods below which the damping is uncertain.
const FEW: f64 = 8.0;

/// Relative width of an interval of the damping from which it counts as unknown.
const WIDE: f64 = 1.0;

/// Disagreement of a record's parts that is worth a warning.
const DISAGREE: f64 = 5e-4;

/// Ratio of the gain to its theory that is worth a warning, either way.
const GAIN: f64 = 1.3;

/// An identification: its logs and the parameters asked for.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// The logs. Of several the last is held out for validation.
    pub logs: Vec<PathBuf>,
    /// Their columns.
    pub columns: Columns,
    /// Direction of the sensor.
    pub sign: Sign,
    /// Beginning of the part that is used, s from the first row.
    pub from: Option<f64>,
    /// End of the part that is used, s from the first row.
    pub to: Option<f64>,
    /// Modes, 1 to 3.
    pub modes: Option<usize>,
    /// Known low-pass of the sensor.
    pub lowpass: Option<Lowpass>,
    /// Sensor on the arm that is not in the scene.
    pub sensor: Option<Sensor>,
    /// Parameters of the scene that the frequencies tell. Empty stands for the stiffness.
    pub free: Vec<Free>,
    /// Name of the scene, and its arm.
    pub scene: Option<(String, Scene)>,
}

/// Measured and fitted values of a log, for a picture.
#[derive(Clone, Debug)]
pub struct Panel {
    /// The log.
    pub log: String,
    /// Times from the first row, s.
    pub time: Vec<f64>,
    /// The sensor.
    pub measured: Vec<f64>,
    /// The model.
    pub fitted: Vec<f64>,
}

/// Result of an identification.
#[derive(Clone, Debug)]
pub struct Identified {
    /// The figures.
    pub report: Report,
    /// The fitted arm, if there is a scene.
    pub arm: Option<Scene>,
    /// The logs and their fits.
    pub panels: Vec<Panel>,
}

/// Logs as prepared.
struct Prepared {
    logs: Vec<Log>,
    /// Clipping of each.
    clipped: Vec<Option<Clipping>>,
    warnings: Vec<Warning>,
}

impl Request {
    /// Reads the logs and identifies what they show.
    ///
    /// # Errors An error is returned if an option is out of its range, if a log cannot be read, or
    /// if it does not show a vibration of at least two periods.
    pub fn carry_out(&self) -> Result<Identified, Error> {
        let logs = self.logs.iter().map(|path| Log::read(path, &self.columns, self.sign));
        self.identify(logs.collect::<Result<_, _>>()?)
    }

    /// Identifies what logs show that are read already.
    ///
    /// # Errors
    /// As [`Self::carry_out`].
    pub fn identify(&self, logs: Vec<Log>) -> Result<Identified, Error> {
        self.check()?;
        let mut prepared = self.prepare(logs)?;
        let moves = prepared.logs.iter().map(hub_range).collect::<Vec<_>>();
        let is_forced = moves.iter().all(|range| range.is_some_and(|range| range.1));
        if let Some((range, false)) = moves[0] {
            prepared.warnings.push(Warning::HubAtRest { range });
        }
        let mut identified =
            if is_forced { self.forced(prepared)? } else { self.ringdown(prepared)? };
        identified.report.warnings.sort();
        identified.report.warnings.dedup();
        Ok(identified)
    }

    fn check(&self) -> Result<(), Error> {
        let refuse = |text: String| Err(Error::new(text));
        if let Some(modes) = self.modes.filter(|modes| !(1..=natural::MODES).contains(modes)) {
            return refuse(format!("--modes = {modes}: must be 1 to {}", natural::MODES));
        }
        if let Some(Lowpass { frequency, ratio }) = self.lowpass {
            let is_valid =
                frequency > 0.0 && frequency.is_finite() && (0.05..=5.0).contains(&ratio);
            if !is_valid {
                return refuse(format!(
                    "--sensor-lowpass = {frequency},{ratio}: must be a corner above 0 Hz and a damping \
                     ratio of 0.05 to 5"
                ));
            }
        }
        for (k, free) in self.free.iter().enumerate() {
            if self.free[..k].contains(free) {
                return refuse(
                    "--free: one thing is given twice; must be different ones".to_owned(),
                );
            }
        }
        if self.scene.is_none() && (!self.free.is_empty() || self.sensor.is_some()) {
            return refuse(
                "--free and --sensor-mass: must be beside --scene, whose arm they are about"
                    .to_owned(),
            );
        }
        Ok(())
    }

    fn prepare(&self, raw: Vec<Log>) -> Result<Prepared, Error> {
        let (mut logs, mut clipped, mut warnings) = (Vec::new(), Vec::new(), Vec::new());
        for log in raw {
            let mut log = log.between(self.from, self.to)?;
            clipped.push(clean(&mut log, &mut warnings));
            if log.time.len() < 16 {
                return Err(Error::new(format_args!(
                    "{}: {} samples are left without clipped and repeated ones; must be at least 16",
                    log.name,
                    log.time.len()
                )));
            }
            logs.push(log);
        }
        Ok(Prepared { logs, clipped, warnings })
    }

    /// Returns the frequencies of the scene with the sensor on it, Hz.
    fn theory(&self) -> Result<Option<Vec<f64>>, Error> {
        let Some((_, arm)) = &self.scene else { return Ok(None) };
        Ok(Some(natural::frequencies(&arm::with_sensor(arm, self.sensor)?)?.to_vec()))
    }

    fn ringdown(&self, prepared: Prepared) -> Result<Identified, Error> {
        let Prepared { logs, clipped, mut warnings } = prepared;
        let theory = self.theory()?;
        let asked = ringdown::Asked {
            modes: self.modes.unwrap_or(MODES.0),
            is_explicit: self.modes.is_some(),
            kind: logs[0].kind,
            theory: theory.as_deref(),
        };
        let all = logs
            .iter()
            .zip(&clipped)
            .map(|(log, clipped)| ringdown::identify(log, *clipped, &asked, &mut warnings))
            .collect::<Result<Vec<_>, _>>()?;
        let (fitted, held) = match all.split_last() {
            Some((last, rest)) if !rest.is_empty() => (rest, Some(last)),
            _ => (&all[..], None),
        };
        let count = fitted.iter().map(|ringdown| ringdown.modes.len()).min().unwrap_or(0);
        let estimates: Vec<Vec<Estimate>> = (0..count)
            .map(|mode| fitted.iter().map(|ringdown| ringdown.estimate(mode)).collect())
            .collect();
        let modes: Vec<ModeReport> =
            estimates.iter().map(|estimates| ringdown::combine(estimates)).collect();
        let first = &fitted[0];
        let fit_percent =
            fitted.iter().map(Ringdown::fit_percent).sum::<f64>() / fitted.len() as f64;
        let validation_percent = match held {
            Some(held) => first.explains(&held.excerpt),
            None => first.validation_percent(),
        };
        warn_of_modes(&modes, &estimates[0], &logs[0].unit, &mut warnings);
        if fit_percent < DOUBTED {
            warnings.push(Warning::PoorFit { percent: fit_percent });
        }
        let others = first.others();
        if !others.is_empty() {
            warnings.push(Warning::Others { hz: others.clone() });
        }
        let length = first.excerpt.length();
        let report = Report {
            case: "ring-down",
            used_s: [first.excerpt.begin, first.excerpt.begin + length],
            fit_percent,
            validation_percent,
            delay_s: None,
            scale: None,
            offset: first.solution.c[0],
            other_frequencies_hz: others,
            ..self.blank(&logs, modes)
        };
        let panels = all.iter().map(panel).collect();
        self.finish(report, panels, warnings)
    }

    fn forced(&self, prepared: Prepared) -> Result<Identified, Error> {
        let Prepared { logs, mut warnings, .. } = prepared;
        let theory = self.theory()?;
        let asked = forced::Asked {
            modes: self.modes.unwrap_or(MODES.1),
            kind: logs[0].kind,
            lowpass: self.lowpass,
            theory: theory.as_deref(),
        };
        let mut records: Vec<Record> = logs.iter().map(Record::of).collect();
        let held = if records.len() > 1 { records.pop() } else { None };
        let fit = forced::identify(records, held.as_ref(), &asked, &mut warnings)?;
        let modes = (0..fit.structure.modes).map(|mode| mode_of(&fit, mode)).collect();
        let fit_percent = fit.fit_percent();
        if fit.validation_percent < fit_percent - 15.0 {
            let validation = fit.validation_percent;
            warnings.push(Warning::PoorValidation { fit: fit_percent, validation });
        }
        if let Some((_, arm)) = &self.scene
            && let Some(theory) = arm::theoretical_gain(
                &arm::with_sensor(arm, self.sensor)?,
                logs[0].kind,
                &logs[0].unit,
            )
        {
            let ratio = fit.gain() / theory;
            if !(1.0 / GAIN..GAIN).contains(&ratio) {
                warnings.push(Warning::Gain { measured: fit.gain(), theory });
            }
        }
        let report = Report {
            case: "forced",
            used_s: [fit.records[0].time[0], fit.records[0].time[0] + fit.records[0].length()],
            fit_percent,
            validation_percent: fit.validation_percent,
            delay_s: Some(fit.delay()),
            scale: Some(fit.gain()),
            offset: fit.offset(),
            other_frequencies_hz: Vec::new(),
            ..self.blank(&logs, modes)
        };
        let panels = fit.records.iter().chain(&held).map(|record| {
            let (measured, fitted) = fit.prediction(record);
            Panel {
                log: record.name.clone(),
                time: record.time.clone(),
                measured: measured.as_slice().to_vec(),
                fitted: fitted.as_slice().to_vec(),
            }
        });
        let panels = panels.collect();
        self.finish(report, panels, warnings)
    }

    /// Returns a report of the logs and modes alone.
    fn blank(&self, logs: &[Log], modes: Vec<ModeReport>) -> Report {
        let mut names: Vec<String> = logs.iter().map(|log| log.name.clone()).collect();
        let validation_log = if names.len() > 1 { names.pop() } else { None };
        Report {
            case: "",
            logs: names,
            validation_log,
            sensor: logs[0].column.clone(),
            unit: logs[0].unit.clone(),
            used_s: [0.0; 2],
            modes,
            fit_percent: 0.0,
            validation_percent: 0.0,
            delay_s: None,
            scale: None,
            offset: 0.0,
            other_frequencies_hz: Vec::new(),
            arm: None,
            warnings: Vec::new(),
        }
    }

    /// Fits the scene's arm and words the warnings.
    fn finish(
        &self,
        mut report: Report,
        panels: Vec<Panel>,
        mut warnings: Vec<Warning>,
    ) -> Result<Identified, Error> {
        let mut fitted = None;
        if let Some((name, scene)) = &self.scene {
            let free = if self.free.is_empty() { &[Free::Stiffness][..] } else { &self.free };
            if self.sensor.is_none() && report.unit == "m/s²" && scene.shape.masses().count() == 0
            {
                warnings.push(Warning::SensorMassUnknown);
            }
            let (arm, fit) =
                arm::fit(name, scene, self.sensor, free, &report.modes, &mut warnings)?;
            fitted = Some(arm);
            report.arm = Some(fit);
        }
        report.warnings = warnings.iter().map(Warning::to_string).collect();
        Ok(Identified { report, arm: fitted, panels })
    }
}

/// Returns by how much the hub turns, rad, and whether that is a motion.
fn hub_range(log: &Log) -> Option<(f64, bool)> {
    let hub = log.hub.as_ref()?;
    let low = hub.iter().copied().fold(f64::INFINITY, f64::min);
    let high = hub.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let steps = hub.windows(2).map(|pair| (pair[1] - pair[0]).abs()).filter(|step| *step > 0.0);
    let step = steps.fold(f64::INFINITY, f64::min);
    let range = high - low;
    Some((range, range > AT_REST && range > STEPS * step))
}

fn mode_of(fit: &Forced, mode: usize) -> ModeReport {
    let [omega, ratio] = fit.mode(mode);
    let [omegas, ratios] = fit.intervals(mode);
    let hz = |omega: f64| omega / std::f64::consts::TAU;
    let values = &fit.records[0].value;
    let half = 0.5 * (values.max() - values.min());
    ModeReport {
        frequency_hz: hz(omega),
        frequency_interval_hz: omegas.map(hz),
        damping_ratio: ratio,
        damping_interval: ratios.map(|ratio| ratio.min(1.0)),
        periods: fit.records.iter().map(Record::length).sum::<f64>() * hz(omega),
        amplitude: [half, 0.0],
        large_frequency_hz: None,
        large_damping_ratio: None,
    }
}

fn warn_of_modes(
    modes: &[ModeReport],
    first: &[Estimate],
    unit: &str,
    warnings: &mut Vec<Warning>,
) {
    let main = &modes[0];
    if let (Some(hz), Some(ratio)) = (main.large_frequency_hz, main.large_damping_ratio) {
        warnings.push(Warning::AmplitudeDependent {
            small: [main.frequency_hz, main.damping_ratio],
            large: [hz, ratio],
            amplitude: main.amplitude,
            unit: unit.to_owned(),
        });
    }
    if main.periods < FEW {
        warnings.push(Warning::FewPeriods { periods: main.periods });
    }
    for estimate in first.iter().filter(|estimate| estimate.spread.excess[0] > DISAGREE) {
        let percent = 100.0 * estimate.spread.excess[0];
        warnings.push(Warning::WindowsDisagree { percent, hz: estimate.spread.range });
    }
    for (index, mode) in modes.iter().enumerate() {
        let interval = mode.damping_interval;
        if interval[1] - interval[0] > WIDE * mode.damping_ratio {
            warnings.push(Warning::DampingUnknown { mode: index + 1, interval });
        }
    }
}

fn panel(ringdown: &Ringdown) -> Panel {
    let Excerpt { name, begin, time, value } = &ringdown.excerpt;
    Panel {
        log: name.clone(),
        time: time.iter().map(|t| begin + t).collect(),
        measured: value.as_slice().to_vec(),
        fitted: (value - &ringdown.solution.residual).as_slice().to_vec(),
    }
}
