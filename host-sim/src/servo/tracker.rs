//! The position and velocity estimate of a drive: a second-order tracking loop on the counts.

/// Greatest bandwidth, rad/s, over the rate of the updates, Hz, of a loop that settles well. In
/// `w = ωT` its matrix has the determinant `1 − 2w` and the trace `2 − 2w − w²`, so that it is
/// stable for `w² + 4w < 4`, up to 0.828.
pub(super) const MOST_BANDWIDTH: f64 = 0.8;

/// A critically damped tracking loop: `x̂ += T (v̂ + k_p e)`, `v̂ += T k_i e` with `k_p = 2ω` and
/// `k_i = ω²`, as ODrive's `encoder.config.bandwidth` and moteus' `pll_filter_hz` set it.
#[derive(Clone, Copy, Debug)]
pub struct Tracker {
    position: f64,
    velocity: f64,
    /// ω, rad/s.
    bandwidth: f64,
    /// T, s.
    interval: f64,
}

impl Tracker {
    /// Rests at `position` turns.
    pub fn resting(position: f64, bandwidth: f64, interval: f64) -> Self {
        Self { position, velocity: 0.0, bandwidth, interval }
    }

    /// Rests at `position` turns again.
    pub fn rest_at(&mut self, position: f64) {
        (self.position, self.velocity) = (position, 0.0);
    }

    /// Returns the time between two readings, s.
    pub fn interval(&self) -> f64 {
        self.interval
    }

    /// Takes a reading, turns. Returns position, turns, and velocity, turns/s.
    pub fn update(&mut self, reading: f64) -> (f64, f64) {
        let Self { bandwidth, interval, .. } = *self;
        let (kp, ki) = (2.0 * bandwidth, bandwidth * bandwidth);
        self.position += interval * self.velocity;
        let error = reading - self.position;
        self.position += interval * kp * error;
        self.velocity += interval * ki * error;
        (self.position, self.velocity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step of the shaft is forgotten below the greatest bandwidth, and swings up above 0.828.
    #[test]
    fn the_greatest_bandwidth_settles() {
        let left = |share: f64| {
            let mut tracker = Tracker::resting(0.0, share * 1e3, 1e-3);
            (0..1000).map(|_| tracker.update(0.25)).last().map_or(f64::NAN, |(x, _)| x - 0.25).abs()
        };
        assert!(left(MOST_BANDWIDTH) < 1e-9, "{}", left(MOST_BANDWIDTH));
        assert!(left(0.82) < 0.25 && left(0.84) > 1e3, "{} {}", left(0.82), left(0.84));
    }
}
