//! Chains of links that host and target run alike.

use stillbeam::axis::{MechanismAxes, Mode, Policy};
use stillbeam::chain::{Chain, ChainGenerator, ChainSetpoint};
use stillbeam::drive::odrive;
use stillbeam::mechanism::{Closure, Joint, Link, Mechanism};
use stillbeam::motor::{self, Direction, Drivetrain, Ratio};
use stillbeam::{Angle, Error, Limits, Move, Profile};

/// A move of one joint, counted from 0: when it begins (s), how long it takes (s), its end (rad).
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    joint: usize,
    start: f64,
    duration: f64,
    profile: Profile,
    to: f64,
}

/// Takes every setpoint: the chain's name, the tick from 0, the setpoints, and the instructions
/// that the tick took, if they are counted.
pub trait Sink {
    /// Makes a tick, and may count what it takes.
    fn tick<const LINKS: usize>(
        &mut self,
        name: &'static str,
        tick: u32,
        make: impl FnOnce() -> ChainSetpoint<f32, LINKS>,
    );

    /// Takes the bytes that the drive of a joint, counted from 0, is told at the latest tick.
    fn frame(&mut self, joint: usize, payload: [u8; 8]);
}

const TICK: f64 = 0.01;
const D: Link = Link::flexible(0.3, 0.0168, 0.46);
const QUINTIC: Profile = Profile::Quintic;

const fn turn(joint: usize, start: f64, duration: f64, profile: Profile, to: f64) -> Turn {
    Turn { joint, start, duration, profile, to }
}

/// One flexible link, horizontal, undamped.
fn one_link() -> Result<Mechanism, Error> {
    let mut mechanism = Mechanism::new(&[D])?;
    mechanism.payload.mass = 0.02;
    Ok(mechanism)
}

/// Two flexible links on driven joints, horizontal, undamped.
fn two_links() -> Result<Mechanism, Error> {
    let mut mechanism = Mechanism::new(&[D, D])?;
    mechanism.joints[1].mass = 0.05;
    mechanism.payload.mass = 0.02;
    Ok(mechanism)
}

/// Two flexible links with all that a chain can have.
fn sag() -> Result<Mechanism, Error> {
    let upper = Link { tip_offset: 0.015, ..Link::flexible(0.3, 0.01428, 0.042656) };
    let mut mechanism = Mechanism::new(&[upper, Link::flexible(0.3, 0.0084, 0.0575)])?;
    mechanism.joints[0].radius = 0.02;
    mechanism.joints[1] =
        Joint { radius: 0.015, mass: 0.02, stator_inertia: 4e-6, inertia: 2e-6, ..Joint::DRIVEN };
    mechanism.payload.mass = 0.01;
    mechanism.payload.inertia = 2e-6;
    (mechanism.damping.alpha, mechanism.damping.beta) = (0.15, 0.002);
    mechanism.gravity = 9.81;
    Ok(mechanism)
}

/// Three flexible links on driven joints that stay open.
fn three_links() -> Result<Mechanism, Error> {
    let mut mechanism = Mechanism::new(&[Link::flexible(0.2, 0.0112, 0.46), D, D])?;
    mechanism.joints[1].mass = 0.03;
    mechanism.joints[2].mass = 0.02;
    mechanism.payload.mass = 0.005;
    (mechanism.damping.alpha, mechanism.damping.beta) = (0.1, 0.004);
    Ok(mechanism)
}

/// Three flexible links that close while they run.
fn latch() -> Result<Mechanism, Error> {
    let mut closure = Closure::at(0.7);
    for joint in [1, 2] {
        // There is room for all joints.
        let _ = closure.release.push(joint);
    }
    Ok(Mechanism { closure: Some(closure), ..three_links()? })
}

/// A crank that drives a loop.
fn four_bar() -> Result<Mechanism, Error> {
    let mut mechanism = Mechanism::new(&[
        Link::flexible(0.12, 0.00672, 0.46),
        Link::flexible(0.35, 0.00833, 0.0213344),
        Link::flexible(0.3, 0.00714, 0.0213344),
    ])?;
    mechanism.joints[1] = Joint { mass: 0.01, ..Joint::passive(0.8) };
    mechanism.joints[2] = Joint { mass: 0.03, ..Joint::passive(-1.5) };
    mechanism.damping.beta = 0.0005;
    mechanism.closure = Some(Closure::on_pin([0.4, 0.0]));
    Ok(mechanism)
}

const TWO: [Turn; 2] = [turn(0, 0.0, 0.6, QUINTIC, 1.0), turn(1, 0.0, 0.6, QUINTIC, 1.3)];
const SAG: [Turn; 2] =
    [turn(0, 0.0, 1.2, Profile::Cubic, -0.9), turn(1, 0.5, 1.0, Profile::Cubic, -0.5)];
