//! Frequencies and damping ratios of a ring-down.

use std::f64::consts::TAU;

use super::excerpt::Excerpt;
use super::lines::{Line, Lines};
use super::modes::{self, Found, Harmonics};
use super::search::{PROMINENT, faint, found, is_bent, jointly, next, of_lines};
use super::windows::Spread;
use crate::error::Error;
use crate::identify::clean::Clipping;
use crate::identify::covariance::standard_errors;
use crate::identify::log::{Kind, Log};
use crate::identify::separable::{self, Solution};
use crate::identify::spectrum::{Peak, Spectrum};
use crate::identify::warning::Warning;

/// Most lines of a record.
const LINES: usize = 10;

/// Fewest periods of a first mode.
pub const PERIODS: f64 = 2.0;

/// Request for a ring-down.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// Modes at most.
    pub modes: usize,
    /// True if the user asked for that many, and is told if there are fewer.
    pub is_explicit: bool,
    /// Quantity that the sensor measures.
    pub kind: Kind,
    /// Frequencies that the scene gives, Hz.
    pub theory: Option<&'a [f64]>,
}

/// A fitted ring-down.
#[derive(Clone, Debug)]
pub struct Ringdown {
    /// The free vibration.
    pub excerpt: Excerpt,
    /// The model.
    pub model: Lines,
    /// Its unknowns.
    pub solution: Solution,
    /// Indices of the modes' lines.
    pub modes: Vec<usize>,
}

/// One mode as one record gives it.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    /// ω and ζ of small vibrations.
    pub line: Line,
    /// Standard errors of ln ω and ln ζ.
    pub error: [f64; 2],
    /// Findings in the parts of the record.
    pub spread: Spread,
    /// ω and ζ at the largest amplitude, if they differ.
    pub large: Option<Line>,
    /// Amplitudes at the beginning and the end, units of the sensor.
    pub amplitude: [f64; 2],
    /// Periods in the record.
    pub periods: f64,
}

/// Identifies the lines of a log and which of them are modes.
///
/// # Errors
/// An error is returned if nothing stands out of the noise, if the first mode has less than two
/// periods or lies above half of the Nyquist frequency.
pub fn identify(
    log: &Log,
    clipped: Option<Clipping>,
    asked: &Asked<'_>,
    warnings: &mut Vec<Warning>,
) -> Result<Ringdown, Error> {
    let limit = 0.5 * log.nyquist();
    let strongest = strongest(log, asked)?;
    let mut excerpt = Excerpt::of(log, 1.0 / strongest, clipped, warnings);
    if excerpt.length() * strongest < PERIODS {
        // Samples this far apart show beats, the largest of them late.
        if strongest > limit {
            return Err(undersampled(log, strongest));
        }
        return Err(too_short(log, strongest, excerpt.length()));
    }
    let mut ringdown = Ringdown::of(excerpt.clone(), asked);
    if let Ok(found) = &ringdown
        && let Some(end) = found.end_of_signal()
    {
        excerpt = excerpt.part(0.0, end);
        ringdown = Ringdown::of(excerpt, asked);
    }
    let ringdown = ringdown.map_err(|error| error.within(&log.name))?;
    let first = ringdown.line(0).frequency();
    if first > limit {
        return Err(undersampled(log, first));
    }
    let periods = ringdown.excerpt.length() * first;
    if periods < PERIODS {
        return Err(too_short(log, first, ringdown.excerpt.length()));
    }
    ringdown.without_unsampled(limit, asked, warnings)
}

fn undersampled(log: &Log, frequency: f64) -> Error {
    Error::new(format_args!(
        "{}: the first mode is at {frequency:.2} Hz; must be below {:.2} Hz, half of the Nyquist \
         frequency: sample at {:.0} Hz or more",
        log.name,
        0.5 * log.nyquist(),
        4.0 * frequency
    ))
}

fn too_short(log: &Log, frequency: f64, length: f64) -> Error {
    Error::new(format_args!(
        "{}: {:.2} periods of {frequency:.3} Hz are left of free vibration; must be at least {PERIODS}: \
         record for {:.1} s or longer",
        log.name,
        length * frequency,
        20.0 / frequency
    ))
}

