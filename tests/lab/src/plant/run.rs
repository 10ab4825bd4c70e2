//! Runs an axis, its drive and its machine in lock-step under a fault.

mod judge;

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::axis::Mode;
use stillbeam::drive::ClassicFrame;
use stillbeam::drive::odrive::{EncoderEstimates, Errors, Heartbeat};
use stillbeam::motor::Direction;
use stillbeam::{PlainMove, Profile, Scene};
use stillbeam_board::machine::{TICK, ticks};
use stillbeam_board::{Board, PERIOD, Step, Watch};
use stillbeam_protocol::Command;
use stillbeam_sim::error::Error;
use stillbeam_sim::plant::{Effort, Encoder, Options, Plant};
use stillbeam_sim::servo::odrive::Odrive;
use stillbeam_sim::servo::{Servo, Target};

use super::draw::Case;
use super::rest::Rest;
use super::{Fault, Outcome};
use crate::campaign;

/// Fineness of the rod: setpoints and rest are judged, not its last digits. The energy balance says
/// what it costs.
const OPTIONS: Options = Options { order: 5, tolerance: 1e-6 };

/// Time from the end of the move until the vibrations that it leaves begin to settle, s: a link
/// that is cut shows after the patience, a drive that is lost after its own.
const LATE: f64 = 0.6;

/// Time without a setpoint after which the drive's watchdog switches it off, s.
const WATCHDOG: f64 = 0.1;

/// Rate at which a brake holds the hub of a drive that is off, 1/s.
const BRAKE: f64 = 200.0;

/// Runs every fault `count` times.
pub fn all(
    seed: u64,
    count: u64,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<(&'static str, Outcome)>, Error> {
    Fault::ALL.into_iter().map(|fault| Ok((fault.name(), of(fault, seed, count, done)?))).collect()
}

/// Runs one fault `count` times.
pub fn of(fault: Fault, seed: u64, count: u64, done: &(dyn Fn() + Sync)) -> Result<Outcome, Error> {
    campaign::total("run", count, done, |index| one(fault, seed, index), Outcome::add)
}

/// Runs number `index` of a fault.
pub fn one(fault: Fault, seed: u64, index: u64) -> Result<Outcome, Error> {
    let mut rng = StdRng::seed_from_u64(seed ^ (index << 8) ^ fault as u64);
    let case = Case::random(&mut rng);
    let mut run = Run::new(fault, &case, &mut rng)?;
    run.through(&mut rng)?;
    let mut outcome = run.outcome();
    for broken in &mut outcome.broken {
        *broken = format!("{}, run {index}: {broken}", fault.name());
    }
    Ok(outcome)
}

struct Run<'a> {
    fault: Fault,
    case: &'a Case,
    board: Board,
    watch: Watch,
    plant: Plant,
    servo: Odrive,
    encoder: Encoder,
    /// Position that the encoder read last, turns of the drive.
    reading: f64,
    on: bool,
    /// Error that the drive reports.
    errors: u32,
    now: u32,
    t: f64,
    /// Tick at which the fault begins.
    begin: u32,
    injected: u64,
    /// Setpoint of the hub at the last tick, rad, and where a stop began, with its rate.
    setpoint: f64,
    stopped_from: Option<(f64, f64)>,
    behind: f64,
    /// Torques that were cut to their frame.
    cut: u64,
    rest: Rest,
    broken: Vec<String>,
}

impl<'a> Run<'a> {
    fn new(fault: Fault, case: &'a Case, rng: &mut StdRng) -> Result<Self, Error> {
        let configuration = &case.configuration;
        let mut parts = case.parts;
        if fault == Fault::Saturation {
            // The torque that the move takes at least, without friction: four fifths of it.
            let takes = case.inertia * 5.77 * case.turn.abs() / (case.duration * case.duration);
            parts.motor.torque = Some(0.8 * takes / parts.ratio());
        }
        let scene = Scene::from(configuration.scene);
        let plant = Plant::at_rest(&scene, &parts, 0.0, &OPTIONS)?;
        let most = parts.motor.torque.unwrap_or(f64::INFINITY);
        let servo = Odrive::new(case.drive, most, TICK);
        let mut run = Self {
            fault,
            case,
            board: Board::new(configuration, 0)?,
            watch: Watch::new(&configuration.policy.limits, configuration.joint.ratio, TICK),
            plant,
            encoder: Encoder::new(case.counts, case.latency, servo.interval())?,
            servo,
            reading: 0.0,
            on: false,
            errors: 0,
            now: rng.random(),
            t: 0.0,
            begin: ticks(0.05 + case.duration * rng.random_range(0.2..0.8)),
            injected: 0,
            setpoint: 0.0,
            stopped_from: None,
            behind: 0.0,
            cut: 0,
            rest: Rest::new(case, f64::from(last_tick(case)) * TICK),
            broken: Vec::new(),
        };
        run.reading = run.read();
        Ok(run)
    }

    /// Reads the encoder: turns of the drive.
    fn read(&mut self) -> f64 {
        let zero = self.case.configuration.zero;
        self.encoder.read(self.sign() * self.plant.shaft().0 + zero)
    }

    fn sign(&self) -> f64 {
        match self.case.configuration.direction {
            Direction::Same => 1.0,
            Direction::Opposite => -1.0,
        }
    }

