//! A change of rate and acceleration under limits that depend on the sign.

use super::{Bounds, Phases};

/// Rate, rad/s, and acceleration, rad/s².
pub(super) type Rate = [f64; 2];

/// The two ends of a motion and its limits. Limits are magnitudes: the acceleration is within
/// `−lower ..= upper`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Problem {
    pub from: Rate,
    pub to: Rate,
    /// Highest acceleration, rad/s².
    pub upper: f64,
    /// Lowest acceleration's magnitude, rad/s².
    pub lower: f64,
    /// |θ̇|, rad/s.
    pub rate: f64,
    /// rad/s³; infinite if the acceleration may jump: those of the two ends do not matter then.
    pub jerk: f64,
}

/// The fastest change of the rate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ramp {
    pub phases: Phases,
    /// Angle turned, rad.
    pub distance: f64,
}

impl Problem {
    /// A motion of a hub that turns forward.
    pub fn forward(from: Rate, to: Rate, bounds: &Bounds) -> Self {
        let Bounds { rate, acceleration: upper, deceleration: lower, jerk } = *bounds;
        if jerk.is_infinite() {
            return Self { from: [from[0], 0.0], to: [to[0], 0.0], upper, lower, rate, jerk };
        }
        Self { from, to, upper, lower, rate, jerk }
    }

    /// Returns the mirror image: every sign is the opposite.
    pub fn mirror(&self) -> Self {
        let opposite = |rate: Rate| rate.map(|x| -x);
        Self {
            from: opposite(self.from),
            to: opposite(self.to),
            upper: self.lower,
            lower: self.upper,
            ..*self
        }
    }

    /// Returns the same motion backwards in time, which turns by the same angle.
    pub fn reverse(&self) -> Self {
        let backwards = |[v, a]: Rate| [v, -a];
        Self {
            from: backwards(self.to),
            to: backwards(self.from),
            upper: self.lower,
            lower: self.upper,
            ..*self
        }
    }

    /// Change of the rate, rad/s.
    pub fn change(&self) -> f64 {
        self.to[0] - self.from[0]
    }

    /// True if the fastest change of the rate is by jerk + −, false if it is by − +. Between the
    /// two lies the change that one sign of the jerk makes: both would do for it, but a peak is not
    /// negative and a trough is not positive.
    pub fn rises(&self) -> bool {
        let [from, to] = [self.from[1], self.to[1]];
        let squares = (to * to - from * from) / (2.0 * self.jerk);
        let direct = if to >= from { squares } else { -squares };
        self.change() > direct || self.change() == direct && from.max(to) >= 0.0
    }

    /// The fastest change of the rate.
    pub fn ramp(&self) -> Ramp {
        if self.rises() { self.rise() } else { self.mirror().rise().mirror() }
    }

    /// The change of the rate by jerk + −: the acceleration's peak has the square
    /// `j Δω + (a₀² + a₁²)/2`, or is held at the limit.
    pub fn rise(&self) -> Ramp {
        let ([v, from], to) = (self.from, self.to[1]);
        let (upper, jerk) = (self.upper, self.jerk);
        let (peak, hold) = if jerk.is_infinite() {
            (upper, self.change() / upper)
        } else {
            let square = jerk * self.change() + 0.5 * (from * from + to * to);
            if square > upper * upper {
                (upper, (square - upper * upper) / (jerk * upper))
            } else {
                (libm::sqrt(square.max(0.0)).max(from).max(to), 0.0)
            }
        };
        let (up, down) = ((peak - from) / jerk, (peak - to) / jerk);
        let after_up = v + 0.5 * up * (from + peak);
        let after_hold = after_up + hold * peak;
        let distance = up * (v + up * (2.0 * from + peak) / 6.0)
            + hold * (after_up + 0.5 * hold * peak)
            + down * (after_hold + down * (2.0 * peak + to) / 6.0);
        let durations = [up, hold, down, 0.0, 0.0, 0.0, 0.0];
        Ramp { phases: Phases { durations, peak, trough: to, mirrored: false }, distance }
    }
}

impl Ramp {
    fn mirror(self) -> Self {
        Self { phases: self.phases.mirror(), distance: -self.distance }
    }
}
