//! The mechanisms whose solutions stand in `tests/truth/mechanisms`, and their runs.

use std::path::Path;

use stillbeam::chain::{Chain, ChainGenerator, ChainSetpoint};
use stillbeam::mechanism::{Closing, Closure, Joint, Link, Mechanism};
use stillbeam::{Move, Profile, Scalar};

/// A move of one joint: its number from 0, when it begins (s), how long it takes (s), its end
/// (rad).
#[derive(Clone, Copy)]
pub struct Turn {
    pub joint: usize,
    pub start: f64,
    pub duration: f64,
    pub to: f64,
    pub profile: Profile,
}

/// A mechanism with its moves.
pub struct Scene {
    pub name: &'static str,
    pub mechanism: Mechanism,
    pub from: [f64; 3],
    pub turns: Vec<Turn>,
    pub duration: f64,
}

fn turn(joint: usize, start: f64, duration: f64, to: f64) -> Turn {
    Turn { joint, start, duration, to, profile: Profile::Quintic }
}

const D: Link = Link::flexible(0.3, 0.0168, 0.46);

pub fn arm_dd() -> Scene {
    let mut mechanism = Mechanism::new(&[D, D]).expect("links");
    mechanism.joints[1].mass = 0.05;
    mechanism.payload.mass = 0.02;
    let turns = vec![turn(0, 0.0, 0.6, 1.0), turn(1, 0.0, 0.6, 1.3)];
    Scene { name: "arm-dd", mechanism, from: [0.0, 0.3, 0.0], turns, duration: 1.2 }
}

pub fn arm_bc_sag() -> Scene {
    let b = Link { tip_offset: 0.015, ..Link::flexible(0.3, 0.01428, 0.042656) };
    let c = Link::flexible(0.3, 0.0084, 0.0575);
    let mut mechanism = Mechanism::new(&[b, c]).expect("links");
    mechanism.joints[0].radius = 0.02;
    mechanism.joints[1] =
        Joint { radius: 0.015, mass: 0.02, stator_inertia: 4e-6, inertia: 2e-6, ..Joint::DRIVEN };
    mechanism.payload.mass = 0.01;
    mechanism.payload.inertia = 2e-6;
    (mechanism.damping.alpha, mechanism.damping.beta) = (0.15, 0.002);
    mechanism.gravity = 9.81;
    let cubic = |turn| Turn { profile: Profile::Cubic, ..turn };
    let turns = vec![cubic(turn(0, 0.0, 1.2, -0.9)), cubic(turn(1, 0.5, 1.0, -0.5))];
    Scene { name: "arm-bc-sag", mechanism, from: [-1.8, 0.5, 0.0], turns, duration: 2.5 }
}

pub fn rigid_forearm() -> Scene {
    let mut mechanism = Mechanism::new(&[Link::rigid(0.3, 0.08), D]).expect("links");
    mechanism.joints[1] = Joint { radius: 0.02, mass: 0.05, inertia: 1e-5, ..Joint::DRIVEN };
    mechanism.payload.mass = 0.02;
    let turns = vec![turn(0, 0.0, 0.25, 1.2), turn(1, 0.0, 0.3, -1.5)];
    Scene { name: "rigid-forearm", mechanism, from: [0.0; 3], turns, duration: 0.8 }
}

pub fn four_bar() -> Scene {
    let crank = Link::flexible(0.12, 0.00672, 0.46);
    let coupler = Link::flexible(0.35, 0.00833, 0.0213344);
    let rocker = Link::flexible(0.3, 0.00714, 0.0213344);
    let mut mechanism = Mechanism::new(&[crank, coupler, rocker]).expect("links");
    mechanism.joints[1] = Joint { mass: 0.01, ..Joint::passive(0.8) };
    mechanism.joints[2] = Joint { mass: 0.03, ..Joint::passive(-1.5) };
    mechanism.damping.beta = 0.0005;
    mechanism.closure = Some(Closure::on_pin([0.4, 0.0]));
    let turns = vec![turn(0, 0.0, 0.8, 6.783185307179586)];
    Scene { name: "four-bar", mechanism, from: [0.5, 0.0, 0.0], turns, duration: 1.3 }
}

pub fn latch() -> Scene {
    let upper = Link::flexible(0.2, 0.0112, 0.46);
    let mut mechanism = Mechanism::new(&[upper, D, D]).expect("links");
    mechanism.joints[1].mass = 0.03;
    mechanism.joints[2].mass = 0.02;
    mechanism.payload.mass = 0.005;
    (mechanism.damping.alpha, mechanism.damping.beta) = (0.1, 0.004);
    let mut closure = Closure::at(1.8);
    closure.release = [1, 2].into_iter().collect();
    mechanism.closure = Some(closure);
    let turns = vec![
        turn(0, 0.0, 0.9, 1.4),
        turn(1, 0.0, 0.9, -1.0),
        turn(2, 0.0, 0.9, -1.2),
        turn(0, 1.8, 0.8, 2.0),
    ];
    Scene { name: "latch", mechanism, from: [0.2; 3], turns, duration: 3.0 }
}

