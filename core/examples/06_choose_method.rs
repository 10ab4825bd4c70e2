//! The cheapest method that is good enough for an arm and its moves.
//!
//! The ladder orders methods by what their tick costs on the target. `Auto::choose` tries them on
//! the motion itself, beside an exact rod, and takes the cheapest that keeps both tolerances.
//!
//! `cargo run -p stillbeam --example 06_choose_method`

use stillbeam::select::{Auto, Rung, Tolerance};
use stillbeam::{Error, Generator, Link, Move, Profile, Scene};

/// Control period, s.
const TICK: f64 = 0.010;

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    scene.payload.mass = 0.030;

    println!("the ladder, cheapest tick first:");
    for rung in Rung::ladder(&scene) {
        println!("  {rung}");
    }

    println!("\nduration  tolerance  choice                    tip, % of L  torque, % of its peak");
    let mut chosen = Vec::new();
    // The same turn, slow and fast, and once with ten times less error.
    for (duration, tip) in [(3.0, 1e-2), (0.4, 1e-2), (0.4, 1e-3), (0.3, 1e-3)] {
        let moves = [Move::To { profile: Profile::Quintic, duration, to: 1.57 }];
        let tolerance = Tolerance { tip, torque: 0.05 };
        let (stepper, choice) = Auto::<f32>::choose(&scene, TICK, 0.0, &moves, &tolerance)?;
        println!(
            "{duration:>6.1} s  {:>7.1} %  {:<24}  {:>11.4}  {:>21.3}",
            100.0 * tip,
            choice.rung.to_string(),
            100.0 * choice.expected.tip,
            100.0 * choice.expected.torque,
        );
        assert!(choice.expected.tip <= tolerance.tip && choice.expected.torque <= tolerance.torque);
        chosen.push(choice.rung);

        // The choice is a stepper like any other. Firmware that knows its arm links the named one.
        let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
        let ticks = arm.push(&moves[0])?.ticks;
        let last = (0..=ticks).map(|_| arm.tick()).last().expect("a tick");
        assert!((last.angle.radians() - 1.57).abs() < 1e-5);
    }
    let place = |rung: &Rung| Rung::ladder(&scene).iter().position(|other| other == rung);
    assert!(place(&chosen[0]) < place(&chosen[3]), "a faster move asks for a better method");

    // What no method can do is an error that says how near the best one comes.
    let moves = [Move::To { profile: Profile::Quintic, duration: 1.0, to: 1.57 }];
    let strict = Tolerance { tip: 1e-6, torque: 1e-6 };
    let refusal = Auto::<f32>::choose(&scene, TICK, 0.0, &moves, &strict).expect_err("too strict");
    println!("\nrefused: {refusal}");
    assert!(matches!(refusal, Error::Tolerance { .. }));
    Ok(())
}
