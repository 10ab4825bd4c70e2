//! Random arms and moves: what must hold for all of them.

use proptest::prelude::*;
use stillbeam::beam::Model;
use stillbeam::stepper::Newmark;
use stillbeam::{Damping, Generator, Hub, Link, Move, Payload, Profile, Scalar, Scene, Setpoint};

/// Arms with a first period of a few ticks to a few seconds, payloads to four link masses.
fn arms() -> impl Strategy<Value = Scene> {
    (
        (0.1..2.0, 0.005..2.0, 0.03..1.5),
        (0.0..0.3, 0.0..4.0, 0.0..0.02),
        (0.0..1.0, 0.0..0.01, prop::bool::ANY),
    )
        .prop_map(
            |((length, mass, period), (radius, payload, inertia), (alpha, beta, upright))| {
                // EI from the wanted first period of link and payload, within a few per cent.
                let moved = mass * (0.2427 + payload);
                let omega: f64 = std::f64::consts::TAU / period;
                let stiffness = omega * omega * moved * length * length * length / 3.0;
                let sag = moved * 9.81 * length * length / (3.0 * stiffness);
                Scene {
                    link: Link { length, mass, bending_stiffness: stiffness },
                    hub: Hub { radius: radius * length, inertia: 0.0 },
                    payload: Payload {
                        mass: payload * mass,
                        inertia: inertia * mass * length * length,
                    },
                    damping: Damping { alpha, beta: beta * period },
                    // Weight only where the arm carries it without bending far.
                    gravity: if upright && sag < 0.1 { 9.81 } else { 0.0 },
                }
            },
        )
}

fn moves() -> impl Strategy<Value = (f64, Move)> {
    (-4.0..4.0, -4.0..4.0, 0.2..3.0, 0..Profile::ALL.len()).prop_map(
        |(from, to, duration, profile)| {
            (from, Move::To { profile: Profile::ALL[profile], duration, to })
        },
    )
}

fn drive<T: Scalar, const N: usize, const W: usize>(
    scene: &Scene,
    from: f64,
    motion: &Move,
) -> Vec<Setpoint<T>> {
    let model = Model::<N, W>::consistent(scene).expect("model");
    let stepper = Newmark::<T, N, W>::new(&model, 0.01).expect("stepper");
    let mut arm = Generator::<_, 8>::new(stepper, from).expect("generator");
    let ticks = arm.push(motion).expect("move").ticks;
    (0..ticks + 100).map(|_| arm.tick()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn setpoints_are_finite_and_end_at_the_target(scene in arms(), (from, motion) in moves()) {
        let run = drive::<f32, 8, 4>(&scene, from, &motion);
        for s in &run {
            let all = [s.angle.part, s.rate, s.acceleration, s.torque, s.tip[0], s.tip[1]];
            prop_assert!(all.iter().all(|x| x.is_finite()), "{s:?}");
            prop_assert!(s.angle.part.abs() <= 0.5);
        }
        let Move::To { to, .. } = motion else { unreachable!("only these are drawn") };
        let last = run.last().expect("ticks");
        prop_assert!((last.angle.radians() - to).abs() < 1e-6);
        prop_assert_eq!((last.rate, last.acceleration), (0.0, 0.0));
    }

    #[test]
    fn single_and_double_precision_agree(scene in arms(), (from, motion) in moves()) {
        let single = drive::<f32, 2, 2>(&scene, from, &motion);
        let double = drive::<f64, 2, 2>(&scene, from, &motion);
        let reach = scene.reach();
        let peak = double.iter().map(|s| s.deflection().abs()).fold(1e-3 * reach, f64::max);
        for (a, b) in single.iter().zip(&double) {
            prop_assert!((f64::from(a.deflection()) - b.deflection()).abs() < 2e-3 * peak, "{a:?} {b:?}");
        }
    }

    /// Turning the other way is the mirror image, in the horizontal plane.
    #[test]
    fn mirrored_moves_give_mirrored_setpoints(scene in arms(), (_, motion) in moves()) {
        let scene = Scene { gravity: 0.0, ..scene };
        let Move::To { profile, duration, to } = motion else { unreachable!("only these are drawn") };
        let there = drive::<f32, 4, 4>(&scene, 0.0, &motion);
        let mirrored = Move::To { profile, duration, to: -to };
        for (a, b) in there.iter().zip(drive::<f32, 4, 4>(&scene, 0.0, &mirrored)) {
            prop_assert_eq!((a.deflection(), a.torque, a.rate), (-b.deflection(), -b.torque, -b.rate));
        }
    }
}