impl Scene {
    /// Times at which accelerations or rates jump, s.
    pub fn jumps(&self) -> Vec<f64> {
        let cubic = self.turns.iter().filter(|turn| turn.profile == Profile::Cubic);
        let mut jumps: Vec<f64> =
            cubic.flat_map(|turn| [turn.start, turn.start + turn.duration]).collect();
        if let Some(Closing::At(time)) = self.mechanism.closure.as_ref().map(|own| own.begins) {
            jumps.push(time);
        }
        jumps
    }
}

/// Largest torque of every joint, N m.
pub fn peaks(rows: &[Row]) -> Vec<f64> {
    let mut peaks = vec![0.0_f64; rows[0].torques.len()];
    for row in rows {
        for (peak, torque) in peaks.iter_mut().zip(&row.torques) {
            *peak = peak.max(torque.abs());
        }
    }
    peaks
}

/// A row of a run: what the columns of a truth file hold.
#[derive(Clone, Debug)]
pub struct Row {
    pub time: f64,
    pub angles: Vec<f64>,
    pub deflections: Vec<f64>,
    pub torques: Vec<f64>,
    /// Ends of the links, the tip last.
    pub ends: Vec<[f64; 2]>,
}

/// The solution of a scene of `links` links, every 10 ms.
pub fn truth(name: &str, links: usize) -> Vec<Row> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/truth/mechanisms");
    let text = std::fs::read_to_string(folder.join(format!("{name}.csv"))).expect("a truth file");
    let rows = text.lines().skip(1).map(|line| {
        let v: Vec<f64> = line.split(',').map(|field| field.parse().expect("a number")).collect();
        let tip = 1 + links;
        let mut ends: Vec<[f64; 2]> = (0..links - 1)
            .map(|j| [v[tip + 2 + 2 * links + 2 * j], v[tip + 3 + 2 * links + 2 * j]])
            .collect();
        ends.push([v[tip], v[tip + 1]]);
        Row {
            time: v[0],
            angles: v[1..tip].to_vec(),
            deflections: v[tip + 2..tip + 2 + links].to_vec(),
            torques: v[tip + 2 + links..tip + 2 + 2 * links].to_vec(),
            ends,
        }
    });
    rows.collect()
}

fn row<T: Scalar, const LINKS: usize>(time: f64, setpoint: &ChainSetpoint<T, LINKS>) -> Row {
    let joints = &setpoint.joints;
    Row {
        time,
        angles: joints.iter().map(|joint| joint.angle.precise().radians()).collect(),
        deflections: joints.iter().map(|joint| joint.tip[1].to_f64()).collect(),
        torques: joints.iter().map(|joint| joint.torque.to_f64()).collect(),
        ends: setpoint.ends.iter().map(|end| end.map(T::to_f64)).collect(),
    }
}

/// A generator with the moves of a scene.
pub fn generator<T, const LINKS: usize, const W: usize, const C: usize, const Q: usize>(
    scene: &Scene,
    tick: f64,
) -> ChainGenerator<T, LINKS, W, C, Q, 8>
where
    T: Scalar,
{
    let chain = Chain::<T, LINKS, W, C, Q>::new(&scene.mechanism, tick).expect("a chain");
    let from = core::array::from_fn(|j| scene.from[j]);
    let mut arm = ChainGenerator::<T, LINKS, W, C, Q, 8>::new(chain, from).expect("a generator");
    let mut ends = [0.0; LINKS];
    for turn in &scene.turns {
        let Turn { joint, start, duration, to, profile } = *turn;
        if start > ends[joint] {
            arm.push(joint, &Move::Dwell { duration: start - ends[joint] }).expect("a dwell");
        }
        arm.push(joint, &Move::To { profile, duration, to }).expect("a move");
        ends[joint] = start + duration;
    }
    arm
}

/// The run of a scene, a row a tick.
pub fn run<T, const LINKS: usize, const W: usize, const C: usize, const Q: usize>(
    scene: &Scene,
    tick: f64,
) -> Vec<Row>
where
    T: Scalar,
{
    let mut arm = generator::<T, LINKS, W, C, Q>(scene, tick);
    let ticks = (scene.duration / tick).round() as u32;
    (0..=ticks).map(|k| row(f64::from(k) * tick, &arm.tick())).collect()
}
