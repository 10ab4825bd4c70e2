//! Moves behind an input shaper.
//!
//! A shaper adds up delayed copies of a motion so that a vibration of one frequency cancels. It
//! needs the frequency and no plan, takes part of a period longer, and assumes that the arm bends
//! little.
//!
//! `cargo run -p stillbeam --example 04_input_shaper`

use rasciigraph::{Config, plot_many};
use stillbeam::model::{EightElements, Modes};
use stillbeam::motion::{Limits, Plan, Shaped, Shaper, ShaperKind};
use stillbeam::stepper::{AnyMotion, Modal2, Stepper};
use stillbeam::{Error, HubState, Link, Move, Profile, Scene};

/// Control period, s.
const TICK: f64 = 0.010;

/// Ticks that are looked at after the motion.
const AFTER: u32 = 100;

/// Runs the example.
pub fn main() -> Result<(), Error> {
    // A steel ruler, 60 cm long, that is turned by 6°.
    let scene = Scene::new(Link { length: 0.6, mass: 0.14, bending_stiffness: 0.42 });
    let model = EightElements::consistent(&scene)?;
    let stepper = Modal2::<f32>::new(&model, TICK)?;
    let frequency = 1.0 / Modes::of(&model).first_period();

    let motion = Move::To { profile: Profile::Quintic, duration: 0.35, to: 0.1 };
    let plan = Plan::new(&motion, HubState::resting_at(0.0)?, &Limits::default(), TICK)?;
    let segments: Vec<_> = plan.segments.iter().map(|segment| segment.cast::<f32>()).collect();

    println!("first mode at {frequency:.3} Hz; a move of {} ticks\n", plan.summary.ticks);
    println!("shaper     ticks   left after it, mm");
    // One pulse is no shaper at all: the motion itself, for comparison.
    let none = Shaper::custom(&[stillbeam::motion::Pulse { amplitude: 1.0, delay: 0.0 }])?;
    let mut shapers = vec![("none", none)];
    for kind in ShaperKind::ALL {
        shapers.push((kind.name(), Shaper::new(kind, frequency, 0.0)?));
    }
    let mut curves = Vec::new();
    for (name, shaper) in &shapers {
        let shaped = Shaped::new(&segments, shaper, TICK);
        let mut state = stepper.equilibrium(&shaped.hub(0));
        let mut deflections = Vec::new();
        for k in 0..shaped.ticks() + AFTER {
            // Takes the stepper through a tick with the jumps that fall into it.
            shaped.advance(&stepper, &mut state, k);
            let response = stepper.response::<AnyMotion>(&state, &shaped.hub(k + 1));
            deflections.push(1e3 * f64::from(response.tip[1]));
        }
        let after = &deflections[shaped.ticks() as usize..];
        let left = after.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
        println!("{name:<10} {:>5}   {left:>17.3}", shaped.ticks());
        curves.push((left, deflections));
    }
    let (unshaped, zv) = (&curves[0], &curves[1]);
    let ticks = unshaped.1.len().min(zv.1.len());
    let config = Config::default()
        .with_width(75)
        .with_height(14)
        .with_caption("tip deflection, mm: unshaped, and behind ZV".to_owned());
    let series = vec![unshaped.1[..ticks].to_vec(), zv.1[..ticks].to_vec()];
    println!("\n{}", plot_many(series, config));
    assert!(zv.0 < 0.05 * unshaped.0, "{} {}", zv.0, unshaped.0);
    Ok(())
}
