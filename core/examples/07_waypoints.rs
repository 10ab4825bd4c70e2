//! A path through waypoints, of any length, through a queue of eight.
//!
//! Rows are taken as the queue has room. A spline passes them without a stop: its acceleration goes
//! on evenly at every row, so it starts little vibration. Behind the last row taken there is always
//! a stop, so that a source of rows that falls silent leaves the hub at rest.
//!
//! `cargo run -p stillbeam --example 07_waypoints`

use stillbeam::model::EightElements;
use stillbeam::motion::{RowError, Spline, Waypoint};
use stillbeam::stepper::Modal2;
use stillbeam::{Error, Generator, Limits, Link, Move, Profile, Scene};

/// Control period, s.
const TICK: f64 = 0.010;

/// Angles that are passed, rad, and the time from one to the next, s.
const ANGLES: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.8];
const SPAN: f64 = 0.3;

type Arm = Generator<Modal2<f32>, 8>;

fn arm() -> Result<Arm, Error> {
    let scene = Scene::new(Link { length: 0.5, mass: 0.054, bending_stiffness: 0.93 });
    let mut arm =
        Generator::new(Modal2::<f32>::new(&EightElements::consistent(&scene)?, TICK)?, 0.0)?;
    arm.limit(Limits { rate: Some(3.0), acceleration: Some(40.0), ..Limits::default() })?;
    Ok(arm)
}

/// Greatest torque until the hub rests, N m, and of the deflection in the second after, m.
fn fly(arm: &mut Arm, mut before_tick: impl FnMut(&mut Arm)) -> [f32; 2] {
    let (mut torque, mut residual) = (0.0f32, 0.0f32);
    loop {
        before_tick(arm);
        torque = torque.max(arm.tick().torque.abs());
        if arm.is_holding() {
            break;
        }
    }
    for _ in 0..100 {
        residual = residual.max(arm.tick().deflection().abs());
    }
    [torque, residual]
}

/// Runs the example.
pub fn main() -> Result<(), RowError> {
    let core = |error| RowError { row: 0, error };

    // A stop at every angle, for comparison.
    let mut stops = arm().map_err(core)?;
    for to in ANGLES {
        let motion = Move::To { profile: Profile::Quintic, duration: SPAN, to };
        stops.push(&motion).map_err(core)?;
    }
    let stopped = fly(&mut stops, |_| ());

    // The same angles at the same times as a path. Its rates are the spline's.
    let rows = ANGLES.into_iter().zip(1u8..);
    let rows = rows.map(|(angle, i)| Waypoint::at(SPAN * f64::from(i), angle));
    let mut passes = arm().map_err(core)?;
    let mut path = passes.path(Spline::Quintic).map_err(core)?;
    // All rows are looked through first: the limits hold between them too.
    let peaks = *path.survey(rows.clone())?.peaks();
    println!("path: {:.2} rad/s and {:.1} rad/s^2 at most", peaks.rate, peaks.acceleration);
    let mut left = rows;
    let passed = fly(&mut passes, |arm| {
        arm.feed(&mut path, &mut left).expect("looked through");
    });
    assert!(path.is_done() && (passes.setpoint().angle.radians() - 0.8).abs() < 1e-6);

    println!("             torque, N m   residual, mm");
    for (name, [torque, residual]) in [("stops", stopped), ("passes", passed)] {
        println!("{name:>10}   {torque:11.4}   {:12.2}", 1e3 * residual);
    }
    assert!(passed[0] < 0.5 * stopped[0], "a stop at every angle costs torque");

    // A row that cannot be reached is named, with what is wrong.
    let far = [Waypoint::at(0.1, 2.0)];
    let refusal = passes.path(Spline::Cubic).map_err(core)?.survey(far).expect_err("too fast");
    println!("\nrefused: {refusal}");
    Ok(())
}
