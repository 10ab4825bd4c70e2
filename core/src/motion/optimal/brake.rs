//! The way back into the limits, for a hub that begins outside of them.

use super::Problem;

/// A stretch of constant jerk: its duration, s, and jerk, rad/s³.
pub(super) type Stretch = [f64; 2];

impl Problem {
    /// The shortest way from where the hub begins to a rate and an acceleration within the limits,
    /// which it can then keep. Both stretches are empty if it begins there.
    pub fn brake(&self) -> [Stretch; 2] {
        let [v, a] = self.from;
        let Self { upper, lower, rate, jerk, .. } = *self;
        if jerk.is_infinite() {
            let beyond = libm::fabs(v) - rate;
            let limit = if v > 0.0 { lower } else { upper };
            return [[0.0, 0.0], [(beyond / limit).max(0.0), 0.0]];
        }
        let opposite = |stretches: [Stretch; 2]| stretches.map(|[t, j]| [t, -j]);
        // Rate after the acceleration is brought to zero at once.
        let settled = v + 0.5 * a * libm::fabs(a) / jerk;
        if a > upper {
            self.lower_acceleration()
        } else if a < -lower {
            opposite(self.mirror().lower_acceleration())
        } else if settled > rate || v > rate && settled > -rate {
            self.lower_rate()
        } else if settled < -rate || v < -rate {
            opposite(self.mirror().lower_rate())
        } else {
            [[0.0; 2]; 2]
        }
    }

    /// Brings the acceleration down to its limit, and holds it there if the rate is still too low.
    fn lower_acceleration(&self) -> [Stretch; 2] {
        let [v, a] = self.from;
        let Self { upper, rate, jerk, .. } = *self;
        if v + 0.5 * a * a / jerk > rate {
            return self.lower_rate();
        }
        let down = (a - upper) / jerk;
        let reached = v + 0.5 * down * (a + upper);
        let (to_lowest, to_highest) =
            ((-rate - reached) / upper, (rate - reached) / upper - 0.5 * upper / jerk);
        [[down, -jerk], [to_lowest.min(to_highest).max(0.0), 0.0]]
    }

    /// Brings the rate down to its limit, by way of the lowest acceleration, and not so far that it
    /// could not be kept above the lowest rate.
    fn lower_rate(&self) -> [Stretch; 2] {
        let [v, a] = self.from;
        let Self { lower, rate, jerk, .. } = *self;
        let beyond = a * a + 2.0 * jerk * (v - rate);
        let to_limit = (a + libm::sqrt(beyond.max(0.0))) / jerk;
        let above = 0.5 * a * a + jerk * (v + rate);
        let to_lowest = (a + libm::sqrt(above.max(0.0))) / jerk;
        let down = to_limit.min(to_lowest).max(0.0);
        let to_lower = (a + lower) / jerk;
        if to_lower >= down {
            return [[down, -jerk], [0.0; 2]];
        }
        let reached = v + 0.5 * to_lower * (a - lower);
        let hold =
            ((reached - rate) / lower).min((reached + rate) / lower - 0.5 * lower / jerk).max(0.0);
        [[to_lower.max(0.0), -jerk], [hold, 0.0]]
    }
}
