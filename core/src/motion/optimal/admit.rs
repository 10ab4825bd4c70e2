//! A time-optimal motion held against limits.

use super::shortest::STILL;
use super::{Bounds, TimeOptimal};
use crate::Error;
use crate::motion::{Limits, Peaks, admit};

impl TimeOptimal {
    /// Returns the motion if the hub begins within its bounds, and keeps `limits` and a radian a
    /// tick.
    pub(crate) fn admitted(self, limits: &Limits, tick: f64) -> Result<Self, Error> {
        let Bounds { rate, acceleration, deceleration, jerk } = self.bounds;
        let bounds = Limits {
            rate: Some(rate),
            acceleration: Some(acceleration),
            deceleration: Some(deceleration),
            jerk: Some(jerk),
            ..Limits::default()
        };
        let peaks = self.peaks();
        let [speeding, slowing] = self.kinds();
        for limits in [&bounds, limits] {
            admit(&limits.of_speeding(), &Peaks { acceleration: speeding, ..peaks }, tick)?;
            admit(&limits.of_slowing(), &Peaks { acceleration: slowing, ..peaks }, tick)?;
        }
        Ok(self)
    }

    /// Greatest |θ̈| of the hub while it speeds up and while it slows down, rad/s².
    fn kinds(&self) -> [f64; 2] {
        let mut kinds = [0.0_f64; 2];
        for piece in self.pieces() {
            let [_, end, after] = piece.after(piece.duration);
            // A rate of rounding has no sign.
            let still = STILL * self.bounds.rate;
            for (rate, acceleration) in [(piece.rate, piece.acceleration), (end, after)] {
                let other = piece.rate + end - rate;
                let sign = if libm::fabs(rate) > still { rate } else { other };
                let kind = usize::from(sign * acceleration < 0.0);
                kinds[kind] = kinds[kind].max(libm::fabs(acceleration));
            }
        }
        kinds
    }
}
