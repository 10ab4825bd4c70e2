//! Random mechanisms by the thousand: what the core refuses of them, and how far off the rest is.

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::mechanism::{Closing, Closure, Joint, Link, Mechanism, Stiffness};
use stillbeam::scene::Payload;
use stillbeam::{Move, Profile};
use stillbeam_sim::mechanism::table::Row;
use stillbeam_sim::mechanism::{JointDrive, MechanismScene, MechanismSolver, run};
use stillbeam_sim::solver::Scalar;

use crate::campaign;

/// The tick that is tried.
const TRIED: MechanismSolver = MechanismSolver { tick: 0.01, scalar: Scalar::F32, coordinates: 2 };
/// The judge: an eighth of the tick with a coordinate more, in f64.
const JUDGE: MechanismSolver =
    MechanismSolver { tick: 0.00125, scalar: Scalar::F64, coordinates: 3 };
/// Length of a run, s.
const DURATION: f64 = 2.0;

/// How a mechanism ends: free, or on a pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// It stays open.
    Open,
    /// It closes while it runs.
    Closes,
    /// It is a loop from the beginning.
    Loop,
}

/// Outcome of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// It was refused, by a field that begins so.
    Refused(&'static str),
    /// It ran. A row holds a number that is none.
    NotFinite,
    /// It ran: largest deflection of a link over its own length, and how far off it is, if it was
    /// judged.
    Ran {
        /// Deflection, of the link's length.
        deflection: f64,
        /// None if it was not to be judged, or the judge was refused.
        judged: Option<Judged>,
    },
}

/// A run beside the judge's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// Largest error of a place, of the total length.
    pub place: f64,
    /// Largest deflection of a link in the judge's run, of its own length.
    pub deflection: f64,
}

/// One trial: links, end and outcome.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// Number of links.
    pub links: usize,
    /// How it ends.
    pub end: End,
    /// Its outcome.
    pub outcome: Outcome,
}

/// Tries `count` random mechanisms, and judges every `judged`-th of them. Judging one takes some
/// ten times as long as running it.
pub fn trials(seed: u64, count: u64, judged: u64, done: &(dyn Fn() + Sync)) -> Vec<Trial> {
    campaign::each("mechanism", 0..count, done, |index| {
        let mut rng = StdRng::seed_from_u64(seed.wrapping_add(index));
        let links = rng.random_range(1..=3);
        let end = [End::Open, End::Closes, End::Loop][rng.random_range(0..3)];
        let scene = draw(&mut rng, links, end);
        Trial { links, end, outcome: attempt(&scene, index.is_multiple_of(judged)) }
    })
}

/// Runs a mechanism and, if it is `to_judge`, judges it.
fn attempt(scene: &MechanismScene, to_judge: bool) -> Outcome {
    let rows = match run::run(scene, &TRIED) {
        Ok(rows) => rows,
        Err(error) => return Outcome::Refused(kind(&error.to_string())),
    };
    let finite = |row: &Row| row.values().iter().all(|value| value.is_finite());
    if !rows.iter().all(finite) {
        return Outcome::NotFinite;
    }
    let judged = if to_judge { judge(scene, &rows) } else { None };
    Outcome::Ran { deflection: deflection(scene, &rows), judged }
}

/// Compares a run with the judge's, unless that is refused.
fn judge(scene: &MechanismScene, rows: &[Row]) -> Option<Judged> {
    let exact = run::run(scene, &JUDGE).ok()?;
    let length = scene.mechanism.total_length();
    let mut place = 0.0;
    for (row, exact) in rows.iter().zip(exact.iter().step_by(8)) {
        for (end, exact) in row.ends.iter().zip(&exact.ends) {
            place = f64::max(place, (end[0] - exact[0]).hypot(end[1] - exact[1]) / length);
        }
    }
    Some(Judged { place, deflection: deflection(scene, &exact) })
}

/// Returns the largest deflection of a link, of its own length.
fn deflection(scene: &MechanismScene, rows: &[Row]) -> f64 {
    let of_row = |row: &Row| {
        let links = row.deflections.iter().zip(&scene.mechanism.links);
        links.map(|(bent, link)| bent.abs() / link.length).fold(0.0, f64::max)
    };
    rows.iter().map(of_row).fold(0.0, f64::max)
}