    fn through(&mut self, rng: &mut StdRng) -> Result<(), Error> {
        self.report();
        self.board.ask(Command::Enable);
        let (duration, to) = (self.case.duration, self.case.turn);
        for k in 0..last_tick(self.case) {
            if k == ticks(0.05) {
                self.board.ask(Command::Move(PlainMove::To {
                    profile: Profile::Quintic,
                    duration,
                    to,
                }));
            }
            let faulty = k >= self.begin && self.fault != Fault::None;
            if k == self.begin && self.fault != Fault::None {
                self.injected += 1;
                self.begin_fault(rng);
            }
            if !(faulty && self.fault == Fault::LinkCut) {
                self.board.ask(Command::Heartbeat);
            }
            let cut = faulty && self.fault == Fault::BusCut;
            if !cut {
                self.report();
            } else if k == self.begin + ticks(WATCHDOG) {
                (self.on, self.errors) = (false, Errors::WATCHDOG_EXPIRED);
            }
            let missed = faulty && k == self.begin && self.fault == Fault::MissedTicks;
            let counts = if missed { PERIOD * rng.random_range(4..9) } else { PERIOD };
            self.now = self.now.wrapping_add(counts);
            // Time passes for the machine as well.
            for _ in 1..counts / PERIOD {
                self.advance()?;
            }
            let lost = faulty && self.fault == Fault::LostSetpoints && rng.random_bool(1.0 / 3.0);
            self.tick(lost || cut);
            self.advance()?;
        }
        Ok(())
    }

    fn begin_fault(&mut self, rng: &mut StdRng) {
        match self.fault {
            Fault::Stop => self.board.ask(Command::Stop),
            Fault::EncoderJump => self.encoder.jump(rng.random_range(-0.01..0.01)),
            Fault::DriveFault => (self.on, self.errors) = (false, Errors::DRIVER_FAULT),
            _ => {}
        }
    }

    /// Sends the drive's frames: its position and its heartbeat.
    fn report(&mut self) {
        let node = self.board.node();
        let estimates = EncoderEstimates { position: self.reading as f32, velocity: 0.0 };
        let heartbeat = Heartbeat::new(self.on, self.errors);
        let frames: [Option<ClassicFrame>; 2] =
            [node.estimates_frame(&estimates), node.heartbeat_frame(&heartbeat)];
        for frame in frames.iter().flatten() {
            self.board.hear_drive(frame);
        }
    }

    /// Makes a tick of the board. Its frame reaches the drive unless it is `lost`.
    fn tick(&mut self, lost: bool) {
        let Some(step) = self.board.tick(self.now) else { return };
        self.watch.see(&step);
        let enabled = step.tick.mode != Mode::Disabled;
        if enabled && !self.on && self.errors == 0 {
            self.servo.enable(self.reading);
        }
        self.on = enabled && self.errors == 0;
        if self.on && !lost {
            self.deliver(&step);
        }
        self.note_stop(&step);
    }

    /// Sends a setpoint to the drive, as the bytes of its frame. A move is refused before it begins
    /// if the rigid arm's torque does not fit; what vibration adds is cut to the frame and counted.
    fn deliver(&mut self, step: &Step) {
        let node = self.board.node();
        let frame = node.set_input_pos::<ClassicFrame>(&step.demand);
        let received = frame.filter(|f| !f.saturated.position && !f.saturated.velocity);
        self.cut += u64::from(received.as_ref().is_some_and(|f| f.saturated.torque));
        let Some(demand) = received.and_then(|f| node.demand(&f.payload)) else {
            self.broken.push(format!("a setpoint that its frame does not hold: {step:?}"));
            return;
        };
        let target = Target {
            position: demand.position.in_turns(),
            velocity: demand.velocity.into(),
            torque: demand.torque.into(),
        };
        self.servo.command(self.t, target);
    }

    /// Notes where a stop begins, and how far the hub is behind its setpoint.
    fn note_stop(&mut self, step: &Step) {
        self.setpoint = step.tick.setpoint.angle.radians();
        let stopping = matches!(step.tick.mode, Mode::Stopping | Mode::Stopped);
        if stopping && self.stopped_from.is_none() {
            self.stopped_from = Some((self.setpoint, f64::from(step.tick.setpoint.rate)));
        }
        if self.on {
            let behind = (self.plant.shown().angle - self.setpoint).abs();
            self.behind = self.behind.max(behind);
        }
    }

    /// Lets drive and machine run for a tick.
    fn advance(&mut self) -> Result<(), Error> {
        let interval = self.servo.interval();
        let updates = (TICK / interval).round() as u32;
        let sign = self.sign();
        for _ in 0..updates {
            let next = self.t + interval;
            self.reading = self.read();
            if self.on {
                let torque = sign * self.servo.update(self.t, self.reading);
                self.plant.advance(next, &Effort::Held(torque))?;
            } else {
                // A brake: it takes the hub's rate, as strongly as the rotor's inertia asks.
                let rate = self.plant.shaft().1;
                let parts = self.plant.parts();
                let rotor = parts.motor.rotor_inertia.max(1e-9);
                self.plant.advance(next, &Effort::Held(-BRAKE * rotor * rate))?;
            }
            self.t = next;
            self.rest.see(&self.plant);
        }
        Ok(())
    }
}

/// Number of the tick after a run's last.
fn last_tick(case: &Case) -> u32 {
    ticks(0.05 + case.duration + LATE + case.drive_settling() + case.settling + case.period)
}