/// Returns the frequency of the line that moves the arm most, roughly, Hz.
fn strongest(log: &Log, asked: &Asked<'_>) -> Result<f64, Error> {
    let spectrum = Spectrum::of(&log.time, &log.sensor);
    let length = log.time[log.time.len() - 1] - log.time[0];
    let mut peaks: Vec<Peak> = Vec::new();
    while peaks.len() < LINES {
        let apart = |peak: &Peak, hz: f64| (hz - peak.frequency).abs() > 3.0 / length;
        let admits = |hz: f64| peaks.iter().all(|peak| apart(peak, hz));
        let Some(peak) = spectrum.peak(0.5 / length, 2.0 * log.nyquist(), &admits) else { break };
        peaks.push(peak);
    }
    let moving = |peak: &Peak| {
        let line = Line { omega: TAU * peak.frequency, ratio: 0.0 };
        modes::moving(&Found { line, amplitude: peak.amplitude }, asked.kind)
    };
    let prominent = peaks.iter().filter(|peak| peak.prominence >= PROMINENT);
    let best = prominent.max_by(|a, b| moving(a).total_cmp(&moving(b)));
    // A vibration that is damped heavily, or sampled few times, has no peak that stands out.
    let best = best.or_else(|| peaks.first());
    best.map(|peak| peak.frequency).ok_or_else(|| silent().within(&log.name))
}

fn silent() -> Error {
    Error::new(
        "no vibration stands out of the noise; must be a log of one: tap the arm harder, or look at \
         --sensor, --from and --to",
    )
}

impl Ringdown {
    /// Fits lines to free vibration.
    fn of(excerpt: Excerpt, asked: &Asked<'_>) -> Result<Self, Error> {
        let mut lines: Vec<Line> = Vec::new();
        let mut left = excerpt.value.add_scalar(-excerpt.value.mean());
        let mut bent = false;
        while lines.len() < LINES {
            let Some((line, residual)) = next(&excerpt, &left, &lines) else { break };
            lines.push(line);
            left = residual;
            // Amplitude terms of the strongest line come first: without them the search finds lines
            // beside it that are not there.
            if lines.len() == 1 {
                let (plain, with) =
                    (of_lines(&excerpt, &lines, false), of_lines(&excerpt, &lines, true));
                bent = is_bent(&plain, &with);
                let solution = if bent { with.1 } else { plain.1 };
                left = solution.residual;
                lines[0] = Line { omega: solution.p[0].exp(), ratio: solution.p[1].exp() };
            }
        }
        if lines.is_empty() {
            return Err(silent());
        }
        let (mut model, mut solution) = jointly(&excerpt, &lines, bent);
        let choose = |model: &Lines, solution: &Solution, harmonics: Harmonics| {
            let found = found(model, solution);
            modes::choose(&found, asked.kind, asked.theory, asked.modes, harmonics)
        };
        let mut modes = choose(&model, &solution, Harmonics::Never);
        for harmonics in [Harmonics::Never, Harmonics::IfNoOther] {
            while modes.len() < asked.modes {
                let lines = model.lines(&solution.p);
                let known: Vec<Line> = modes.iter().map(|&k| lines[k]).collect();
                let Some(line) =
                    faint(&excerpt, &solution.residual, &lines, &known, asked, harmonics)
                else {
                    break;
                };
                let with = lines.iter().copied().chain([line]).collect::<Vec<_>>();
                let (more_lines, fitted) = jointly(&excerpt, &with, model.bent.is_some());
                let more = choose(&more_lines, &fitted, harmonics);
                if more.len() <= modes.len() {
                    break;
                }
                (model, solution, modes) = (more_lines, fitted, more);
            }
            if modes.len() < asked.modes {
                modes = choose(&model, &solution, harmonics);
            }
        }
        Ok(Self { excerpt, model, solution, modes })
    }

    /// Returns the line of a mode.
    pub fn line(&self, mode: usize) -> Line {
        self.model.lines(&self.solution.p)[self.modes[mode]]
    }

    /// Returns the frequencies of the lines that are no modes, Hz, ascending.
    pub fn others(&self) -> Vec<f64> {
        let lines = self.model.lines(&self.solution.p);
        let others = (0..lines.len()).filter(|k| !self.modes.contains(k));
        let mut hz: Vec<f64> = others.map(|k| lines[k].frequency()).collect();
        hz.sort_by(f64::total_cmp);
        hz
    }

    /// Returns the time at which the first mode has sunk into the noise, if that is well before the
    /// end of the record.
    fn end_of_signal(&self) -> Option<f64> {
        let noise = (self.solution.squares() / self.excerpt.time.len() as f64).sqrt();
        let [begin, _] = self.amplitudes(0);
        let line = self.line(0);
        let end = (begin / (0.3 * noise)).ln() / (line.ratio * line.omega);
        let length = self.excerpt.length();
        (end > 10.0 / line.frequency() && end < 0.85 * length).then_some(end)
    }

