//! Residual vibration: one definition for every command, table and page.
//!
//! The residual is the largest deflection of the tip from the arm's rest, its static equilibrium at
//! the final angle, over a first period after the last arrival. It depends neither on the settling
//! time of the move nor on where the ticks fall within a vibration.

use stillbeam::Scene;

use crate::error::Error;
use crate::reference::rod;

/// Least length of the time after arrival, ticks. A vibration faster than the ticks is then still
/// seen at several of its phases.
const LEAST_TICKS: f64 = 6.0;

/// Most ticks by which a table is continued. Beyond it an arm has no first period worth waiting
/// for.
const MOST_TICKS: f64 = 1e6;

/// Returns the time after arrival over which the residual is taken, s: a first period of the arm,
/// at least six intervals of `tick` s.
pub fn span(arm: &Scene, tick: f64) -> Result<f64, Error> {
    Ok(rod::first_period(arm)?.max(LEAST_TICKS * tick))
}

/// Returns the ticks of [`span`], rounded up, or `None` if a table is not continued by that many.
pub fn ticks(arm: &Scene, tick: f64) -> Result<Option<u64>, Error> {
    let ticks = (span(arm, tick)? / tick - 1e-9).ceil();
    Ok((ticks <= MOST_TICKS).then_some(ticks as u64))
}

/// Returns the largest |y| of a vibration sampled as `(t, y)`, both in the units given, over
/// `begin` to `begin + span`. Returns zero without samples there.
///
/// Between samples a vibration passes higher than at them. The sinusoid through a largest sample y₀
/// and its neighbours y₋, y₊ has `cos ωh = (y₊ + y₋)/2y₀` and the peak `√(y₀² + (y₊ − y₋)²/4(1 −
/// cos² ωh))`: exact for one mode from three samples a period on, within 2 % at fewer, and the peak
/// of the parabola for many. Samples before `begin`, where the hub still moves, take no part.
pub fn largest(samples: &[(f64, f64)], begin: f64, span: f64) -> f64 {
    let eps = 1e-9 * (1.0 + begin.abs());
    let first = samples.partition_point(|sample| sample.0 < begin - eps);
    let free = &samples[first..];
    let last = free.partition_point(|sample| sample.0 <= begin + span + eps);
    let sampled = free[..last].iter().map(|sample| sample.1.abs()).fold(0.0, f64::max);
    let between = free.windows(3).take(last).enumerate().map(|(k, three)| {
        let (before, after) = (three[1].0 - three[0].0, three[2].0 - three[1].0);
        if (after - before).abs() > 1e-3 * before {
            return 0.0;
        }
        crest([three[0].1, three[1].1, three[2].1], k == 0)
    });
    between.fold(sampled, f64::max)
}

/// Returns the crest of the sinusoid through three samples at equal intervals that lies nearest to
/// the middle one, as a magnitude. Returns zero if none does. With `first`, the crest may also lie
/// next to the first sample, which has no neighbour before it.
fn crest([before, here, after]: [f64; 3], first: bool) -> f64 {
    let cos = 0.5 * (before + after) / here;
    // Straight, or two samples a period: no sinusoid follows.
    if !cos.is_finite() || cos.abs() >= 1.0 - 1e-12 {
        return 0.0;
    }
    let sin = (1.0 - cos * cos).sqrt();
    let peak = here.hypot(0.5 * (after - before) / sin);
    let highest = here.abs() >= before.abs() && here.abs() >= after.abs();
    if highest {
        // Of one mode the crest is at most half an interval away. Several modes, or noise, are not
        // allowed to make more of it than that.
        return peak.min(here.abs() * (2.0 / (1.0 + cos.abs())).sqrt());
    }
    // From the first sample on, the vibration rises before it falls to the second.
    let angle = sin.atan2(cos);
    let phase = (0.5 * (after - before) / sin / here).atan();
    if first && cos > 0.0 && phase < -0.5 * angle && phase >= -angle {
        return peak.min(before.abs() * (2.0 / (1.0 + cos)).sqrt());
    }
    0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Amplitude of `cos(ωt + φ)` from samples every `h`, over a first period.
    fn amplitude(omega: f64, phase: f64, h: f64) -> f64 {
        let span = (std::f64::consts::TAU / omega).max(LEAST_TICKS * h);
        let count = (span / h).ceil() as usize + 1;
        let samples: Vec<_> =
            (0..count).map(|k| k as f64 * h).map(|t| (t, (omega * t + phase).cos())).collect();
        largest(&samples, 0.0, span)
    }

    #[test]
    fn one_mode_is_exact_at_any_phase() {
        for (h, error) in [(0.001, 1e-6), (0.03, 1e-6), (0.7, 1e-6), (1.9, 1e-6), (2.6, 0.02)] {
            for k in 0..400 {
                let phase = 0.0157 * f64::from(k);
                let found = amplitude(1.0, phase, h);
                assert!((found - 1.0).abs() < error, "h {h}, phase {phase}: {found}");
            }
        }
    }

    #[test]
    fn what_is_no_sinusoid_gives_no_more_than_its_samples_allow() {
        let constant: Vec<_> = (0..20).map(|k| (f64::from(k), 0.25)).collect();
        assert_eq!(largest(&constant, 0.0, 10.0), 0.25);
        let rest: Vec<_> = (0..20).map(|k| (f64::from(k), 0.0)).collect();
        assert_eq!(largest(&rest, 0.0, 10.0), 0.0);
        let spike = [(0.0, 0.0), (1.0, 1e-9), (2.0, -1.0), (3.0, 1.0), (4.0, 0.3), (5.0, 0.0)];
        assert!(largest(&spike, 0.0, 5.0) < 1.42);
        assert_eq!(largest(&[], 0.0, 1.0), 0.0);
    }

    #[test]
    fn the_motion_before_arrival_takes_no_part() {
        let samples: Vec<_> = (0..100)
            .map(|k| 0.01 * f64::from(k))
            .map(|t| (t, if t < 0.3 { 9.0 } else { 0.5 * (20.0 * (t - 0.3)).sin() }))
            .collect();
        assert!((largest(&samples, 0.3, 0.314) - 0.5).abs() < 1e-9);
    }
}
