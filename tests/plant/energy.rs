//! Work, losses and stored energy of the whole machine balance.

use stillbeam::motor::Ratio;
use stillbeam_sim::plant::{Cogging, Effort, Friction, Gear, Motor, Options, Parts, Plant};
use stillbeam_sim::scenes;

/// Everything that a machine can have, on a gear of 9:1.
fn whole(compliant: bool) -> Parts {
    Parts {
        gear: Gear {
            ratio: Ratio { motor: 9, link: 1 },
            efficiency: 0.85,
            stiffness: compliant.then_some(150.0),
            damping: if compliant { 0.02 } else { 0.0 },
            backlash: if compliant { 2e-3 } else { 0.0 },
            output_inertia: 1e-4,
        },
        friction: Friction {
            coulomb: 0.03,
            breakaway: 0.05,
            stribeck_rate: 0.05,
            viscous: 0.01,
            presliding: 1e-3,
        },
        motor: Motor {
            rotor_inertia: 2e-5,
            cogging: Cogging { amplitude: 0.004, periods: 42 },
            ..Motor::default()
        },
    }
}

/// Swings the arm to and fro by its motor. Returns work, losses and the error of the balance, J.
fn swing(name: &str, parts: &Parts) -> [f64; 3] {
    let scene = scenes::open(name).expect("an embedded scene");
    let mut plant =
        Plant::at_rest(&scene.arm, parts, scene.from, &Options { order: 5, tolerance: 1e-9 })
            .expect("a plant");
    let size = 0.4 / parts.ratio();
    let torque = |t: f64| size * (9.0 * t).sin() + 0.2 * size;
    // The torque is smooth and the teeth meet and part under way.
    for k in 1..=25 {
        plant.advance(0.02 * f64::from(k), &Effort::Over(&torque)).expect("a step");
    }
    [plant.work(), plant.lost(), plant.energy_error()]
}

#[test]
fn energy_balances() {
    for (name, parts) in [
        ("d-tip30", Parts::default()),
        ("d-tip30", whole(false)),
        ("d-tip30", whole(true)),
        ("b-tip30-damped-hub", whole(false)),
        ("s-gravity", whole(true)),
    ] {
        let [work, lost, error] = swing(name, &parts);
        println!("{name}: work {work} J, lost {lost} J, error {error:e} J");
        assert!(work.abs() > 1e-3 && lost >= 0.0, "{name}: work {work} J, lost {lost} J");
        assert!(error.abs() < 1e-6 * work.abs(), "{name}: {error:e} J of {work} J");
    }
}
