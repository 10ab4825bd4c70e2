//! Plans a case and judges what comes out.

use std::f64::consts::TAU;

use stillbeam::motion::optimal::{Bounds, TimeOptimal};

use super::draw::{Case, Kind};
use super::peer::{self, Turning};

/// Verdict on a case.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The case's kind.
    pub kind: Kind,
    /// Duration, s, or the refusal.
    pub duration: Result<f64, String>,
    /// Ruckig's duration, s, or its refusal.
    pub peer: Result<f64, String>,
    /// Greatest part of a limit by which the motion exceeds it, once it is within.
    pub excess: f64,
    /// Angle, rate and acceleration by which the end is missed, in parts of the angle turned and of
    /// the limits.
    pub miss: f64,
}

impl Trial {
    /// Duration less Ruckig's, in parts of Ruckig's; `None` if one of them has refused.
    pub fn longer(&self) -> Option<f64> {
        let (own, peer) = (self.duration.as_ref().ok()?, self.peer.as_ref().ok()?);
        // A motion of no duration is of rounding alone.
        Some((own - peer) / peer.max(1e-6))
    }
}

/// Judges a case.
pub fn trial(case: &Case) -> Trial {
    let (start, end) = (case.start(), case.end());
    let motion = TimeOptimal::reach(&start, &end, &case.bounds);
    let [lowest, highest] = motion.as_ref().map_or([-1.0, 1.0], TimeOptimal::rates);
    let still = 1e-9 * case.bounds.rate;
    let turning = if lowest >= -still {
        Turning::Forward
    } else if highest <= still {
        Turning::Backward
    } else {
        Turning::Both
    };
    let peer = peer::duration(case, turning);
    match motion {
        Ok(motion) => Trial {
            kind: case.kind,
            duration: Ok(motion.duration()),
            peer,
            excess: excess(case, &motion),
            miss: miss(case, &motion),
        },
        Err(error) => {
            let refusal = Err(error.to_string());
            Trial { kind: case.kind, duration: refusal, peer, excess: 0.0, miss: 0.0 }
        }
    }
}

/// Greatest part of a limit by which the motion exceeds it, at 32 times of each piece. A start
/// beyond the limits may exceed them until it is within for the first time.
fn excess(case: &Case, motion: &TimeOptimal) -> f64 {
    let mut within = case.kind != Kind::Outside;
    let mut most = 0.0_f64;
    for piece in motion.pieces() {
        for k in 0..=32 {
            let [_, rate, acceleration] = piece.after(piece.duration * f64::from(k) / 32.0);
            let over = beyond(&case.bounds, rate, acceleration);
            // Beyond what it will do unavoidably while the acceleration comes down.
            let settled = rate + 0.5 * acceleration * acceleration.abs() / case.bounds.jerk;
            within |= over <= 1e-9 && settled.abs() <= case.bounds.rate * (1.0 + 1e-9);
            if within {
                most = most.max(over);
            }
        }
        most = most.max(piece.jerk.abs() / case.bounds.jerk - 1.0);
    }
    if within { most } else { f64::INFINITY }
}

/// Greatest part of a limit by which a state exceeds it; negative inside.
fn beyond(bounds: &Bounds, rate: f64, acceleration: f64) -> f64 {
    // At a rate of rounding the acceleration has either sign.
    let limit = if rate.abs() < 1e-9 * bounds.rate {
        bounds.acceleration.max(bounds.deceleration)
    } else if rate * acceleration < 0.0 {
        bounds.deceleration
    } else {
        bounds.acceleration
    };
    (rate.abs() / bounds.rate - 1.0).max(acceleration.abs() / limit - 1.0)
}

/// How far from its end the last piece ends.
fn miss(case: &Case, motion: &TimeOptimal) -> f64 {
    let Some(piece) = motion.pieces().last() else {
        return case.distance.abs();
    };
    let [turned, rate, acceleration] = piece.after(piece.duration);
    let way: f64 = motion
        .pieces()
        .iter()
        .map(|piece| piece.duration * piece.rate.abs().max(piece.after(piece.duration)[1].abs()))
        .sum();
    let asked = TAU * case.end().angle.since(case.start().angle);
    let angle = (turned - asked).abs() / way.max(asked.abs()).max(1e-9);
    let rate = (rate - case.to[0]).abs() / case.bounds.rate;
    let jumps = case.bounds.jerk.is_infinite();
    let most = if case.bounds.acceleration.is_finite() {
        case.bounds.acceleration
    } else {
        case.bounds.jerk
    };
    let acceleration = if jumps { 0.0 } else { (acceleration - case.to[1]).abs() / most };
    angle.max(rate).max(acceleration)
}
