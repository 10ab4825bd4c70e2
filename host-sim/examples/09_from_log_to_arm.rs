//! From a log to an arm to a still move: what a wrong stiffness costs, and what a log mends.
//!
//! The handbook's arm is 5 % too stiff, and a sensor sits on the real one while it is measured. A
//! still move planned with the handbook's arm rings in the real one; planned with the identified
//! arm it does not.
//!
//! `cargo run --release -p stillbeam-sim --example 09_from_log_to_arm`

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::scene::PointMass;
use stillbeam::{Limits, Link, Move, Profile, Scene};
use stillbeam_sim::error::Error;
use stillbeam_sim::identify::arm::Sensor;
use stillbeam_sim::identify::log::{Kind, Log};
use stillbeam_sim::identify::{Identified, Request};
use stillbeam_sim::plan::{self, judge::Motion};
use stillbeam_sim::reference::rod::{self, Options};
use stillbeam_sim::trajectory::Trajectory;

/// Control period, s.
const TICK: f64 = 0.010;

/// Deflection sensor on the arm: 2 g, 30 mm from the tip.
const SENSOR: Sensor = Sensor { at: 0.37, mass: 0.002 };

/// Noise of the sensor, m: a tenth of a millimetre.
const NOISE: f64 = 1e-4;

/// Returns a log of the real arm: what its sensor shows for 8 s after a small move.
fn measure(arm: &Scene) -> Result<Log, Error> {
    let arm = arm.with_mass(PointMass { position: SENSOR.at, mass: SENSOR.mass })?;
    let shake = Move::To { profile: Profile::Cubic, duration: 0.15, to: 0.05 };
    let moves = [shake, Move::Dwell { duration: 8.2 }];
    let trajectory = Trajectory::plan(0.0, &moves, &Limits::default(), TICK)?;
    let times: Vec<f64> = (0..1600).map(|k| 0.15 + 0.005 * f64::from(k)).collect();
    let options = Options { order: 6, tolerance: 1e-8, integrator: None };
    let samples = rod::solve(&arm, &trajectory, &times, &options)?;
    let mut random = StdRng::seed_from_u64(9);
    let spread = NOISE * 3_f64.sqrt();
    let noisy = samples.iter().map(|s| s.deflection + random.random_range(-spread..spread));
    Ok(Log {
        name: "tap.csv".to_owned(),
        time: times.iter().map(|t| t - times[0]).collect(),
        hub: None,
        sensor: noisy.collect(),
        column: "tip_deflection_m".to_owned(),
        kind: Kind::Deflection,
        unit: "m".to_owned(),
        same_time: 0,
        empty: 0,
    })
}

/// Plans a still quarter turn with `known`, and returns what is left of it in `real`, of L.
fn residual(known: &Scene, real: &Scene, duration: f64) -> Result<f64, Error> {
    let to = std::f64::consts::FRAC_PI_2;
    let request = plan::Request {
        arm: *known,
        from: 0.0,
        to,
        duration: Some(duration),
        limits: Limits::default(),
        robust: None,
        options: plan::Options::default(),
        tick: TICK,
    };
    let plan = request.plan()?.plan;
    Ok(Motion::of(0.0, plan.motion(), TICK).judge(real, 0.0)?.residual)
}

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut handbook = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    handbook.payload.mass = 0.030;
    let mut real = handbook;
    real.link.bending_stiffness /= 1.05;
    real.damping.beta = 2e-4;

    let request = Request {
        sensor: Some(SENSOR),
        scene: Some(("handbook".to_owned(), handbook)),
        ..Request::default()
    };
    let Identified { report, arm, .. } = request.identify(vec![measure(&real)?])?;
    let identified = arm.ok_or_else(|| Error::new("no arm"))?;
    let mode = &report.modes[0];
    println!(
        "first mode {:.4} Hz ({:.4} to {:.4}), damping {:.2} %, fit {:.1} %",
        mode.frequency_hz,
        mode.frequency_interval_hz[0],
        mode.frequency_interval_hz[1],
        100.0 * mode.damping_ratio,
        report.fit_percent
    );
    let stiffness = |arm: &Scene| arm.link.bending_stiffness;
    println!(
        "EI: handbook {:.4}, identified {:.4}, real {:.4} N m²",
        stiffness(&handbook),
        stiffness(&identified),
        stiffness(&real)
    );
    assert!((stiffness(&identified) / stiffness(&real) - 1.0).abs() < 0.002);

    let duration = 0.38;
    let wrong = residual(&handbook, &real, duration)?;
    let right = residual(&identified, &real, duration)?;
    println!(
        "left after a still quarter turn in {duration} s: {:.2} % of L with the handbook's arm, \
         {:.3} % with the identified one",
        100.0 * wrong,
        100.0 * right
    );
    assert!(wrong > 0.01 && right < 0.1 * wrong, "{wrong} {right}");
    Ok(())
}
