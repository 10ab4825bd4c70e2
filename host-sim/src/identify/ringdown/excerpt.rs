//! The part of a log in which the arm vibrates freely.

use nalgebra::DVector;

use crate::identify::clean::Clipping;
use crate::identify::log::Log;
use crate::identify::warning::Warning;

/// Rise of the envelope, from one period to the third after it, that a free vibration does not
/// have.
const EXCITED: f64 = 2.5;

/// Samples of a window of the envelope at least.
const SAMPLES: f64 = 8.0;

/// Share of the largest envelope from which a window may be that of the excitation: noise makes a
/// later one the largest where the damping is light.
const STRONG: f64 = 0.8;

/// Share of the largest envelope below which a rise is noise.
const LOUD: f64 = 0.1;

/// Share of the largest sample below which the arm was at rest before it.
const QUIET: f64 = 0.3;

/// Largest sample over that of a period later from which it is a blow.
const STRUCK: f64 = 1.6;

/// Share of clipped samples from which the vibration is taken up behind them only.
const CLIPPED: f64 = 0.35;

/// Free vibration: times from its beginning, and what the sensor shows.
#[derive(Clone, Debug)]
pub struct Excerpt {
    /// The log.
    pub name: String,
    /// Time of the beginning in the log, s.
    pub begin: f64,
    /// Times from there, s.
    pub time: Vec<f64>,
    /// The sensor.
    pub value: DVector<f64>,
}

impl Excerpt {
    /// Takes the vibration from a period after the excitation to the end or to the next excitation.
    /// Where much is clipped it begins behind that. `period` is roughly that of the strongest
    /// vibration, s.
    pub fn of(
        log: &Log,
        period: f64,
        clipped: Option<Clipping>,
        warnings: &mut Vec<Warning>,
    ) -> Self {
        // Fewer samples do not show how large a vibration is.
        let period = period.max(SAMPLES * log.interval());
        let windows = envelope(log, period);
        let loudest = windows.iter().map(|window| window.1).fold(0.0, f64::max);
        let peak = windows.iter().position(|window| window.1 >= STRONG * loudest).unwrap_or(0);
        let mut begin = onset(log, period, windows[peak].0);
        let late = log.time[0] + 0.5 * (log.time[log.time.len() - 1] - log.time[0]);
        // Clipping that goes on is no excitation.
        if let Some(Clipping { first, last, share }) = clipped {
            if share > CLIPPED && last < late {
                begin = begin.max(last + period);
            } else if share <= CLIPPED && first < begin {
                // The largest samples are missing: what is clipped first is the excitation.
                begin = if first < log.time[0] + period { log.time[0] } else { first + period };
            }
        }
        let again = (peak + 1..windows.len().saturating_sub(2)).find(|&k| {
            let (before, after) = (windows[k].1, windows[k + 2].1);
            windows[k].0 > begin && after > EXCITED * before && after > LOUD * loudest
        });
        let end = again.map_or(f64::INFINITY, |k| windows[k].0 - 0.5 * period);
        if again.is_some() {
            warnings.push(Warning::SecondExcitation { log: log.name.clone(), at_s: end });
        }
        Self::between(log, begin, end)
    }

    fn between(log: &Log, begin: f64, end: f64) -> Self {
        let within = |t: f64| t >= begin && t < end;
        let rows = || log.time.iter().zip(&log.sensor).filter(|row| within(*row.0));
        let begin = rows().next().map_or(begin, |row| *row.0);
        Self {
            name: log.name.clone(),
            begin,
            time: rows().map(|row| row.0 - begin).collect(),
            value: DVector::from_vec(rows().map(|row| *row.1).collect()),
        }
    }

    /// Length, s.
    pub fn length(&self) -> f64 {
        self.time.last().copied().unwrap_or(0.0)
    }

    /// Returns the part between two times from the beginning, whose times are kept.
    pub fn part(&self, from: f64, to: f64) -> Self {
        let rows = || self.time.iter().zip(self.value.iter());
        let inside = || rows().filter(|row| (from..to).contains(row.0));
        Self {
            name: self.name.clone(),
            begin: self.begin,
            time: inside().map(|row| *row.0).collect(),
            value: DVector::from_vec(inside().map(|row| *row.1).collect()),
        }
    }
}

