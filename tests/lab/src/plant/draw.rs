//! Random arms, machines and moves.

use rand::Rng;
use rand::rngs::StdRng;
use stillbeam::axis::{Policy, StopLimits};
use stillbeam::motor::{Direction, Ratio};
use stillbeam::{Damping, Limits, Link, Payload, Scene, UniformScene};
use stillbeam_board::machine::Configuration;
use stillbeam_sim::plant::{Cogging, Friction, Gear, Motor, Parts};
use stillbeam_sim::reference::rod;
use stillbeam_sim::servo::odrive;

/// An axis with its machine, and a move within its limits.
pub struct Case {
    /// The axis, as the board knows it.
    pub configuration: Configuration,
    /// Motor, gear and friction.
    pub parts: Parts,
    /// Gains and loops of the drive.
    pub drive: odrive::Config,
    /// Counts of the encoder a turn.
    pub counts: u32,
    /// Age of the encoder's reading, s.
    pub latency: f64,
    /// Duration of the move, s, and its turn, rad.
    pub duration: f64,
    /// See [`Self::duration`].
    pub turn: f64,
    /// Inertia of arm, hub and rotor about the hub, kg m².
    pub inertia: f64,
    /// Rate at which the arm's damping by mass slows the hub with the arm stiff, 1/s.
    pub drag: f64,
    /// First period of the arm on a hub that is held, s.
    pub period: f64,
    /// Time in which its damping takes a vibration down to 5 %, s.
    pub settling: f64,
}

/// Returns a number between two positive ones, evenly in its logarithm.
fn spread(rng: &mut StdRng, least: f64, most: f64) -> f64 {
    least * (most / least).powf(rng.random::<f64>())
}

impl Case {
    /// Draws a case.
    pub fn random(rng: &mut StdRng) -> Self {
        let (scene, damping) = arm(rng);
        let arm = Scene::from(scene);
        let period = rod::first_period(&arm).unwrap_or(0.3);
        let duration = (period * rng.random_range(1.5..4.0)).clamp(0.3, 1.2);
        let turn: f64 = rng.random_range(0.3..1.6) * if rng.random() { 1.0 } else { -1.0 };
        let ratio = Ratio { motor: rng.random_range(1..=6), link: 1 };
        let n: f64 = ratio.value();
        let [_, _, second] = arm.link_moments();
        let at_tip = (arm.hub.radius + arm.link.length).powi(2);
        let load = second + arm.payload.mass * at_tip + arm.hub.inertia;
        let rotor = load * rng.random_range(0.02..0.3);
        let torque = (load + rotor) * 6.0 * turn.abs() / (duration * duration);
        let parts = parts(rng, ratio, rotor / (n * n), torque);
        let inertia = load + rotor;
        let drag = scene.damping.alpha * (load - arm.hub.inertia) / inertia;
        // Peak rate and acceleration of a quintic, with room for a stop.
        let limits = Limits {
            rate: Some(2.2 * turn.abs() / duration),
            acceleration: Some(8.0 * turn.abs() / (duration * duration)),
            ..Limits::default()
        };
        let policy = Policy { limits, stop: StopLimits::OF_MOVES, patience: 0.1, missed: 2 };
        let direction = if rng.random() { Direction::Same } else { Direction::Opposite };
        let joint = parts.joint(rng.random());
        let zero = rng.random_range(-2.0..2.0);
        let (payloads, node) = (&[][..], rng.random_range(0..64));
        let configuration = Configuration { scene, payloads, policy, joint, direction, zero, node };
        let drive = gains(rng, rotor, n, parts.friction.breakaway);
        let counts = 1 << rng.random_range(13..18);
        let latency = if rng.random() { 0.0 } else { 1.0 / drive.rate };
        let settling = 20f64.ln() * period / (std::f64::consts::TAU * damping);
        Self {
            configuration,
            parts,
            drive,
            counts,
            latency,
            duration,
            turn,
            inertia,
            drag,
            period,
            settling,
        }
    }

    /// Time after which the drive's loops, left to an error of the hub with the arm stiff, turn it
    /// by less than a thousandth of that error in the arm's first period, s.
    ///
    /// The position gain alone does not say it: the arm has up to fifty times the rotor's inertia,
    /// makes the velocity loop as many times softer, and then the hub swings.
    pub fn drive_settling(&self) -> f64 {
        const STEP: f64 = 1e-3;
        const LONGEST: f64 = 60.0;
        let [gain, integrator] = self.stiff_loop();
        let [mut angle, mut rate, mut held, mut settled]: [f64; 4] = [1.0, 0.0, 0.0, 0.0];
        for k in 1..(LONGEST / STEP) as u32 {
            let error = -self.drive.position_gain * angle - rate;
            held += STEP * integrator * error;
            rate += STEP * (gain * error + held - self.drag * rate);
            angle += STEP * rate;
            if rate.abs() * self.period > 1e-3 {
                settled = STEP * f64::from(k);
            }
        }
        settled
    }

