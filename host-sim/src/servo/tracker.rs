//! The position and velocity estimate of a drive: a second-order tracking loop on the counts.

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
