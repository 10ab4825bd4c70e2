//! One move of one arm, and what its tip does on the way.
//!
//! A cubic turns the hub by 90° in 0.6 s. Its acceleration jumps at both ends, and the arm goes on
//! ringing after the hub has stopped.
//!
//! `cargo run -p stillbeam --example 01_one_move`

use rasciigraph::{Config, plot};
use stillbeam::model::Rod;
use stillbeam::stepper::{Elastica2, Quality};
use stillbeam::{Error, Generator, Link, Move, Profile, Scene, Setpoint};

/// Control period, s.
const TICK: f64 = 0.010;

/// Duration of the move, s: a little over two periods of the first mode.
const DURATION: f64 = 0.6;

/// Runs the example.
pub fn main() -> Result<(), Error> {
    // A strip of spring steel, 40 cm long, with 30 g at its tip.
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    scene.payload.mass = 0.030;
    let to = std::f64::consts::FRAC_PI_2;

    // Set-up, once: a stepper is fitted to the range of tip angles that its moves will bend the arm
    // by, here those of the cubic's peak acceleration.
    let rod = Rod::new(&scene)?;
    let peak = Profile::Cubic.peaks(to, DURATION).acceleration;
    let stepper = Elastica2::<f32>::new(&rod, TICK, Quality::Fast, rod.bend(peak))?;
    let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
    arm.push(&Move::To { profile: Profile::Cubic, duration: DURATION, to })?;

    // On a microcontroller this call stands in the timer's interrupt. Here it fills a list.
    let setpoints: Vec<Setpoint<f32>> = (0..150).map(|_| arm.tick()).collect();

    println!("  time  angle    rate  acceleration  torque  deflection");
    println!("     s    rad   rad/s       rad/s^2     N m          mm");
    for (k, setpoint) in setpoints.iter().enumerate().step_by(6).take(12) {
        println!(
            "{:>6.2} {:>6.3} {:>7.3} {:>13.2} {:>7.3} {:>11.2}",
            k as f64 * TICK,
            setpoint.angle.radians(),
            setpoint.rate,
            setpoint.acceleration,
            setpoint.torque,
            1e3 * setpoint.deflection(),
        );
    }
    let deflection: Vec<f64> = setpoints.iter().map(|s| 1e3 * f64::from(s.deflection())).collect();
    let caption = format!("tip deflection, mm, over 1.5 s; the hub stops after {DURATION} s");
    let config = Config::default().with_width(75).with_height(14).with_caption(caption);
    println!("\n{}", plot(deflection.clone(), config));

    // The hub has arrived, and the arm has not: this is what the other examples do away with.
    let last = setpoints[setpoints.len() - 1];
    let ringing = deflection[60..].iter().fold(0.0, |most: f64, y| most.max(y.abs()));
    println!("\nafter the move the tip rings by ±{ringing:.1} mm");
    assert!((last.angle.radians() - to).abs() < 1e-6 && last.rate == 0.0);
    assert!(ringing > 2.0, "{ringing}");
    Ok(())
}
