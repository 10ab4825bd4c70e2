//! Runs as long as a machine's life, in f32.

use std::f64::consts::TAU;

use stillbeam::hub::Angle;
use stillbeam::model::{Model, Modes, Rod};
use stillbeam::stepper::{AtRest, Elastica, Modal, Newmark, Quality, Rigid, Stepper};
use stillbeam::{Damping, Generator, Hub, Link, Move, Payload, Profile, Scene, Setpoint};

use stillbeam_sim::error::Error;

/// h, s.
const TICK: f64 = 0.01;

/// A cycle: profile, duration in s, target in rad. Each takes whole ticks and no dyadic angles.
const CYCLE: [(Profile, f64, f64); 4] = [
    (Profile::Cubic, 0.8, 1.57),
    (Profile::Quintic, 1.1, -2.3),
    (Profile::SCurve, 0.91, 0.1),
    (Profile::Trapezoid, 0.6, 1.0),
];

/// Rest after each move, s.
const REST: f64 = 0.4;

/// Cycles after which the arm's damping has removed the effect of its beginning.
const SETTLED: u64 = 20;

/// Result of repeated moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Shuttle {
    /// The method.
    pub method: &'static str,
    /// Number of ticks.
    pub ticks: u64,
    /// Number of stops.
    pub stops: u64,
    /// Stops at an angle that is not the target rounded to f32, bit for bit.
    pub missed: u64,
    /// Largest difference of a deflection from that of the 21st cycle at the same tick, over the
    /// peak.
    pub drift: f64,
}

/// Returns a damped arm: 0.4 m of acrylic-like strip with 30 g, first period 0.4 s.
fn arm() -> Scene {
    Scene {
        hub: Hub { radius: 0.04, inertia: 1e-4, stiffness: None },
        payload: Payload { mass: 0.030, inertia: 1e-5, offset: 0.0 },
        damping: Damping { alpha: 0.3, beta: 1e-3, joint: 0.0 },
        ..Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.26 })
    }
}

/// Repeats a cycle of moves for `ticks` ticks, by each method.
pub fn shuttles(ticks: u64, done: &dyn Fn(u64)) -> Result<Vec<Shuttle>, Error> {
    let arm = arm();
    let newmark = Newmark::<f32, 2, 2>::new(&Model::<2, 2>::consistent(&arm)?, TICK)?;
    let modal = Modal::<f32, 2>::new(&Model::<16, 4>::consistent(&arm)?, TICK)?;
    let rod = Rod::<2>::new(&arm)?;
    let elastica = Elastica::<f32, 2>::new(&rod, TICK, Quality::Fast, 1.5)?;
    Ok(vec![
        shuttle("newmark, 1 consistent", newmark, ticks, done)?,
        shuttle("modal, 2", modal, ticks, done)?,
        shuttle("elastica, 2 fast", elastica, ticks, done)?,
    ])
}

fn shuttle<S: Stepper<Scalar = f32>>(
    method: &'static str,
    stepper: S,
    ticks: u64,
    done: &dyn Fn(u64),
) -> Result<Shuttle, Error> {
    let mut arm = Generator::<S, 32>::new(stepper, 1.0)?;
    let mut found = Shuttle { method, ticks: 0, stops: 0, missed: 0, drift: 0.0 };
    let (mut known, mut peak) = (Vec::new(), 0.0_f64);
    for cycle in 0.. {
        let mut now = Vec::new();
        for (profile, duration, to) in CYCLE {
            let moving = arm.push(&Move::To { profile, duration, to })?.ticks;
            let resting = arm.push(&Move::Dwell { duration: REST })?.ticks;
            let target: Angle<f32> = Angle::from_radians(to).cast();
            // Setpoint 0 of a move is that of its start, the one after its last that of the rest.
            for k in 0..moving + resting {
                let setpoint = arm.tick();
                now.push(setpoint.deflection());
                if k == moving {
                    found.stops += 1;
                }
                if k >= moving && !is_at(&setpoint, target) {
                    found.missed += 1;
                }
            }
        }
        found.ticks += now.len() as u64;
        done(now.len() as u64);
        if cycle == SETTLED {
            peak = now.iter().fold(0.0, |peak, w| peak.max(f64::from(w.abs())));
            known = now;
        } else if cycle > SETTLED {
            for (a, b) in known.iter().zip(&now) {
                found.drift = found.drift.max(f64::from((a - b).abs()) / peak);
            }
        }
        if found.ticks >= ticks {
            break;
        }
    }
    Ok(found)
}

