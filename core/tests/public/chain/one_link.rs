//! A chain of one link against the solutions for a single arm.

use std::path::Path;

use stillbeam::chain::{Chain, ChainGenerator};
use stillbeam::mechanism::{Link, Mechanism};
use stillbeam::{Move, Profile};

struct Arm {
    name: &'static str,
    link: Link,
    payload: [f64; 2],
    radius: f64,
    damping: [f64; 2],
    gravity: f64,
    from: f64,
    motion: Move,
    ticks: usize,
}

fn arms() -> [Arm; 6] {
    let half_turn = |profile, duration| Move::To { profile, duration, to: std::f64::consts::PI };
    let a = Link::flexible(0.4, 0.00952, 0.0213344);
    let b = Link::flexible(0.4, 0.01904, 0.042656);
    let d = Link::flexible(0.4, 0.0224, 0.46);
    let plain = Arm {
        name: "d-fast",
        link: d,
        payload: [0.0; 2],
        radius: 0.0,
        damping: [0.0; 2],
        gravity: 0.0,
        from: 0.0,
        motion: half_turn(Profile::Cubic, 0.2),
        ticks: 40,
    };
    let slow = half_turn(Profile::Cubic, 2.0);
    let tip30 =
        |name, link| Arm { name, link, payload: [0.03, 0.0], motion: slow, ticks: 400, ..plain };
    [
        Arm { ..plain },
        tip30("a-tip30", a),
        tip30("b-tip30", b),
        Arm { radius: 0.04, damping: [0.15, 0.002], ..tip30("b-tip30-damped-hub", b) },
        Arm {
            name: "s-gravity",
            link: Link::flexible(1.0, 0.4, 15.0),
            payload: [0.2, 0.001],
            radius: 0.1,
            damping: [0.0, 1e-4],
            gravity: 9.81,
            from: -0.4,
            motion: Move::To { profile: Profile::Quintic, duration: 0.8, to: 0.4 },
            ticks: 160,
        },
        Arm {
            name: "spin-up",
            link: Link::flexible(10.0, 12.0, 14000.0),
            motion: Move::SpinUp { duration: 15.0, rate: 6.0 },
            ticks: 3000,
            ..plain
        },
    ]
}

/// Largest error of the tip over L, and of the torque over its peak. A tick on each side of a jump
/// of the acceleration is left out.
fn errors<const W: usize, const Q: usize>(arm: &Arm) -> (f64, f64) {
    let mut mechanism = Mechanism::new(&[arm.link]).expect("a link");
    mechanism.joints[0].radius = arm.radius;
    [mechanism.payload.mass, mechanism.payload.inertia] = arm.payload;
    [mechanism.damping.alpha, mechanism.damping.beta] = arm.damping;
    mechanism.gravity = arm.gravity;
    let chain = Chain::<f32, 1, W, W, Q>::new(&mechanism, 0.01).expect("a chain");
    let mut generator =
        ChainGenerator::<f32, 1, W, W, Q, 4>::new(chain, [arm.from]).expect("a generator");
    let ticks = generator.push(0, &arm.motion).expect("a move").ticks as usize;
    let text = std::fs::read_to_string(
        Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../tests/truth/{}.csv", arm.name)),
    )
    .expect("a truth file");
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|field| field.parse().expect("a number")).collect())
        .collect();
    let peak = rows.iter().fold(0.0_f64, |peak, row| peak.max(row[7].abs()));
    let (mut tip, mut torque): (f64, f64) = (0.0, 0.0);
    let mut compared = 0;
    let times: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    for k in 0..=arm.ticks {
        let setpoint = generator.tick();
        let time = 0.01 * k as f64;
        let Some(at) = times.iter().position(|t| (t - time).abs() < 1e-6) else { continue };
        compared += 1;
        let [x, y] = setpoint.tip().map(f64::from);
        tip = tip.max((x - rows[at][4]).hypot(y - rows[at][5]) / arm.link.length);
        if k > 1 && k.abs_diff(ticks) > 1 {
            torque = torque.max((f64::from(setpoint.joints[0].torque) - rows[at][7]).abs() / peak);
        }
    }
    assert!(compared > 30, "{}: {compared} rows compared", arm.name);
    (tip, torque)
}

#[test]
fn one_link_is_the_special_case() {
    // Tip and torque with two coordinates, then with three. As measured: 2.6e-2 9.6 %, 1.6e-2 5.8
    // %, 6.8e-4 0.87 %, 5.1e-5 0.55 %, 3.0e-4 1.43 %, 3.2e-5 0.98 %, 2.4e-4 0.59 %, 7.9e-6 0.03 %,
    // 7.6e-4 0.56 %, 5.2e-5 0.11 %; the last are what is promised.
    let bounds = [
        [(2.8e-2, 0.105), (1.8e-2, 0.065)],
        [(7.5e-4, 0.010), (6e-5, 0.006)],
        [(3.4e-4, 0.016), (3.6e-5, 0.011)],
        [(2.7e-4, 0.0065), (1e-5, 0.0004)],
        [(8.5e-4, 0.0062), (6e-5, 0.0013)],
        [(1.5e-3, 0.025), (1.3e-3, 0.02)],
    ];
    for (arm, bounds) in arms().iter().zip(bounds) {
        let found = [errors::<3, 3>(arm), errors::<4, 5>(arm)];
        println!("{:20} {found:.7?}", arm.name);
        for (found, bound) in found.iter().zip(bounds) {
            assert!(found.0 <= bound.0 && found.1 <= bound.1, "{}: {found:?}", arm.name);
        }
    }
}
