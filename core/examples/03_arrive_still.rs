//! A move after which the arm is at rest, beside a quintic in the same time.
//!
//! The planner bends the hub's path so that the arm's first two modes end without vibration. It
//! knows the exact kinematics: this arm bends by a fifth of its length on the way.
//!
//! `cargo run -p stillbeam --example 03_arrive_still`

use rasciigraph::{Config, plot_many};
use stillbeam::model::Rod;
use stillbeam::planner::{Planner, Request};
use stillbeam::stepper::{Elastica2, Quality};
use stillbeam::{Error, Generator, Link, Move, Profile, Scene};

/// Control period, s.
const TICK: f64 = 0.010;

/// Returns the tip's deflections, mm, over a motion from rest at 0 and half a second after it.
fn deflections(scene: &Scene, motion: &Move, acceleration: f64) -> Result<Vec<f64>, Error> {
    let rod = Rod::new(scene)?;
    let bend = rod.bend(acceleration);
    let stepper = Elastica2::<f32>::new(&rod, TICK, Quality::Fine, bend)?;
    let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
    let ticks = arm.push(motion)?.ticks + 50;
    Ok((0..=ticks).map(|_| 1e3 * f64::from(arm.tick().deflection())).collect())
}

/// Returns the greatest magnitude of the deflections after the first `from` ticks.
fn ringing(deflections: &[f64], from: u32) -> f64 {
    deflections[from as usize..].iter().fold(0.0, |most, y| most.max(y.abs()))
}

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    scene.payload.mass = 0.030;
    let to = std::f64::consts::FRAC_PI_2;

    // Set-up takes its time. A plan then takes milliseconds on a microcontroller, beside the tick.
    let planner = Planner::<f32, 2>::new(&scene, TICK)?;
    let duration = 1.4 * planner.first_period();
    let plan = planner.plan(&Request::from_rest(0.0, to).duration(duration))?;
    println!(
        "{} ticks, found in {} simulations; the planner expects {:.4} % of the length to be left",
        plan.ticks,
        plan.simulations,
        100.0 * plan.residual
    );

    let quintic = Move::To { profile: Profile::Quintic, duration: plan.duration(), to };
    // Both runs are set up for the larger of the two peaks.
    let peak = Profile::Quintic.peaks(to, plan.duration()).acceleration;
    let peak = peak.max(plan.peaks.acceleration);
    let rough = deflections(&scene, &quintic, peak)?;
    let still = deflections(&scene, &plan.motion(), peak)?;
    let caption = "tip deflection, mm: a quintic, and the still move".to_owned();
    let config = Config::default().with_width(75).with_height(16).with_caption(caption);
    println!("{}", plot_many(vec![rough.clone(), still.clone()], config));

    let bent = ringing(&still, 0);
    println!("\nthe still move bends the arm by {bent:.0} mm on its way");
    let (rough, still) = (ringing(&rough, plan.ticks), ringing(&still, plan.ticks));
    println!("left after the move: quintic ±{rough:.2} mm, still ±{still:.3} mm");
    // 0.1 % of the length.
    assert!(still < 0.4 && rough > 20.0 * still, "{still} {rough}");
    Ok(())
}
