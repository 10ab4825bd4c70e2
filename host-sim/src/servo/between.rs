//! A drive's motion between two setpoints.

/// Position, velocity and torque that a drive's loops are to follow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Target {
    /// Turns of the motor's shaft.
    pub position: f64,
    /// Turns/s.
    pub velocity: f64,
    /// N m.
    pub torque: f64,
}

/// The way from one setpoint to the next. With the setpoints `x₀` and `x₁`, the time `s` since `x₁`
/// came, and the period `h`:
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Between {
    /// `x₁`, held: zero order.
    Hold,
    /// `x₁ + v₁ s`; velocity and torque held.
    Extrapolate,
    /// `x₀ + (x₁ − x₀) s/h`, and so on for velocity and torque, a period late.
    Linear,
    /// The cubic from `x₀` at velocity `v₀` to `x₁` at `v₁` and its velocity, a period late; torque
    /// as in [`Self::Linear`].
    Hermite,
}

impl Between {
    /// Every way.
    pub const ALL: [Self; 4] = [Self::Hold, Self::Extrapolate, Self::Linear, Self::Hermite];

    /// Name in files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hold => "hold",
            Self::Extrapolate => "extrapolate",
            Self::Linear => "linear",
            Self::Hermite => "hermite",
        }
    }

    /// Time by which the way lags behind the setpoints, s.
    pub fn lag(self, period: f64) -> f64 {
        match self {
            Self::Hold | Self::Extrapolate => 0.0,
            Self::Linear | Self::Hermite => period,
        }
    }
}

/// The last two setpoints.
#[derive(Clone, Copy, Debug)]
pub struct Interpolator {
    between: Between,
    /// Period that the drive was told, s.
    period: f64,
    before: Target,
    latest: Target,
    /// Time at which the latest came, s.
    at: f64,
}

impl Interpolator {
    /// Holds still at `position` turns until a setpoint comes.
    pub fn resting(between: Between, period: f64, position: f64) -> Self {
        let rest = Target { position, ..Target::default() };
        Self { between, period, before: rest, latest: rest, at: 0.0 }
    }

    /// Holds still at `position` turns again.
    pub fn rest_at(&mut self, position: f64) {
        *self = Self::resting(self.between, self.period, position);
    }

    /// Returns the time by which the way lags behind the setpoints, s.
    pub fn lag(&self) -> f64 {
        self.between.lag(self.period)
    }

    /// Takes a setpoint at time `t`, s.
    pub fn push(&mut self, t: f64, target: Target) {
        (self.before, self.latest, self.at) = (self.latest, target, t);
    }

    /// Returns what the loops are to follow at time `t`, s.
    pub fn target(&self, t: f64) -> Target {
        let Self { before, latest, period, .. } = *self;
        let since = t - self.at;
        let s = (since / period).clamp(0.0, 1.0);
        let mix = |x: f64, y: f64| x + (y - x) * s;
        match self.between {
            Between::Hold => latest,
            Between::Extrapolate => {
                Target { position: latest.position + latest.velocity * since, ..latest }
            }
            Between::Linear => Target {
                position: mix(before.position, latest.position),
                velocity: mix(before.velocity, latest.velocity),
                torque: mix(before.torque, latest.torque),
            },
            Between::Hermite => {
                let rise = latest.position - before.position;
                let [v0, v1] = [before.velocity * period, latest.velocity * period];
                let (c2, c3) = (3.0 * rise - 2.0 * v0 - v1, v0 + v1 - 2.0 * rise);
                Target {
                    position: before.position + s * (v0 + s * (c2 + s * c3)),
                    velocity: (v0 + s * (2.0 * c2 + 3.0 * s * c3)) / period,
                    torque: mix(before.torque, latest.torque),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x = t³ in setpoints 0.1 s apart: the cubic is exact a period late, the others have their
    /// order.
    #[test]
    fn each_way_has_its_order() {
        let exact = |t: f64| Target { position: t.powi(3), velocity: 3.0 * t * t, torque: t };
        let h = 0.1;
        for (between, most) in [
            (Between::Hold, 0.31),
            (Between::Extrapolate, 0.031),
            (Between::Linear, 0.0075),
            (Between::Hermite, 1e-14),
        ] {
            let mut follow = Interpolator::resting(between, h, 0.0);
            let mut worst = 0.0_f64;
            for k in 0..100 {
                let t = 0.01 * f64::from(k);
                if k % 10 == 0 {
                    follow.push(t, exact(t));
                }
                if k >= 10 {
                    let wanted = exact(t - between.lag(h));
                    worst = worst.max((follow.target(t).position - wanted.position).abs());
                }
            }
            assert!(worst <= most && worst >= 0.2 * most - 1e-14, "{between:?}: {worst}");
        }
    }
}