const THREE: [Turn; 3] = [
    turn(0, 0.0, 0.6, QUINTIC, 1.4),
    turn(1, 0.0, 0.6, QUINTIC, -1.0),
    turn(2, 0.0, 0.6, QUINTIC, -1.2),
];
const LATCH: [Turn; 4] = [THREE[0], THREE[1], THREE[2], turn(0, 0.7, 0.6, QUINTIC, 2.0)];
const CRANK: [Turn; 1] = [turn(0, 0.0, 0.8, QUINTIC, 6.8)];

/// Runs every chain.
///
/// # Errors
/// The first chain or move that the core refuses; none of them is.
pub fn run(sink: &mut impl Sink) -> Result<(), Error> {
    one::<1, 3, 3, 3>("one-link", &one_link()?, [0.0], &TWO[..1], 90, sink)?;
    one::<1, 4, 4, 5>("one-link-fine", &one_link()?, [0.0], &TWO[..1], 90, sink)?;
    one::<2, 3, 6, 3>("two-links", &two_links()?, [0.0, 0.3], &TWO, 90, sink)?;
    one::<2, 3, 6, 3>("two-links-full", &sag()?, [-1.8, 0.5], &SAG, 180, sink)?;
    one::<3, 3, 9, 3>("three-links", &three_links()?, [0.2; 3], &THREE, 90, sink)?;
    one::<3, 3, 9, 3>("four-bar", &four_bar()?, [0.5, 0.0, 0.0], &CRANK, 110, sink)?;
    one::<3, 3, 9, 3>("latch", &latch()?, [0.2; 3], &LATCH, 160, sink)?;
    one::<2, 4, 8, 5>("two-links-fine", &two_links()?, [0.0, 0.3], &TWO, 90, sink)?;
    two_axes(sink)
}

/// Ticks without a word from the host after which the axes stop.
const PATIENCE: u32 = 30;

/// Two links as two axes of one mechanism: enabled, sent on their moves, and left alone. They stop
/// along their common path. What each tick says goes to two drives, behind gears.
#[inline(never)]
fn two_axes(sink: &mut impl Sink) -> Result<(), Error> {
    let chain = Chain::<f32, 2, 3, 6, 3>::new(&two_links()?, TICK)?;
    let limits = Limits { acceleration: Some(30.0), ..Limits::default() };
    let policy = Policy { limits, patience: TICK * f64::from(PATIENCE), missed: 2 };
    let mut axes = MechanismAxes::<f32, 2, 3, 6, 3, 4>::new(chain, [0.0; 2], &[policy; 2])?;
    let geared = |motor, direction, zero| {
        let joint = motor::Joint { ratio: Ratio { motor, link: 2 }, ..motor::Joint::direct(0.05) };
        Drivetrain::<f32>::new(&joint, direction, zero)
    };
    let trains = [geared(81, Direction::Same, 0.25)?, geared(35, Direction::Opposite, -3.0)?];
    axes.enable(&[0.0, 0.3].map(|angle| Angle::from_radians(angle).cast()))?;
    for turn in &TWO {
        axes.push(turn.joint, &Move::To { profile: turn.profile, duration: 0.6, to: turn.to })?;
    }
    for k in 0..=2 * PATIENCE {
        let mut setpoints = None;
        sink.tick("two-axes", k, || {
            let tick = axes.tick();
            setpoints = Some(tick.setpoint.joints);
            tick.setpoint
        });
        for (joint, (setpoint, train)) in setpoints.iter().flatten().zip(&trains).enumerate() {
            if let Some(encoded) = odrive::encode(&train.demand(setpoint)) {
                sink.frame(joint, encoded.payload);
            }
        }
    }
    if axes.mode() == Mode::Stopped { Ok(()) } else { Err(Error::Moving) }
}

#[inline(never)]
fn one<const LINKS: usize, const W: usize, const C: usize, const Q: usize>(
    name: &'static str,
    mechanism: &Mechanism,
    from: [f64; LINKS],
    turns: &[Turn],
    ticks: u32,
    sink: &mut impl Sink,
) -> Result<(), Error> {
    let chain = Chain::<f32, LINKS, W, C, Q>::new(mechanism, TICK)?;
    let mut arm = ChainGenerator::<f32, LINKS, W, C, Q, 4>::new(chain, from)?;
    let mut ends = [0.0; LINKS];
    for turn in turns {
        let Turn { joint, start, duration, profile, to } = *turn;
        if start > ends[joint] {
            arm.push(joint, &Move::Dwell { duration: start - ends[joint] })?;
        }
        arm.push(joint, &Move::To { profile, duration, to })?;
        ends[joint] = start + duration;
    }
    for k in 0..=ticks {
        sink.tick(name, k, || arm.tick());
    }
    Ok(())
}
