//! A measured hub motion as a smooth one: rows at any times, with noise, made into cubics.
//!
//! No derivative of a row is taken. A cubic spline with knots at whole ticks is fitted to all rows
//! at once. It comes as close to them as their noise is large and has the least jerk of all that
//! do (`fit`). Its rate is continuous, and its acceleration too but where a rest begins or ends
//! (`rests`).

mod band;
mod fit;
mod rests;
mod spline;

use fit::{Equations, Fit, Samples};
use spline::{End, Knots};
use stillbeam::motion::Waypoint;

use crate::error::Error;

/// Fewest rows that make a motion.
const FEWEST: usize = 8;

/// Most intervals between knots.
const MOST_KNOTS: f64 = 1e6;

/// Powers of ten of the smoothing λ that are tried. The least one is interpolation, but for
/// rounding.
const POWERS: (i32, i32) = (-9, 10);

/// Number of times that a bracket of the smoothing is halved, or narrowed by the golden section: to
/// 1e-3 of a power of ten.
const NARROWINGS: u32 = 16;

/// Number of standard deviations within which a hub counts as at rest.
const SURE: f64 = 5.0;

/// Share of the squared error of prediction below which parts that are fitted one by one count as
/// better than one fit.
const BETTER: f64 = 0.25;

/// Share of its peak within which a rate or an acceleration at an end counts as none.
const NONE: f64 = 0.02;

/// A motion that was fitted to samples. It begins at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Smoothed {
    /// Hub angle at t = 0, rad.
    pub from: f64,
    /// Angle and rate at the knots behind t = 0; a cubic leads from each to the next.
    pub rows: Vec<Waypoint>,
    /// Noise of the samples, rad, root mean square: as given or as estimated.
    pub noise: f64,
    /// Greatest distance of a sample from the motion, rad.
    pub farthest: f64,
    /// Standard deviation of the acceleration, rad/s², root mean square over the motion.
    pub acceleration_error: f64,
    /// Time between knots, s.
    pub knot: f64,
}

/// Fits a motion to samples, with setpoints every `tick` s. `times` rise from 0.
///
/// `noise` is that of the angles, rad, root mean square. 0 passes the samples. `None` estimates it:
/// the smoothing is the one with which the samples predict each other best.
///
/// Where the hub rests in between, its acceleration may jump as the rest begins and ends: the parts
/// in which it moves are then fitted one by one, if the samples predict each other better so.
///
/// # Errors
/// Too few or too many samples, a noise out of range, or samples that begin with the hub turning.
pub fn smoothed(
    times: &[f64],
    angles: &[f64],
    noise: Option<f64>,
    tick: f64,
) -> Result<Smoothed, Error> {
    let knots = knots(times, tick)?;
    if let Some(noise) = noise.filter(|noise| !(0.0..=1.0).contains(noise)) {
        return Err(Error::new(format_args!("--noise = {noise}: must be 0 to 1 rad")));
    }
    let whole = Part::whole(times, angles, knots).fit(noise)?;
    let parts: Result<Vec<_>, Error> =
        rests::parts(times, angles, knots).iter().map(|part| part.fit(noise)).collect();
    let parts = parts.ok().filter(|parts| {
        !parts.is_empty()
            && parts.iter().all(|part| part.rests_before(knots))
            && prediction(parts) < BETTER * prediction(std::slice::from_ref(&whole))
    });
    Ok(motion(&parts.unwrap_or_else(|| vec![whole]), knots))
}

/// A part of the samples in which the hub moves, or all of them.
struct Part {
    /// Knot at which it begins.
    first: usize,
    knots: Knots,
    /// Times from its beginning, s: those of a rest beside it are at its ends.
    times: Vec<f64>,
    /// rad.
    angles: Vec<f64>,
}

/// A part with its fit.
struct Fitted {
    first: usize,
    fit: Fit,
    ends: [End; 2],
    /// Noise of its samples, rad.
    noise: f64,
    /// Sum of the squared residuals, rad², and the number of samples less the degrees of freedom
    /// that the spline took, of the fit with which the samples predict each other best.
    residual: [f64; 2],
}

impl Part {
    fn whole(times: &[f64], angles: &[f64], knots: Knots) -> Self {
        Self { first: 0, knots, times: times.to_vec(), angles: angles.to_vec() }
    }

    fn fit(&self, noise: Option<f64>) -> Result<Fitted, Error> {
        let samples = Samples { times: &self.times, angles: &self.angles };
        let free = Equations::new(samples, self.knots, [End::Free; 2]);
        // The ends are judged by the samples alone: what a large given noise smooths away at an end
        // of the motion would be taken for a rate there.
        let own = predicting(&free);
        let fit = free.fit(10_f64.powf(own));
        let (own_noise, residual) = (fit.noise(), fit.residual());
        let ends = [begin(&fit, own_noise)?, condition(&fit, self.knots.count, own_noise)];
        let (power, noise) = match noise {
            Some(noise) => (with_noise(&free, noise), noise),
            None => (own, own_noise),
        };
        let fit = Equations::new(samples, self.knots, ends).fit(10_f64.powf(power));
        Ok(Fitted { first: self.first, fit, ends, noise, residual })
    }
}

impl Fitted {
    /// True if the part ends with the samples, whose last knot is that of `knots`, or at rest.
    fn rests_before(&self, knots: Knots) -> bool {
        self.first + self.fit.knots().count == knots.count || self.ends[1] != End::Free
    }
}

