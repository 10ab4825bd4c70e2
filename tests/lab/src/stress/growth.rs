//! Test for an arm that swings up when it is left alone.

/// Least swing that is judged, fraction of L: ten times the swing at which an arm is let sleep.
pub const TOLD: f64 = 10.0 * stillbeam::stepper::SLEEP;

/// True if the swing of the last part of the hold, the last `held` ticks, exceeds that of its first
/// by a half. Swings below [`TOLD`] of the link's length cannot be told from rounding and sleep.
pub fn grows(found: &[f64], held: usize, length: f64) -> bool {
    let held = &found[found.len().saturating_sub(held)..];
    let part = held.len() / 5;
    if part == 0 {
        return false;
    }
    let swing = |part: &[f64]| {
        let most = part.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        most - part.iter().copied().fold(f64::INFINITY, f64::min)
    };
    let peak = found.iter().fold(0.0, |peak: f64, w| peak.max(w.abs()));
    let (first, last) = (swing(&held[..part]), swing(&held[held.len() - part..]));
    // What rounds up from nothing is not growth yet.
    last > 1.5 * first && last > f64::max(1e-3 * peak, TOLD * length)
}

#[cfg(test)]
mod tests {
    use super::grows;

    #[test]
    fn tells_growth_from_a_steady_swing() {
        let swing = |rate: f64| -> Vec<f64> {
            (0..1500).map(|k| f64::from(k) * 0.3).map(|t| (rate * t).exp() * t.sin()).collect()
        };
        assert!(!grows(&swing(0.0), 1500, 1.0) && !grows(&swing(-1e-3), 1500, 1.0));
        assert!(grows(&swing(3e-3), 1500, 1.0));
        assert!(!grows(&swing(3e-3), 0, 1.0));
    }
}