/// Returns the field by which a mechanism was refused, in the words of the table.
fn kind(error: &str) -> &'static str {
    let field = error.rsplit("]: ").next().unwrap_or(error);
    match field {
        _ if field.starts_with("move.duration") => "move",
        _ if field.starts_with("solver.tick") => "tick",
        _ if field.starts_with("closure.pin") => "pin out of reach",
        _ if field.starts_with("closure") => "loop",
        _ if field.starts_with("gravity") => "no stable rest",
        _ => "other",
    }
}

/// Draws a mechanism: links of 0.1 to 0.6 m, one in six rigid; one joint in eight passive; hubs,
/// motors and offsets; half damped, half under gravity; two moves of each driven joint that is not
/// let go.
fn draw(rng: &mut StdRng, count: usize, end: End) -> MechanismScene {
    let links: Vec<Link> = (0..count).map(|_| link(rng)).collect();
    let mut mechanism = Mechanism::new(&links).expect("three links at most");
    for joint in &mut mechanism.joints {
        *joint = self::joint(rng);
    }
    mechanism.payload = Payload {
        mass: rng.random_range(0.0..0.05),
        inertia: rng.random_range(0.0..1e-5),
        offset: if rng.random_bool(0.5) { rng.random_range(0.0..0.02) } else { 0.0 },
    };
    if rng.random_bool(0.5) {
        mechanism.damping.alpha = rng.random_range(0.0..1.0);
        mechanism.damping.beta = rng.random_range(0.0..0.004);
    }
    mechanism.gravity = if rng.random_bool(0.5) { 9.81 } else { 0.0 };
    close(rng, &mut mechanism, end);
    let drives = (0..count)
        .filter(|&j| mechanism.is_driven(j) && !mechanism.is_free_when_closed(j))
        .flat_map(|j| moves(rng, j, mechanism.joints[j].angle))
        .collect();
    MechanismScene {
        name: "random".to_owned(),
        mechanism,
        drives,
        duration: DURATION,
        limits: vec![Default::default(); count],
        solver: Default::default(),
    }
}

fn link(rng: &mut StdRng) -> Link {
    let length = rng.random_range(0.1..0.6);
    let stiffness = f64::exp(rng.random_range(f64::ln(0.02)..f64::ln(3.0)));
    Link {
        length,
        mass: length * f64::exp(rng.random_range(f64::ln(0.02)..f64::ln(0.2))),
        stiffness: if rng.random_bool(0.17) {
            Stiffness::Rigid
        } else {
            Stiffness::Bending(stiffness)
        },
        tip_offset: if rng.random_bool(0.3) { rng.random_range(0.0..0.02) } else { 0.0 },
    }
}

fn joint(rng: &mut StdRng) -> Joint {
    Joint {
        radius: rng.random_range(0.0..0.04),
        inertia: rng.random_range(0.0..2e-5),
        mass: rng.random_range(0.0..0.1),
        stator_inertia: rng.random_range(0.0..2e-5),
        passive: rng.random_bool(0.125),
        angle: rng.random_range(-1.5..1.5),
    }
}

/// Pins the end: a loop on a pin within reach, its last joints passive; or at a tick of the run.
fn close(rng: &mut StdRng, mechanism: &mut Mechanism, end: End) {
    let count = mechanism.links.len();
    let free = count - rng.random_range(1..=count);
    match end {
        End::Open => {}
        End::Closes => {
            let mut closure = Closure::at(TRIED.tick * f64::from(rng.random_range(5..150_u32)));
            closure.release = (free..count).filter(|&j| mechanism.is_driven(j)).collect();
            mechanism.closure = Some(closure);
        }
        End::Loop => {
            for joint in mechanism.joints.iter_mut().skip(free) {
                joint.passive = true;
            }
            let far = mechanism.total_length() * rng.random_range(0.3..0.9);
            let angle: f64 = rng.random_range(-0.6..0.6);
            mechanism.closure = Some(Closure {
                begins: Closing::OnPin([far * angle.cos(), far * angle.sin()]),
                release: Default::default(),
            });
        }
    }
}

/// Two moves one behind the other.
fn moves(rng: &mut StdRng, joint: usize, from: f64) -> Vec<JointDrive> {
    let profile = Profile::ALL[rng.random_range(0..Profile::ALL.len())];
    let (mut start, mut to) = (0.0, from);
    let mut all = Vec::new();
    for _ in 0..2 {
        let duration = TRIED.tick * f64::from(rng.random_range(15..95_u32));
        to += rng.random_range(-1.5..1.5);
        all.push(JointDrive { joint, start, motion: Move::To { profile, duration, to }.into() });
        start += duration;
    }
    all
}