/// Returns the time from which the arm vibrates freely, s: a period after the largest sample near
/// `loud`, or the log's first one if it vibrates already when the log begins.
fn onset(log: &Log, period: f64, loud: f64) -> f64 {
    let mean = log.sensor.iter().sum::<f64>() / log.sensor.len() as f64;
    let largest = |from: f64, to: f64| {
        let rows = log.time.iter().zip(&log.sensor).filter(|row| (from..to).contains(row.0));
        rows.map(|row| ((row.1 - mean).abs(), *row.0))
            .fold((0.0, from), |most, x| if x.0 > most.0 { x } else { most })
    };
    let begin = log.time[0];
    let (height, at) = largest(loud - 0.5 * period, loud + 0.5 * period);
    let (after, _) = largest(at + period, at + 2.0 * period);
    let (before, _) = largest(begin, at - 0.125 * period);
    let is_at_beginning = at < begin + 1.01 * period;
    let is_quiet_before = at > begin + 0.125 * period && before < QUIET * height;
    if is_at_beginning && !is_quiet_before && height < STRUCK * after { begin } else { at + period }
}

/// Returns the middles of windows of a period and the spread of the sensor in each: half of what
/// lies between its extremes.
fn envelope(log: &Log, period: f64) -> Vec<(f64, f64)> {
    let mut windows = Vec::new();
    let mut k = 0;
    let first = log.time[0];
    while k < log.time.len() {
        let index = ((log.time[k] - first) / period).floor();
        let (mut low, mut high) = (log.sensor[k], log.sensor[k]);
        while k < log.time.len() && ((log.time[k] - first) / period).floor() == index {
            low = low.min(log.sensor[k]);
            high = high.max(log.sensor[k]);
            k += 1;
        }
        windows.push((first + (index + 0.5) * period, 0.5 * (high - low)));
    }
    windows
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use rand::{Rng, SeedableRng, rngs::StdRng};

    use super::*;
    use crate::identify::log::Kind;

    /// Five periods of a vibration that hardly decays, with noise.
    fn log(seed: u64, begin: f64) -> Log {
        let mut random = StdRng::seed_from_u64(seed);
        let time: Vec<f64> = (0..1200).map(|k| 0.005 * f64::from(k)).collect();
        let clean = |t: f64| if t < begin { 0.0 } else { (TAU * (t - begin)).sin() };
        let sensor = time
            .iter()
            .map(|t| clean(*t) * (-0.02 * (t - begin)).exp() + random.random_range(-0.2..0.2))
            .collect();
        Log {
            name: String::new(),
            time,
            hub: None,
            sensor,
            column: String::new(),
            kind: Kind::Deflection,
            unit: "m".to_owned(),
            same_time: 0,
            empty: 0,
        }
    }

    /// Noise makes one of the later windows the largest. It is not taken for the excitation.
    #[test]
    fn noise_does_not_shorten_a_record() {
        for seed in 0..20 {
            let begin = |log: &Log| Excerpt::of(log, 1.0, None, &mut Vec::new()).begin;
            assert_eq!(begin(&log(seed, 0.0)), 0.0, "{seed}");
            let late = begin(&log(seed, 1.3));
            assert!((2.3..3.4).contains(&late), "{seed}: {late}");
        }
    }

    /// Windows of two samples beat with a vibration of 2.2 samples a period: the first of them may
    /// show next to none of it.
    #[test]
    fn few_samples_a_period_do_not_shorten_a_record() {
        for phase in 0..8 {
            let mut log = log(0, 0.0);
            let angle = |t: f64| TAU * (t / 0.011 + 0.125 * f64::from(phase));
            log.sensor = log.time.iter().map(|t| angle(*t).sin() * (-0.02 * t).exp()).collect();
            assert_eq!(Excerpt::of(&log, 0.011, None, &mut Vec::new()).begin, 0.0, "{phase}");
        }
    }
}
