//! Drops samples that tell nothing: clipped ones and repeated ones. Finds gaps and jitter.

use super::log::Log;
use super::warning::Warning;

/// Samples at most that a fit takes. More are averaged in blocks.
const MOST: usize = 24_000;

/// Fewest samples at an extreme value that count as clipped.
const CLIPPED: usize = 4;

/// Step into an extreme value, in quanta of the sensor, above which a run of that value is clipped.
/// At the peak of a smooth signal a run of two samples is entered by four quanta at most.
const STEEP: f64 = 6.0;

/// Median step from sample to sample, in quanta, above which equal neighbours are repeats.
const FINE: f64 = 6.0;

/// Shares of samples above which repeats and jitter are worth a warning.
const REPEATED: f64 = 0.01;
const JITTER: f64 = 0.1;

/// A step of time in median ones that counts as a gap.
const GAP: f64 = 2.5;

/// Clipped samples of a log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clipping {
    /// Time of the first one, s.
    pub first: f64,
    /// Time of the last one, s.
    pub last: f64,
    /// Share of the samples from the first to the last one.
    pub share: f64,
}

/// Removes clipped and repeated samples, and averages in blocks what is sampled far too fast.
/// Returns what was clipped, if anything was.
pub fn clean(log: &mut Log, warnings: &mut Vec<Warning>) -> Option<Clipping> {
    counted(log, warnings);
    timing(log, warnings);
    let quantum = quantum(&log.sensor);
    let clipped = mark_clipped(&log.sensor, quantum);
    let repeated = mark_repeats(&log.sensor, quantum);
    let count = |marks: &[bool]| marks.iter().filter(|&&mark| mark).count();
    let first = clipped.iter().position(|&mark| mark);
    let last = clipped.iter().rposition(|&mark| mark);
    let clipping = first.zip(last).map(|(first, last)| Clipping {
        first: log.time[first],
        last: log.time[last],
        share: count(&clipped) as f64 / (last - first + 1) as f64,
    });
    if let Some(Clipping { last: last_s, .. }) = clipping {
        let (log, count) = (log.name.clone(), count(&clipped));
        warnings.push(Warning::Clipped { log, count, last_s });
    }
    let share = count(&repeated) as f64 / log.sensor.len() as f64;
    if share > REPEATED {
        warnings.push(Warning::Repeated { log: log.name.clone(), percent: 100.0 * share });
    }
    let kept: Vec<bool> =
        widened(&clipped).iter().zip(&repeated).map(|(clip, repeat)| !clip && !repeat).collect();
    log.keep(&kept);
    average(log);
    clipping
}

fn counted(log: &Log, warnings: &mut Vec<Warning>) {
    let Log { name, same_time, empty, .. } = log;
    if same_time + empty > 0 {
        let (log, same_time, empty) = (name.clone(), *same_time, *empty);
        warnings.push(Warning::LeftOut { log, same_time, empty });
    }
}

fn timing(log: &Log, warnings: &mut Vec<Warning>) {
    let interval = log.interval();
    let steps = || log.time.windows(2).map(|pair| pair[1] - pair[0]);
    let gaps = steps().filter(|step| *step > GAP * interval).count();
    if gaps > 0 {
        let longest_s = steps().fold(0.0, f64::max);
        warnings.push(Warning::Gaps { log: log.name.clone(), count: gaps, longest_s });
    }
    let regular: Vec<f64> = steps().filter(|step| *step <= GAP * interval).collect();
    let mean = regular.iter().sum::<f64>() / regular.len() as f64;
    let squares = regular.iter().map(|step| (step - mean).powi(2)).sum::<f64>();
    let jitter = (squares / regular.len() as f64).sqrt() / mean;
    if jitter > JITTER {
        warnings.push(Warning::Jitter { log: log.name.clone(), percent: 100.0 * jitter });
    }
}

/// Returns the least step between different values that is common, the sensor's resolution.
fn quantum(values: &[f64]) -> f64 {
    let mut steps: Vec<f64> = values
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .filter(|step| *step > 0.0)
        .collect();
    if steps.is_empty() {
        return 0.0;
    }
    steps.sort_by(f64::total_cmp);
    steps[steps.len() / 100]
}