/// Returns the mean squared error with which the samples of all parts predict each other, times
/// their number, rad²: the generalised cross-validation of [`Fit::prediction`].
fn prediction(parts: &[Fitted]) -> f64 {
    let [squares, free] = [0, 1].map(|k| parts.iter().map(|part| part.residual[k]).sum::<f64>());
    squares / (free * free)
}

/// Returns knots at whole ticks that are about as far apart as the samples, or a tick. A method
/// sees the acceleration at ticks only: with eight knots a tick, one that jumps in d-fast costs
/// 2.4e-3 L of the tip, with one 9e-4 L.
fn knots(times: &[f64], tick: f64) -> Result<Knots, Error> {
    let count = times.len();
    if count < FEWEST {
        return Err(Error::new(format_args!(
            "{count} rows; must be at least {FEWEST} to be taken as samples; --as waypoints passes \
             through each"
        )));
    }
    let end = times[count - 1];
    let mut gaps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    gaps.sort_by(f64::total_cmp);
    let ticks = (gaps[gaps.len() / 2] / tick * (1.0 + 1e-9)).floor().max(1.0);
    let width = ticks * tick;
    let intervals = (end / width - 1e-6).ceil().max(4.0);
    if intervals > MOST_KNOTS {
        return Err(Error::new(format_args!(
            "{end} s of samples; must be at most {} s, a million knots {width} s apart",
            MOST_KNOTS * width
        )));
    }
    Ok(Knots { width, count: intervals as usize })
}

/// Returns the power of the smoothing with which the residuals are as large as the noise.
fn with_noise(equations: &Equations<'_>, noise: f64) -> f64 {
    let (mut low, mut high) = (f64::from(POWERS.0), f64::from(POWERS.1));
    let too_close = |power: f64| equations.fit(10_f64.powf(power)).noise() < noise;
    if !too_close(low) {
        return low;
    }
    for _ in 0..NARROWINGS {
        let middle = 0.5 * (low + high);
        if too_close(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Returns the power of the smoothing with which the samples predict each other best.
fn predicting(equations: &Equations<'_>) -> f64 {
    let of = |power: f64| equations.fit(10_f64.powf(power)).prediction();
    let powers: Vec<f64> = (POWERS.0..=POWERS.1).map(f64::from).collect();
    let best =
        powers.into_iter().map(|power| (of(power), power)).min_by(|a, b| a.0.total_cmp(&b.0));
    let best = best.map_or(0.0, |(_, power)| power);
    let golden = 0.5 * (5_f64.sqrt() - 1.0);
    let (mut low, mut high) = (best - 1.0, best + 1.0);
    for _ in 0..NARROWINGS {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if of(a) < of(b) { high = b } else { low = a }
    }
    0.5 * (low + high)
}

/// Returns the condition at the beginning, where the hub must be at rest.
fn begin(fit: &Fit, noise: f64) -> Result<End, Error> {
    match condition(fit, 0, noise) {
        End::Free => Err(Error::new(format_args!(
            "the samples begin with the hub turning at {:.4} rad/s; they must begin at rest: put \
             rows of the rest before it",
            fit.rate(0)
        ))),
        rest => Ok(rest),
    }
}

/// Returns the condition at an end of the fit that its rate and acceleration there allow.
fn condition(fit: &Fit, knot: usize, noise: f64) -> End {
    let count = fit.knots().count;
    let peak = |of: &dyn Fn(usize) -> f64| (0..=count).map(|k| of(k).abs()).fold(0.0, f64::max);
    let rate = SURE * fit.rate_error(knot, noise);
    if fit.rate(knot).abs() > rate.max(NONE * peak(&|k| fit.rate(k))) {
        return End::Free;
    }
    let acceleration = SURE * fit.acceleration_error(knot, noise);
    let none = acceleration.max(NONE * peak(&|k| fit.acceleration(k)));
    if fit.acceleration(knot).abs() > none { End::Rest } else { End::SmoothRest }
}

fn motion(parts: &[Fitted], knots: Knots) -> Smoothed {
    let width = knots.width;
    let (mut rows, mut squares) = (Vec::new(), 0.0);
    for (k, part) in parts.iter().enumerate() {
        let Fitted { first, fit, ends, noise, .. } = part;
        let count = fit.knots().count;
        let row = |knot: usize| {
            let time = knot as f64 * width;
            let rests = (knot == count && ends[1] != End::Free) || (knot == 0);
            let rate = if rests { 0.0 } else { fit.rate(knot) };
            Waypoint::at(time + *first as f64 * width, fit.angle(time)).turning(rate)
        };
        // One cubic leads over the rest before a part, to where it begins.
        let begins = usize::from(k == 0 && *first == 0);
        rows.extend((begins..=count).map(row));
        squares += (0..=count).map(|k| fit.acceleration_error(k, *noise).powi(2)).sum::<f64>();
    }
    let end = knots.count as f64 * width;
    if let Some(last) = rows.last().copied().filter(|last| last.time < end - 0.5 * width) {
        rows.push(Waypoint { time: end, ..last });
    }
    let [mut noises, mut weights] = [0.0; 2];
    for part in parts {
        noises += part.noise * part.noise * part.residual[1];
        weights += part.residual[1];
    }
    Smoothed {
        from: parts.first().map_or(0.0, |part| part.fit.angle(0.0)),
        rows,
        noise: (noises / weights).sqrt(),
        farthest: parts.iter().map(|part| part.fit.farthest).fold(0.0, f64::max),
        acceleration_error: (squares / (knots.count + 1) as f64).sqrt(),
        knot: width,
    }
}