    /// Returns the amplitudes of a mode at the beginning and at the end.
    fn amplitudes(&self, mode: usize) -> [f64; 2] {
        let line = self.modes[mode];
        let c = &self.solution.c;
        let begin = c[1 + 2 * line].hypot(c[2 + 2 * line]);
        let [growth, _] = self.model.terms(&self.solution.p, line);
        let Line { omega, ratio } = self.line(mode);
        let end = super::amplitude::envelope(self.excerpt.length(), ratio * omega, growth);
        [begin, begin * end.amplitude]
    }

    /// Leaves out modes above the limit of the sampling, Hz.
    fn without_unsampled(
        mut self,
        limit: f64,
        asked: &Asked<'_>,
        warnings: &mut Vec<Warning>,
    ) -> Result<Self, Error> {
        let above = (0..self.modes.len()).find(|&mode| self.line(mode).frequency() > limit);
        if let Some(mode) = above {
            let frequency = self.line(mode).frequency();
            warnings.push(Warning::AboveNyquist { mode: mode + 1, frequency, limit });
            self.modes.truncate(mode);
        }
        for mode in 1..self.modes.len() {
            if let Some(times) = modes::harmonic_of(self.line(mode), self.line(0)) {
                warnings.push(Warning::Harmonic { mode: mode + 1, times });
            }
        }
        if asked.is_explicit && self.modes.len() < asked.modes {
            warnings.push(Warning::NoMode { mode: self.modes.len() + 1 });
        }
        Ok(self)
    }

    /// Returns frequency and damping of a mode with their errors.
    pub fn estimate(&self, mode: usize) -> Estimate {
        let index = self.modes[mode];
        let Solution { p, c, residual } = &self.solution;
        let line = self.line(mode);
        let lag = self.lag(line);
        let wanted = [2 * index, 2 * index + 1];
        let errors = standard_errors(&self.model.slopes(p, c), residual, &wanted, lag);
        let terms = self.model.terms(p, index);
        let alone =
            Excerpt { value: residual + self.model.signal(p, c, index), ..self.excerpt.clone() };
        let [growth, shift] = terms;
        let large = (terms != [0.0, 0.0]).then(|| {
            let omega = line.omega * (1.0 + shift);
            Line { omega, ratio: line.ratio * line.omega * (1.0 + growth) / omega }
        });
        Estimate {
            line,
            error: [errors[0], errors[1]],
            spread: Spread::of(&alone, line, terms, lag),
            large,
            amplitude: self.amplitudes(mode),
            periods: self.excerpt.length() * line.frequency(),
        }
    }

    /// Returns the samples over which residuals may be correlated: three periods of the mode.
    fn lag(&self, line: Line) -> usize {
        let count = self.excerpt.time.len();
        let rate = count as f64 / self.excerpt.length();
        ((3.0 / line.frequency() * rate) as usize).min(count / 5)
    }

    /// Returns how much of the record the fit explains, %.
    pub fn fit_percent(&self) -> f64 {
        super::super::fit_percent(&self.excerpt.value, &self.solution.residual)
    }

    /// Returns how much of another vibration the same frequencies and damping ratios explain, %.
    /// Amplitudes and phases are the other's own, amplitude terms are scaled to its amplitude.
    pub fn explains(&self, other: &Excerpt) -> f64 {
        let model = Lines { time: other.time.clone(), ..self.model.clone() };
        let mut p = self.solution.p.clone();
        let terms = 2 * model.start.len();
        let mut solution = separable::project(&model, &other.value, &p);
        if let Some(bent) = model.bent {
            let amplitude = |c: &[f64]| c[1 + 2 * bent].hypot(c[2 + 2 * bent]);
            for _ in 0..8 {
                let scale = amplitude(&solution.c) / amplitude(&self.solution.c);
                p[terms] = self.solution.p[terms] * scale;
                p[terms + 1] = self.solution.p[terms + 1] * scale;
                solution = separable::project(&model, &other.value, &p);
            }
        }
        super::super::fit_percent(&other.value, &solution.residual)
    }

    /// Returns how much the first two thirds of the record, fitted alone, explain of the last, %.
    pub fn validation_percent(&self) -> f64 {
        let cut = 2.0 / 3.0 * self.excerpt.length();
        let (early, late) = (self.excerpt.part(0.0, cut), self.excerpt.part(cut, f64::INFINITY));
        let fitted = |part: &Excerpt| Lines { time: part.time.clone(), ..self.model.clone() };
        let early_fit = separable::fit(&fitted(&early), &early.value, &self.solution.p);
        let solution = separable::project(&fitted(&late), &late.value, &early_fit.p);
        super::super::fit_percent(&late.value, &solution.residual)
    }
}