/// Marks samples at the extreme values that the sensor cannot exceed.
///
/// The extreme value must stand in runs, and a run must be entered or left by a steep step: the
/// peak of a signal that is quantised has runs too, which begin and end gently.
fn mark_clipped(values: &[f64], quantum: f64) -> Vec<bool> {
    let mut marks = vec![false; values.len()];
    let (low, high) = (
        values.iter().copied().fold(f64::INFINITY, f64::min),
        values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    );
    let near = 1e-6 * (high - low);
    for extreme in [low, high] {
        let at = |k: usize| (values[k] - extreme).abs() <= near;
        let mut runs = Vec::new();
        let mut k = 0;
        while k < values.len() {
            let begin = k;
            while k < values.len() && at(k) {
                k += 1;
            }
            if k > begin {
                runs.push(begin..k);
            }
            k += 1;
        }
        let is_steep = |run: &std::ops::Range<usize>| {
            let into = run.start.checked_sub(1).map(|k| (values[k] - extreme).abs());
            let out = values.get(run.end).map(|value| (value - extreme).abs());
            into.into_iter().chain(out).any(|step| step > STEEP * quantum)
        };
        let total: usize = runs.iter().map(std::ops::Range::len).sum();
        if total >= CLIPPED && runs.iter().any(|run| run.len() >= 2 && is_steep(run)) {
            runs.into_iter().flatten().for_each(|k| marks[k] = true);
        }
    }
    marks
}

/// Marks samples that repeat the one before, in a signal that is too lively for that.
fn mark_repeats(values: &[f64], quantum: f64) -> Vec<bool> {
    let mut steps: Vec<f64> = values
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .filter(|step| *step > 0.0)
        .collect();
    steps.sort_by(f64::total_cmp);
    let lively = steps.get(steps.len() / 2).is_some_and(|median| *median > FINE * quantum);
    let repeats = |k: usize| lively && k > 0 && values[k] == values[k - 1];
    (0..values.len()).map(repeats).collect()
}

/// Returns the marks and their neighbours: a sample beside a clipped one may be a mean with it.
fn widened(marks: &[bool]) -> Vec<bool> {
    let at = |k: Option<usize>| k.and_then(|k| marks.get(k)).is_some_and(|mark| *mark);
    (0..marks.len()).map(|k| at(Some(k)) || at(k.checked_sub(1)) || at(Some(k + 1))).collect()
}

/// Averages blocks of neighbours, times and values alike, until there are few enough. The mean over
/// a block scales a damped sine by a constant, so that neither frequency nor damping changes.
fn average(log: &mut Log) {
    let block = log.time.len().div_ceil(MOST);
    if block < 2 {
        return;
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let blocks = |values: &Vec<f64>| values.chunks_exact(block).map(mean).collect();
    log.time = blocks(&log.time);
    log.sensor = blocks(&log.sensor);
    log.hub = log.hub.as_ref().map(blocks);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn swing(quantum: f64, limit: f64) -> Vec<f64> {
        let of = |k: i32| (0.05 * f64::from(k)).sin() * (-0.001 * f64::from(k)).exp();
        (0..2000).map(|k| ((of(k) / quantum).round() * quantum).clamp(-limit, limit)).collect()
    }

    #[test]
    fn clipped_peaks_are_found_and_quantised_ones_are_not() {
        let clipped = mark_clipped(&swing(1e-6, 0.7), 1e-6);
        assert!((100..300).contains(&clipped.iter().filter(|mark| **mark).count()));
        for bits in [50.0, 200.0, 2000.0] {
            let values = swing(1.0 / bits, 2.0);
            let clipped = mark_clipped(&values, quantum(&values));
            assert!(!clipped.contains(&true), "{bits} steps");
        }
    }

    #[test]
    fn held_samples_are_repeats_and_a_coarse_sensors_are_not() {
        let mut values = swing(1e-9, 2.0);
        (0..values.len()).for_each(|k| values[k] = values[k - k % 4]);
        let repeats = mark_repeats(&values, quantum(&values));
        assert_eq!(repeats.iter().filter(|mark| **mark).count(), 1500);
        let coarse = swing(0.02, 2.0);
        assert!(!mark_repeats(&coarse, quantum(&coarse)).contains(&true));
    }
}
