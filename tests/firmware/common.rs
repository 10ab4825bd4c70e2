//! An axis as the firmware has it, with its moves.

use stillbeam::axis::{Axis, Policy, StopLimits, Tick};
use stillbeam::model::OneElement;
use stillbeam::stepper::Newmark;
use stillbeam::{Angle, Error, Limits, Link, Move, Profile, Scene};

pub const TICK: f64 = 0.010;

pub const LIMITS: Limits = Limits {
    rate: Some(6.0),
    acceleration: Some(40.0),
    deceleration: None,
    jerk: None,
    torque: None,
    moment: None,
};

pub const POLICY: Policy =
    Policy { limits: LIMITS, stop: StopLimits::OF_MOVES, patience: 0.2, missed: 2 };

pub type Arm = Axis<Newmark<f32, 2, 2, false>, 8>;

pub fn stepper(payload: f64) -> Newmark<f32, 2, 2, false> {
    stepper_at(TICK, payload)
}

/// The stepper at another tick, s.
pub fn stepper_at(tick: f64, payload: f64) -> Newmark<f32, 2, 2, false> {
    let link = Link { length: 0.4, mass: 0.01904, bending_stiffness: 0.042656 };
    let mut scene = Scene::new(link);
    scene.payload.mass = payload;
    scene.gravity = 1.0;
    Newmark::nodal(&OneElement::consistent(&scene.cast::<f32>()).unwrap(), tick).unwrap()
}

/// The hub's angle, rad.
pub fn radians(tick: &Tick<f32>) -> f64 {
    tick.setpoint.angle.radians()
}

pub fn turns(part: f32) -> Angle<f32> {
    Angle { turns: 0, part }
}

/// Disabled, at 0.2 turns.
pub fn disabled(policy: Policy) -> Arm {
    Axis::new(stepper(0.03), turns(0.2), policy).unwrap()
}

/// Enabled, at 0.2 turns.
pub fn enabled(policy: Policy) -> Arm {
    let mut axis = disabled(policy);
    axis.enable(turns(0.2)).unwrap();
    axis
}

pub fn to(profile: Profile, duration: f64, to: f64) -> Move {
    Move::To { profile, duration, to }
}

/// Plans and hands over, as the firmware's command task does.
pub fn ask(axis: &mut Arm, motion: &Move) -> Result<u32, Error> {
    let planned = axis.plan_context()?.plan(motion)?;
    axis.take(&planned)
}

/// Ticks with a host that is heard.
pub fn run(axis: &mut Arm, ticks: u32) -> Vec<Tick<f32>> {
    (0..ticks)
        .map(|_| {
            axis.heard();
            axis.tick()
        })
        .collect()
}

/// Setpoints follow each other without a step and within the limits: what the rates say the hub
/// turns is what it turns, rates change by no more than the acceleration, and neither exceeds its
/// limit.
#[track_caller]
pub fn assert_continuous(ticks: &[Tick<f32>], limits: &Limits) {
    let tau = std::f64::consts::TAU;
    let (rate, acceleration) = (limits.rate.unwrap(), limits.acceleration.unwrap());
    for pair in ticks.windows(2) {
        let [a, b] = [pair[0].setpoint, pair[1].setpoint];
        let turned = tau * (b.angle.in_turns() - a.angle.in_turns());
        let mean = 0.5 * (f64::from(a.rate) + f64::from(b.rate));
        let k = pair[1].number;
        // The trapezoid is off by at most a h²/8 of the acceleration's change.
        let off = (turned - mean * TICK).abs();
        assert!(off <= 0.25 * acceleration * TICK * TICK + 2e-6, "tick {k}: step of {off} rad");
        let faster = f64::from(b.rate - a.rate).abs();
        assert!(faster <= acceleration * TICK * 1.001 + 1e-5, "tick {k}: rate steps by {faster}");
        assert!(f64::from(b.rate).abs() <= rate * 1.001, "tick {k}: {} rad/s", b.rate);
        let a = f64::from(b.acceleration).abs();
        assert!(a <= acceleration * 1.001, "tick {k}: {a} rad/s²");
        assert!(b.torque.is_finite() && b.deflection().is_finite(), "tick {k}");
    }
}