    /// Gain of the velocity loop over the whole inertia, 1/s, and of its integrator, 1/s².
    fn stiff_loop(&self) -> [f64; 2] {
        let ratio: f64 = self.configuration.joint.ratio.value();
        let per_turn = std::f64::consts::TAU * self.inertia / (ratio * ratio);
        [self.drive.velocity_gain / per_turn, self.drive.integrator_gain / per_turn]
    }
}

/// Draws an arm with its damping ratio.
fn arm(rng: &mut StdRng) -> (UniformScene, f64) {
    let length = rng.random_range(0.2..1.0);
    let mass = spread(rng, 0.02, 0.3);
    let payload = mass * rng.random_range(0.0..2.0);
    let omega = std::f64::consts::TAU * spread(rng, 3.0, 10.0);
    // Of a cantilever with that payload (Rayleigh's quotient), which need not be exact here.
    let stiffness = (33.0 / 140.0 * mass + payload) * f64::powi(length, 3) * omega * omega / 3.0;
    let mut scene = UniformScene::uniform(Link { length, mass, bending_stiffness: stiffness });
    scene.payload = Payload { mass: payload, ..Payload::default() };
    scene.hub.radius = length * rng.random_range(0.0..0.2);
    scene.hub.inertia = mass * length * length * rng.random_range(0.01..0.1);
    // The first mode by mass, and 1 % at the second of the bare link by stiffness: more of that
    // would damp the highest polynomial so much that it takes most of the time to integrate.
    let ratio = rng.random_range(0.03..0.06);
    let bare = 3.516 * (stiffness / (mass * f64::powi(length, 3))).sqrt();
    let alpha = 2.0 * ratio * omega;
    let beta = 2.0 * 0.01 / (6.27 * bare);
    scene.damping = Damping { alpha, beta, joint: 0.0 };
    (scene, ratio)
}

fn parts(rng: &mut StdRng, ratio: Ratio, rotor_inertia: f64, torque: f64) -> Parts {
    let n: f64 = ratio.value();
    let coulomb = torque * rng.random_range(0.0..0.1);
    let compliant = ratio.motor > 1 && rng.random();
    Parts {
        gear: Gear {
            ratio,
            efficiency: if ratio.motor > 1 { rng.random_range(0.7..1.0) } else { 1.0 },
            stiffness: compliant.then_some(200.0 * torque),
            damping: if compliant { 0.2 * torque } else { 0.0 },
            backlash: if compliant { rng.random_range(0.0..2e-3) } else { 0.0 },
            output_inertia: 0.0,
        },
        friction: Friction {
            coulomb,
            breakaway: coulomb * rng.random_range(1.0..1.5),
            stribeck_rate: 0.05,
            viscous: torque * rng.random_range(0.0..0.01),
            presliding: 1e-3,
        },
        motor: Motor {
            rotor_inertia,
            torque: Some(4.0 * torque / n),
            torque_rate: None,
            speed: None,
            cogging: Cogging {
                amplitude: torque / n * rng.random_range(0.0..0.02),
                periods: rng.random_range(10..100),
            },
        },
    }
}

/// Angle of the hub that friction may hold against the position loop if the drive integrates, rad.
const HELD: f64 = 5e-3;

/// Gains for a rotor of that inertia at the hub, kg m², behind a gear: a velocity loop of 80 to
/// 200 rad/s by the rotor alone, which the arm makes softer.
///
/// An integrator breaks a hub that sticks away again and again, and each time lets it go to the
/// other side of what friction holds. It hunts, as every such drive does. Where that would be a
/// turn beyond what counts as rest, the drive has none.
fn gains(rng: &mut StdRng, rotor_inertia: f64, ratio: f64, breakaway: f64) -> odrive::Config {
    let bandwidth = rng.random_range(80.0..200.0);
    let velocity_gain = std::f64::consts::TAU * rotor_inertia / (ratio * ratio) * bandwidth;
    let rate = [1000.0, 2000.0][rng.random_range(0..2)];
    let position_gain = bandwidth * rng.random_range(0.05..0.1);
    let integrator_gain = velocity_gain * rng.random_range(0.0..4.0);
    let held = breakaway / (rotor_inertia * bandwidth * position_gain);
    odrive::Config {
        position_gain,
        velocity_gain,
        integrator_gain: if held < HELD { integrator_gain } else { 0.0 },
        velocity_limit: 1e3,
        // An estimate of 1 rad/s per hertz and more would swing up by itself.
        bandwidth: 0.6 * rate,
        rate,
        between: stillbeam_sim::servo::Between::Linear,
        filter_bandwidth: None,
        filter_inertia: 0.0,
    }
}
