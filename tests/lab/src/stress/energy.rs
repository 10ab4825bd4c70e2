//! Undamped arms that ring on after a move: the energy that a method adds to them or takes away.

use rayon::prelude::*;
use stillbeam::hub::HubState;
use stillbeam::model::{Model, Modes, Rod};
use stillbeam::stepper::{self, AnyMotion, AtRest, Elastica, Modal, Newmark, Stepper};
use stillbeam::{Angle, Damping, Generator, Move, Scalar as Real, Scene};
use stillbeam_energy::{exact, nodal, small};

use super::draw::draw_plain;
use stillbeam_sim::error::Error;
use stillbeam_sim::step::Step;

/// Ticks for which a campaign's arms ring on.
pub const TICKS: u64 = 1_000_000;

/// Ticks between two samples of the energy, not a multiple of a period.
const STRIDE: u64 = 17;

/// Samples of the energy that are averaged. The energy by the exact kinematics swings by what the
/// expansion leaves out.
const LOOKS: u64 = 500;

/// One arm that rang on.
#[derive(Clone, Debug, PartialEq)]
pub struct Ring {
    /// Number of its scene.
    pub scene: u64,
    /// Method and precision.
    pub method: String,
    /// ω₁h.
    pub turn: f64,
    /// Relative growth: largest mean energy over that in the beginning, less 1.
    pub growth: f64,
    /// Relative loss: 1 less the last mean energy over that in the beginning.
    pub loss: f64,
}

/// Lets undamped level arms of scenes of a seed, from scene `first` on, ring on for some ticks.
/// Each method that takes them runs in both precisions.
pub fn rings(
    seed: u64,
    first: u64,
    arms: usize,
    ticks: u64,
    done: &(dyn Fn() + Sync),
) -> Vec<Ring> {
    let moved = (first..).filter_map(|index| suitable(seed, index)).take(arms);
    let moved: Vec<Arm> = moved.collect();
    moved
        .into_par_iter()
        .flat_map_iter(|arm| {
            let mut rings = Vec::new();
            of_arm::<f64>(&arm, ticks, "f64", &mut rings);
            of_arm::<f32>(&arm, ticks, "f32", &mut rings);
            done();
            rings
        })
        .collect()
}

struct Arm {
    index: u64,
    arm: Scene,
    tick: f64,
    turn: f64,
    motion: Move,
    bend: f64,
}

/// Returns the scene without damping and gravity, if a tick resolves its first mode and its move
/// bends it by a hundredth to half a radian.
fn suitable(seed: u64, index: u64) -> Option<Arm> {
    let drawn = draw_plain(seed, index);
    let tick = drawn.solvers.first()?.tick;
    let turn = drawn.omega * tick;
    let arm = Scene { damping: Damping::default(), gravity: 0.0, ..drawn.scene.arm };
    let Step { motion, .. } = drawn.scene.moves.first()?;
    let Move::To { profile, duration, to } = motion.as_move()? else { return None };
    let rod = Rod::<3>::new(&arm).ok()?;
    let bend = rod.bend(profile.peaks(to - drawn.scene.from, duration).acceleration);
    let wanted = (1e-4..3.0).contains(&turn) && (0.01..0.5).contains(&bend);
    let motion = Move::To { profile, duration, to: to - drawn.scene.from };
    wanted.then_some(Arm { index, arm, tick, turn, motion, bend })
}

fn of_arm<T: Real>(arm: &Arm, ticks: u64, scalar: &str, rings: &mut Vec<Ring>) {
    let mut keep = |method: &str, ring: Result<(f64, f64), Error>| {
        // What a method refuses is counted elsewhere.
        if let Ok((growth, loss)) = ring {
            let method = format!("{method}, {scalar}");
            rings.push(Ring { scene: arm.index, method, turn: arm.turn, growth, loss });
        }
    };
    keep("newmark, 4", newmark::<T, 8>(arm, ticks));
    keep("newmark, 8", newmark::<T, 16>(arm, ticks));
    keep("modal, 2", modal::<T>(arm, ticks));
    for quality in [stepper::Quality::Fast, stepper::Quality::Fine] {
        let name = if quality == stepper::Quality::Fast { "fast" } else { "fine" };
        keep(&format!("elastica, 1 {name}"), elastica::<T, 1>(arm, quality, ticks));
        keep(&format!("elastica, 2 {name}"), elastica::<T, 2>(arm, quality, ticks));
        keep(&format!("elastica, 3 {name}"), elastica::<T, 3>(arm, quality, ticks));
    }
}

