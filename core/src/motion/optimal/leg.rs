//! One half of a motion whose acceleration is zero somewhere inside: up to the rate there.

/// The way from a rate and an acceleration up to a higher rate without acceleration: jerk +, none,
/// −. Backwards in time it is the way down from that rate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    /// Durations of the three phases, s.
    pub durations: [f64; 3],
    /// Acceleration at which the jerk changes, rad/s².
    pub peak: f64,
    /// Angle turned, rad.
    pub distance: f64,
}

impl Leg {
    /// From rate `v` and acceleration `a`. `square` is the peak's square if nothing limits it; a
    /// peak above `limit` is held at the limit for as much longer as the same change of rate takes.
    pub fn new([v, a]: [f64; 2], square: f64, limit: f64, jerk: f64) -> Self {
        let (peak, hold) = if square > limit * limit {
            (limit, (square - limit * limit) / (jerk * limit))
        } else {
            (libm::sqrt(square.max(0.0)), 0.0)
        };
        // Rounding may leave the peak below where it begins.
        let up = ((peak - a) / jerk).max(0.0);
        let down = peak / jerk;
        let after_up = v + 0.5 * up * (a + peak);
        let after_hold = after_up + hold * peak;
        let distance = up * (v + up * (2.0 * a + peak) / 6.0)
            + hold * (after_up + 0.5 * hold * peak)
            + down * (after_hold + down * peak / 3.0);
        Self { durations: [up, hold, down], peak, distance }
    }
}
