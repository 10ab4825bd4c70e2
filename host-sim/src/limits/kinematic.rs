//! Rate, acceleration and jerk of a commanded motion, at any time of it.
//!
//! The motion is smooth between two breaks. It is sampled there, and the largest samples are
//! refined. At a break both sides count.

use stillbeam::Limits;

use super::{Case, Excess, Peak, Quantity, Window};
use crate::trajectory::{Side, Trajectory};

/// Samples between two breaks. A still move's acceleration, a polynomial of degree nine, has eight
/// extremes, and up to five copies of moves overlap behind a shaper.
const SAMPLES: u32 = 96;

/// Fraction of the largest sample below which a sample is not refined. A smooth motion rises by
/// less between samples.
const CLOSE: f64 = 0.97;

/// Number of times that a bracket is narrowed by a third: to 1e-5 of it, a peak to 1e-10 of itself.
const NARROWINGS: u32 = 28;

/// Number of times that the bracket of a zero of the rate is halved.
const HALVINGS: u32 = 40;

/// Step of the difference quotient that gives the jerk, fraction of the stretch.
const DIFFERENCE: f64 = 1e-4;

/// Smallest jump of the acceleration that is not taken for rounding, fraction of its peak.
const JUMP: f64 = 1e-7;

/// Greatest magnitudes in a window. Error 1e-6 of each. The jerk is infinite if the commanded
/// acceleration jumps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peaks {
    /// |θ̇|, rad/s.
    pub rate: Peak,
    /// |θ̈|, rad/s².
    pub acceleration: Peak,
    /// |θ̈| of a hub that speeds up, and of one that slows down, rad/s².
    pub kinds: [Peak; 2],
    /// |d³θ/dt³|, rad/s³.
    pub jerk: Peak,
}

impl Peaks {
    /// Returns the peak of a quantity that `limits` hold, or `None` for a load.
    pub fn of(&self, quantity: Quantity, limits: &Limits) -> Option<Peak> {
        match quantity {
            Quantity::Rate | Quantity::Turn => Some(self.rate),
            Quantity::Acceleration if limits.deceleration.is_some() => Some(self.kinds[0]),
            Quantity::Acceleration => Some(self.acceleration),
            Quantity::Deceleration => Some(self.kinds[1]),
            Quantity::Jerk => Some(self.jerk),
            Quantity::Torque | Quantity::Moment => None,
        }
    }
}

/// Returns the first window in which the motion exceeds a limit or turns by more than a radian a
/// tick.
pub fn excess(case: &Case<'_>, trajectory: &Trajectory, limits: &Limits) -> Option<Excess> {
    let kinematic = [limits.rate, limits.acceleration, limits.deceleration, limits.jerk];
    if kinematic.iter().all(Option::is_none)
        // Without a shaper the moves themselves have been held against the tick.
        && case.shaper.is_none()
    {
        return None;
    }
    let stretches = Stretches::of(trajectory);
    case.windows(trajectory)
        .iter()
        .find_map(|window| excess_within(window, &stretches, limits, case.tick))
}

/// Returns the [`excess`] in one window only.
pub fn excess_in(window: &Window, trajectory: &Trajectory, limits: &Limits) -> Option<Excess> {
    excess_within(window, &Stretches::of(trajectory), limits, trajectory.tick())
}

/// Returns the greatest magnitudes from `begin` to `end`, s.
pub fn peaks(trajectory: &Trajectory, begin: f64, end: f64) -> Peaks {
    Stretches::of(trajectory).peaks(begin, end, true)
}

fn excess_within(
    window: &Window,
    stretches: &Stretches<'_>,
    limits: &Limits,
    tick: f64,
) -> Option<Excess> {
    let peaks = stretches.peaks(window.begin, window.end, limits.deceleration.is_some());
    Quantity::KINEMATIC.into_iter().find_map(|quantity| {
        let limit = quantity.limit(limits, tick)?;
        Excess::of(quantity, peaks.of(quantity, limits)?, limit, window.index)
    })
}

/// A motion between its breaks.
struct Stretches<'a> {
    trajectory: &'a Trajectory,
    /// Breaks, the beginning and the end included.
    borders: Vec<f64>,
}

impl<'a> Stretches<'a> {
    fn of(trajectory: &'a Trajectory) -> Self {
        let mut borders = vec![0.0];
        borders.extend(trajectory.breaks());
        borders.push(trajectory.duration());
        Self { trajectory, borders }
    }