/// A hub at rest. The arms are level, so that its angle does not count.
const REST: HubState<f64> = HubState::at_rest(Angle { turns: 0, part: 0.0 });

fn newmark<T: Real, const N: usize>(arm: &Arm, ticks: u64) -> Result<(f64, f64), Error> {
    let model = Model::<N, 4>::consistent(&arm.arm)?;
    let per_half = 2.0 / arm.tick;
    ring_on(Newmark::<T, N, 4>::new(&model, arm.tick)?, arm, ticks, |_, state, _| {
        let rate = state.gain.map(|gain| per_half * gain.to_f64());
        small(&model, &REST, &state.deflection.map(T::to_f64), &rate).of_vibration()
    })
}

fn modal<T: Real>(arm: &Arm, ticks: u64) -> Result<(f64, f64), Error> {
    let model = Model::<16, 4>::consistent(&arm.arm)?;
    let modes = Modes::of(&model);
    ring_on(Modal::<T, 2>::new(&model, arm.tick)?, arm, ticks, |_, state, _| {
        let [q, rate] =
            [state.coordinate, state.rate].map(|modal| nodal(&modes, &modal.map(T::to_f64)));
        small(&model, &REST, &q, &rate).of_vibration()
    })
}

fn elastica<T: Real, const K: usize>(
    arm: &Arm,
    quality: stepper::Quality,
    ticks: u64,
) -> Result<(f64, f64), Error> {
    let rod = Rod::<K>::new(&arm.arm)?;
    // Room for what the vibration adds.
    let stepper = Elastica::<T, K>::new(&rod, arm.tick, quality, (2.0 * arm.bend).max(0.05))?;
    ring_on(stepper, arm, ticks, |stepper, state, hub| {
        let flex = stepper.arm_state(state, hub);
        let (a, v) = (flex.coordinate.map(T::to_f64), flex.rate.map(T::to_f64));
        exact(&rod, &REST, &a, &v).of_vibration()
    })
}

/// Returns growth and loss of the energy over the ticks after the move. The arm is kept from sleep.
fn ring_on<S: Stepper>(
    stepper: S,
    arm: &Arm,
    ticks: u64,
    energy: impl Fn(&S, &S::State, &HubState<S::Scalar>) -> f64,
) -> Result<(f64, f64), Error> {
    let mut generator = Generator::<S, 14>::new(stepper, 0.0)?;
    let moving = generator.push(&arm.motion)?.ticks;
    for _ in 0..=moving + 1 {
        generator.tick();
    }
    let (mut state, hub) = (*generator.state(), *generator.hub());
    let stepper = generator.stepper();
    let mut means = Vec::new();
    let (mut sum, mut looks) = (0.0, 0);
    for tick in 0..ticks {
        // As the generator has it.
        if S::FAST.at_rest {
            stepper.step::<AtRest>(&mut state, &hub, &hub);
        } else {
            stepper.step::<AnyMotion>(&mut state, &hub, &hub);
        }
        if tick.is_multiple_of(STRIDE) {
            sum += energy(stepper, &state, &hub);
            looks += 1;
            if looks == LOOKS {
                means.push(sum / LOOKS as f64);
                (sum, looks) = (0.0, 0);
            }
        }
    }
    let first = means.first().copied().unwrap_or(sum / looks.max(1) as f64);
    let last = means.last().copied().unwrap_or(first);
    let most = means.iter().fold(
        first,
        |most: f64, &mean| {
            if mean.is_nan() { f64::INFINITY } else { most.max(mean) }
        },
    );
    Ok((most / first - 1.0, 1.0 - last / first))
}
