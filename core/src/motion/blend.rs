//! Moves that pass into each other without a stop.

use super::{Limits, Move, Plan};
use crate::Error;
use crate::hub::{Angle, HubState};

impl Move {
    /// Returns the move from `start` as one that does not stop before `next`, where the limits
    /// allow it: a [`Move::Pass`] whose end rate is the rate at which both moves pass the corner.
    ///
    /// With turns Δ₁, Δ₂ of one sign in times T₁, T₂ that is the weighted harmonic mean of Fritsch
    /// and Butland, `3(T₁ + T₂) / ((T₁ + 2T₂) T₁/Δ₁ + (2T₁ + T₂) T₂/Δ₂)`, which makes a cubic
    /// overshoot neither end; with turns of opposite signs it is 0. It is also 0 if a limit refuses
    /// the move with that rate, or `next` from that rate to rest. A move without an angle stays as
    /// it is, and nothing is passed before one.
    ///
    /// # Errors
    /// Those of [`Plan::new`] for the move that comes to rest, and for `next` behind it.
    pub fn blended(
        &self,
        next: Option<&Self>,
        start: HubState<f64>,
        limits: &Limits,
        tick: f64,
    ) -> Result<Self, Error> {
        let Some(stops) = self.at_rate(0.0) else { return Ok(*self) };
        let end = Plan::new(&stops, start, limits, tick)?.summary.end;
        let Some((next, to)) = next.and_then(|next| Some((next.at_rate(0.0)?, next.to()?))) else {
            return Ok(stops);
        };
        let _ = Plan::new(&next, end, limits, tick)?;
        let turn = end.angle.since(start.angle);
        let next_turn = Angle::from_radians(to).since(end.angle);
        let rate = passing_rate([turn, next_turn], [self.duration(), next.duration()]);
        let passes = self.at_rate(rate).filter(|pass| {
            let plan = Plan::new(pass, start, limits, tick);
            plan.is_ok_and(|plan| Plan::new(&next, plan.summary.end, limits, tick).is_ok())
        });
        Ok(passes.unwrap_or(stops))
    }

    /// The move to an angle that ends at `rate` rad/s; none if it goes to no angle, or is still.
    fn at_rate(&self, rate: f64) -> Option<Self> {
        match *self {
            Self::To { profile, duration, to } | Self::Pass { profile, duration, to, .. } => {
                Some(Self::Pass { profile, duration, to, rate })
            }
            Self::SpinUp { .. }
            | Self::Still { .. }
            | Self::Dwell { .. }
            | Self::Reach { .. }
            | Self::Ramp { .. } => None,
        }
    }

    fn to(&self) -> Option<f64> {
        match *self {
            Self::To { to, .. } | Self::Pass { to, .. } | Self::Reach { to, .. } => Some(to),
            Self::SpinUp { .. } | Self::Still { .. } | Self::Dwell { .. } | Self::Ramp { .. } => {
                None
            }
        }
    }
}

/// Rate at a corner between turns (in turns) in times of `t` s, rad/s.
fn passing_rate([a, b]: [f64; 2], [t, u]: [f64; 2]) -> f64 {
    if a * b <= 0.0 {
        return 0.0;
    }
    core::f64::consts::TAU * 3.0 * (t + u) / ((t + 2.0 * u) * t / a + (2.0 * t + u) * u / b)
}
