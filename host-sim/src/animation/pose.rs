//! The arm at one instant, and runs at even times.

/// Intervals of a run that vibrates a few times. Between its pictures the lines move evenly.
pub const INTERVALS: usize = 120;

/// The arm at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Hub angle, rad.
    pub angle: f64,
    /// The tip's Y in the hub frame, m.
    pub deflection: f64,
}

impl Pose {
    /// Takes samples `(t, angle, deflection)` at even times, as [`super::Link::frames`] says.
    pub fn evenly(
        samples: impl IntoIterator<Item = (f64, f64, f64)>,
        end: f64,
        intervals: usize,
    ) -> Vec<Self> {
        let samples: Vec<_> = samples.into_iter().collect();
        if samples.is_empty() {
            return Vec::new();
        }
        (0..=intervals).map(|k| between(&samples, end * k as f64 / intervals as f64)).collect()
    }
}

/// Returns the arm at a time.
fn between(samples: &[(f64, f64, f64)], t: f64) -> Pose {
    let after = samples.partition_point(|sample| sample.0 < t).min(samples.len() - 1);
    let (late, early) = (samples[after], samples[after.saturating_sub(1)]);
    let span = late.0 - early.0;
    let part = if span > 0.0 { ((t - early.0) / span).clamp(0.0, 1.0) } else { 1.0 };
    let mix = |early: f64, late: f64| early + part * (late - early);
    Pose { angle: mix(early.1, late.1), deflection: mix(early.2, late.2) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uneven_samples_become_even_ones() {
        let samples = [(0.0, 0.0, 0.0), (0.1, 1.0, 0.2), (0.5, 5.0, 0.0), (1.0, 10.0, 0.0)];
        let poses = Pose::evenly(samples, 2.0, INTERVALS);
        assert_eq!(poses.len(), INTERVALS + 1);
        for (k, pose) in poses.iter().enumerate() {
            let t = 2.0 * k as f64 / INTERVALS as f64;
            assert!((pose.angle - 10.0 * t.min(1.0)).abs() < 1e-12, "{t}: {pose:?}");
        }
        assert!((poses[6].deflection - 0.2).abs() < 1e-12, "{:?}", poses[6]);
        assert_eq!(Pose::evenly([], 1.0, 2), []);
    }
}