    /// `kinds` asks for the peaks of both kinds of acceleration, too.
    fn peaks(&self, begin: f64, end: f64, kinds: bool) -> Peaks {
        let eps = 1e-9 * self.trajectory.tick();
        let inside = |t: f64| t > begin + eps && t < end - eps;
        let first = self.borders.partition_point(|&t| t <= begin + eps);
        let last = self.borders.partition_point(|&t| t < end - eps).max(first);
        let mut cuts = vec![begin];
        cuts.extend(self.borders[first..last].iter().filter(|&&t| inside(t)));
        cuts.push(end);
        let mut peaks = Peaks::default();
        for pair in cuts.windows(2).filter(|pair| pair[1] - pair[0] > eps) {
            let stretch = Stretch { trajectory: self.trajectory, begin: pair[0], end: pair[1] };
            stretch.raise(&mut peaks.rate, &|t| stretch.hub(t).0);
            stretch.raise(&mut peaks.acceleration, &|t| stretch.hub(t).1);
            if kinds {
                stretch.raise_kinds(&mut peaks.kinds);
            }
            stretch.raise(&mut peaks.jerk, &|t| stretch.jerk(t));
        }
        // The window's own end is the next one's beginning; that of the run is nobody's.
        let cuts = if end >= self.trajectory.duration() - eps {
            &cuts[..]
        } else {
            &cuts[..cuts.len() - 1]
        };
        for &t in cuts {
            let [left, right] = [Side::Left, Side::Right].map(|side| self.acceleration(t, side));
            let scale = left.abs().max(right.abs()).max(peaks.acceleration.value);
            if (left - right).abs() > JUMP * scale {
                peaks.jerk.raise(f64::INFINITY, t);
            }
        }
        peaks
    }

    /// Returns θ̈ beside a break; zero before the beginning, and after the end of a run that ends
    /// at rest.
    fn acceleration(&self, t: f64, side: Side) -> f64 {
        let eps = 1e-9 * self.trajectory.tick();
        let before = t <= eps && side == Side::Left;
        let after = t >= self.trajectory.duration() - eps && side == Side::Right;
        if before || after { 0.0 } else { self.trajectory.at(t, side).acceleration }
    }
}

/// A part of a motion with one formula.
struct Stretch<'a> {
    trajectory: &'a Trajectory,
    begin: f64,
    end: f64,
}

impl Stretch<'_> {
    /// Returns θ̇ and θ̈, from within at the ends.
    fn hub(&self, t: f64) -> (f64, f64) {
        let early = t < 0.5 * (self.begin + self.end);
        let hub = self.trajectory.at(t, if early { Side::Right } else { Side::Left });
        (hub.rate, hub.acceleration)
    }

    /// Returns the slope of θ̈ by a difference quotient, one-sided at the ends. Error 1e-7 of the
    /// peak.
    fn jerk(&self, t: f64) -> f64 {
        let step = DIFFERENCE * (self.end - self.begin);
        let here = self.hub(t).1;
        // Divided by what the times differ in after rounding: late in a run a short step loses
        // digits.
        let beside = |step: f64| [t + step - t, self.hub(t + step).1 - here];
        let [[h, f], [k, g]] = if t - step < self.begin {
            [step, 2.0 * step].map(beside)
        } else if t + step > self.end {
            [-step, -2.0 * step].map(beside)
        } else {
            [-step, step].map(beside)
        };
        (k * k * f - h * h * g) / (h * k * (k - h))
    }

    /// Raises the peaks of a hub that speeds up and of one that slows down. Between two zeros of
    /// the rate the sign of the acceleration tells which it is.
    fn raise_kinds(&self, [up, down]: &mut [Peak; 2]) {
        let rate = |t: f64| self.hub(t).0;
        let step = (self.end - self.begin) / f64::from(SAMPLES);
        let at = |k: u32| self.begin + f64::from(k) * step;
        let mut cuts = vec![self.begin];
        for k in 0..SAMPLES {
            let (mut low, mut high) = (at(k), at(k + 1));
            if rate(low) * rate(high) < 0.0 {
                let before = rate(low);
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (low + high);
                    if rate(middle) * before > 0.0 { low = middle } else { high = middle }
                }
                cuts.push(high);
            }
        }
        cuts.push(self.end);
        for pair in cuts.windows(2) {
            let part = Stretch { trajectory: self.trajectory, begin: pair[0], end: pair[1] };
            let sign = rate(0.5 * (part.begin + part.end)).signum();
            part.raise(up, &|t| (sign * part.hub(t).1).max(0.0));
            part.raise(down, &|t| (-sign * part.hub(t).1).max(0.0));
        }
    }

    /// Raises a peak to the greatest magnitude of `of`.
    fn raise(&self, peak: &mut Peak, of: &dyn Fn(f64) -> f64) {
        let step = (self.end - self.begin) / f64::from(SAMPLES);
        let at = |k: u32| if k == SAMPLES { self.end } else { self.begin + f64::from(k) * step };
        let values: Vec<f64> = (0..=SAMPLES).map(|k| of(at(k)).abs()).collect();
        for (k, &value) in (0..).zip(&values) {
            peak.raise(value, at(k));
        }
        let close = CLOSE * peak.value;
        for k in 1..SAMPLES {
            let [before, here, after] = [k - 1, k, k + 1].map(|k| values[k as usize]);
            if here < close || here < before || here < after || (here == before && here == after) {
                continue;
            }
            let (mut low, mut high) = (at(k - 1), at(k + 1));
            for _ in 0..NARROWINGS {
                let third = (high - low) / 3.0;
                let (left, right) = (low + third, high - third);
                if of(left).abs() < of(right).abs() { low = left } else { high = right }
            }
            let t = 0.5 * (low + high);
            peak.raise(of(t), t);
        }
    }
}
