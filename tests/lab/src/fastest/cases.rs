//! Arms and limits of the comparison.

use std::f64::consts::PI;

use stillbeam::{Limits, Profile, Scene};
use stillbeam_sim::error::Error;
use stillbeam_sim::reference::rod;
use stillbeam_sim::scenes;

/// An arm that turns by π rad within limits.
#[derive(Clone, Debug)]
pub struct Case {
    /// Name of the arm.
    pub arm_name: &'static str,
    /// Name of the limits.
    pub limits_name: String,
    /// The arm.
    pub arm: Scene,
    /// The limits.
    pub limits: Limits,
    /// First period of the arm, s.
    pub period: f64,
    /// h, s: so short that rounding to it hardly counts.
    pub tick: f64,
}

/// Returns the cases of the page.
pub fn all() -> Result<Vec<Case>, Error> {
    let mut all = Vec::new();
    for (arm_name, scene) in [("member A with 30 g", "a-tip30"), ("member D bare", "d-fast")] {
        let arm = scenes::open(scene)?.arm;
        let period = rod::first_period(&arm)?;
        let mut push = |limits_name: String, limits: Limits| {
            let tick = period / 1000.0;
            all.push(Case { arm_name, limits_name, arm, limits, period, tick });
        };
        for ratio in [1.0, 2.0, 3.0] {
            let peaks = Profile::Cubic.peaks(PI, ratio * period);
            let limits = Limits { acceleration: Some(peaks.acceleration), ..Limits::default() };
            push(format!("acceleration of a cubic, {ratio} T\u{2081}"), limits);
        }
        for ratio in [1.0, 1.5, 2.0, 3.0] {
            let peaks = Profile::SCurve.peaks(PI, ratio * period);
            let limits = Limits {
                rate: Some(peaks.rate),
                acceleration: Some(peaks.acceleration),
                jerk: Some(peaks.jerk),
                ..Limits::default()
            };
            push(format!("all of an S-curve, {ratio} T\u{2081}"), limits);
        }
        for ratio in [1.5, 2.0, 3.0] {
            let duration = ratio * period;
            let rigid = Profile::Trapezoid.peaks(PI, duration);
            let limits = Limits {
                rate: Some(rigid.rate),
                acceleration: Some(12.0 * PI / (duration * duration)),
                torque: Some(inertia(&arm) * rigid.acceleration),
                ..Limits::default()
            };
            push(format!("torque of a rigid arm, {ratio} T\u{2081}"), limits);
        }
        for ratio in [5.0, 10.0, 20.0] {
            let rate = Some(1.1 * PI / (ratio * period));
            push(format!("rate, {ratio} T\u{2081}"), Limits { rate, ..Limits::default() });
        }
    }
    Ok(all)
}

/// Moment of inertia of a straight uniform arm about its hub, kg m².
fn inertia(arm: &Scene) -> f64 {
    let (link, payload) = (&arm.link, &arm.payload);
    let (near, far) = (arm.hub.radius, arm.hub.radius + link.length);
    let of_link = link.mass * (far.powi(3) - near.powi(3)) / (3.0 * link.length);
    let lever = far + payload.offset;
    arm.hub.inertia + of_link + payload.mass * lever * lever + payload.inertia
}
