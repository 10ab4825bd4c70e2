//! Random arms and moves on which the choices of `auto` are judged.

use std::f64::consts::PI;

use rand::rngs::StdRng;
use rand::seq::IndexedRandom;
use rand::{Rng, SeedableRng};
use stillbeam::planner::{Planner, Request};
use stillbeam::select::Tolerance;
use stillbeam::{Damping, Hub, Link, Move, Payload, Profile, Scene};

use stillbeam_sim::error::Error;
use stillbeam_sim::reference::rod;

use crate::random::log;

/// Distribution that [`Case::random`] draws, for the page. Keep the two together.
pub const DISTRIBUTION: &[(&str, &str)] = &[
    ("link", "length 0.1 to 2 m, mass 5 g to 2 kg, first period with its payload 0.05 to 3 s"),
    (
        "payload",
        "none for 3 arms in 10, else up to 4 link masses (2u)²; of these 3 in 10 with a \
                 rotary inertia up to 0.05 m L²",
    ),
    ("hub radius", "0 for half of the arms, else up to L"),
    ("damping", "3 arms in 10: α up to 0.5/s, βω₁ up to 0.02"),
    (
        "gravity",
        "4 arms in 10, 9.81 m/s², less where the level arm would sag by more than 0.2 L: \
                 then as much as makes it 0.2 L; those start at any angle, −π to π",
    ),
    ("tick", "2 to 20 ms"),
    (
        "moves",
        "1 to 3; each turn of a random profile (one in six a still move, a quintic where \
               none is found), −3.1 to 3.1 rad, 0.7 to 6 first periods and at least 20 ticks; behind \
               4 in 10 a dwell of up to 2 first periods; one arm in 8 spins up instead, to as \
               much as 4 rad a first period and half a radian a tick, and down again",
    ),
    ("tolerances", "2e-4 to 5e-2 of L, 3e-3 to 0.1 of the torque's peak"),
];

/// An arm, its moves and the tolerance for `auto`.
#[derive(Clone, Debug)]
pub struct Case {
    /// The arm.
    pub arm: Scene,
    /// First natural period, s.
    pub period: f64,
    /// h, s.
    pub tick: f64,
    /// First hub angle, rad.
    pub from: f64,
    /// Moves from rest to rest.
    pub moves: Vec<Move>,
    /// Tolerance of the tip and of the torque.
    pub tolerance: Tolerance,
}

impl Case {
    /// Draws case `index` of the campaign with that seed. It does not depend on the cases before
    /// it.
    pub fn random(seed: u64, index: u64) -> Result<Self, Error> {
        let mut rng = StdRng::seed_from_u64(seed ^ index.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let rng = &mut rng;
        let arm = arm(rng)?;
        let period = rod::first_period(&arm)?;
        let tick = log(rng, 0.002, 0.020);
        let from = if arm.gravity > 0.0 { rng.random_range(-PI..PI) } else { 0.0 };
        let mut case =
            Self { arm, period, tick, from, moves: Vec::new(), tolerance: Tolerance::default() };
        if rng.random_bool(0.125) {
            // Half a radian a tick at most.
            let rate = rng.random_range(-1.0..1.0) * f64::min(4.0 / period, 0.5 / tick);
            for rate in [rate, 0.0] {
                case.moves.push(Move::SpinUp { duration: case.duration(rng), rate });
                case.pause(rng);
            }
        } else {
            let mut at = from;
            for _ in 0..rng.random_range(1..=3) {
                let to = rng.random_range(-3.1..3.1);
                let turn = case.turn(rng, at, to)?;
                case.moves.push(turn);
                case.pause(rng);
                at = to;
            }
        }
        case.tolerance.tip = log(rng, 2e-4, 5e-2);
        case.tolerance.torque = log(rng, 3e-3, 0.1);
        Ok(case)
    }

    fn duration(&self, rng: &mut StdRng) -> f64 {
        (log(rng, 0.7, 6.0) * self.period).max(20.0 * self.tick)
    }

    fn pause(&mut self, rng: &mut StdRng) {
        if rng.random_bool(0.4) {
            let duration = rng.random_range(0.0..2.0) * self.period;
            self.moves.push(Move::Dwell { duration: duration.max(self.tick) });
        }
    }

    fn turn(&self, rng: &mut StdRng, from: f64, to: f64) -> Result<Move, Error> {
        let duration = self.duration(rng);
        if rng.random_bool(1.0 / 6.0) {
            let planner = Planner::<f32, 2>::new(&self.arm, self.tick)?;
            let quintic = Move::To { profile: Profile::Quintic, duration, to };
            let request = Request::from_rest(from, to).duration(duration).any_deflection();
            return Ok(planner.plan(&request).map_or(quintic, |plan| plan.motion()));
        }
        let profile = *Profile::ALL.choose(rng).unwrap_or(&Profile::Cubic);
        Ok(Move::To { profile, duration, to })
    }
}

fn arm(rng: &mut StdRng) -> Result<Scene, Error> {
    let (length, mass) = (log(rng, 0.1, 2.0), log(rng, 0.005, 2.0));
    let period = log(rng, 0.05, 3.0);
    let mut arm = Scene::new(Link { length, mass, bending_stiffness: 1.0 });
    if rng.random_bool(0.7) {
        let mass = rng.random_range(0.0f64..2.0).powi(2) * mass;
        let twist = if rng.random_bool(0.3) { rng.random_range(0.0..0.05) } else { 0.0 };
        arm.payload =
            Payload { mass, inertia: twist * arm.link.mass * length * length, offset: 0.0 };
    }
    if rng.random_bool(0.5) {
        arm.hub = Hub { radius: rng.random_range(0.0..1.0) * length, ..Hub::default() };
    }
    // The period goes with the inverse root of the stiffness.
    let stiffness = (rod::first_period(&arm)? / period).powi(2);
    arm.link.bending_stiffness = stiffness;
    let omega = std::f64::consts::TAU / period;
    if rng.random_bool(0.3) {
        let beta = rng.random_range(0.0..0.02) / omega;
        arm.damping = Damping { alpha: rng.random_range(0.0..0.5), beta, joint: 0.0 };
    }
    if rng.random_bool(0.4) {
        // Level, of the payload and three eighths of the link at the tip.
        let weight = 9.81 * (arm.payload.mass + 0.375 * mass);
        let sag = weight * length * length / (3.0 * stiffness);
        arm.gravity = 9.81 * f64::min(1.0, 0.2 / sag);
    }
    Ok(arm)
}