fn is_at(setpoint: &Setpoint<f32>, target: Angle<f32>) -> bool {
    let angle = setpoint.angle;
    angle.turns == target.turns && angle.part.to_bits() == target.part.to_bits()
}

/// Result of an undamped mode that rings on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ringing {
    /// ω₁h.
    pub turn: f64,
    /// Ticks.
    pub ticks: u64,
    /// Final phase lead of f32 over the exact solution, rad for a rad of vibration.
    pub slip: f64,
    /// Remaining amplitude.
    pub amplitude: f64,
}

/// Plucks one undamped mode in f32 and lets it ring for `ticks` ticks at each `ω₁h`.
pub fn ringing(turns: &[f64], ticks: u64, done: &dyn Fn(u64)) -> Result<Vec<Ringing>, Error> {
    turns.iter().map(|&turn| pluck(turn, ticks, done)).collect()
}

fn pluck(turn: f64, ticks: u64, done: &dyn Fn(u64)) -> Result<Ringing, Error> {
    let unit = Scene { damping: Damping::default(), ..arm() };
    let omega = Modes::of(&Model::<16, 4>::consistent(&unit)?).frequency[0];
    let stiffness = unit.link.bending_stiffness * (turn / (TICK * omega)).powi(2);
    let arm = Scene { link: Link { bending_stiffness: stiffness, ..unit.link }, ..unit };
    let model = Model::<16, 4>::consistent(&arm)?;
    let omega = Modes::of(&model).frequency[0];
    let stepper = Modal::<f32, 1>::new(&model, TICK)?;
    let generator = Generator::<_, 8>::new(stepper, 0.0)?;
    let (mut state, hub) = (*generator.state(), *generator.hub());
    state.coordinate[0] = 1.0;
    // Whole turns are counted on the way: by tick, the exact phase is known.
    let mut slipped = 0.0_f64;
    const LOOK: u64 = 10_000;
    for tick in 1..=ticks {
        generator.stepper().step::<AtRest>(&mut state, &hub, &hub);
        if tick.is_multiple_of(LOOK) || tick == ticks {
            let exact = (omega * TICK * tick as f64).rem_euclid(TAU);
            let (x, v) = (f64::from(state.coordinate[0]), f64::from(state.rate[0]) / omega);
            let ahead = (-v).atan2(x) - exact;
            // The nearest to what it was.
            slipped += (ahead - slipped + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
            if tick.is_multiple_of(LOOK) {
                done(LOOK);
            }
        }
    }
    let (x, v) = (f64::from(state.coordinate[0]), f64::from(state.rate[0]) / omega);
    let slip = slipped / (omega * TICK * ticks as f64);
    Ok(Ringing { turn, ticks, slip, amplitude: x.hypot(v) })
}

/// Result of a hub that goes on turning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// Ticks.
    pub ticks: u64,
    /// Turns.
    pub turns: f64,
    /// Largest distance of an angle from the exact one, turns.
    pub off: f64,
    /// Largest difference of a tick's turn from the exact one, turns.
    pub uneven: f64,
}

/// Turns a hub at `rate`, rad/s, for `ticks` ticks.
pub fn rotation(rate: f64, ticks: u64, done: &dyn Fn(u64)) -> Result<Rotation, Error> {
    let mut hub = Generator::<_, 8>::new(Rigid::<f32>::new(&arm(), TICK)?, 0.3)?;
    let spin_up = hub.push(&Move::SpinUp { duration: 1.0, rate })?.ticks;
    for _ in 0..spin_up {
        hub.tick();
    }
    let mut angle = hub.tick().angle;
    // The mean rate of a spin-up is half of the last.
    let first = (0.3 + 0.5 * rate * f64::from(spin_up) * TICK) / TAU;
    let a_tick = rate * TICK / TAU;
    let mut found = Rotation { ticks, turns: a_tick * ticks as f64, off: 0.0, uneven: 0.0 };
    for tick in 1..=ticks {
        let next = hub.tick().angle;
        let turned = f64::from(next.turns.wrapping_sub(angle.turns))
            + (f64::from(next.part) - f64::from(angle.part));
        found.uneven = found.uneven.max((turned - a_tick).abs());
        let exact = first + a_tick * tick as f64;
        let off = (exact - f64::from(next.turns)) - f64::from(next.part);
        found.off = found.off.max(off.abs());
        angle = next;
        if tick.is_multiple_of(1_000_000) {
            done(1_000_000);
        }
    }
    Ok(found)
}
