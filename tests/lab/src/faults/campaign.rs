//! Runs an axis under a fault and counts the results.

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::axis::{Cause, Mode};
use stillbeam::drive::ClassicFrame;
use stillbeam::{PlainMove, Profile};
use stillbeam_board::machine::{CONFIGURATIONS, Configuration, SILENCE, TICK, ticks};
use stillbeam_board::{Board, Drive, PERIOD, Watch};
use stillbeam_protocol::frame::{MAX, encode};
use stillbeam_protocol::{Command, Request};

use super::line::Line;
use super::{Fault, Outcome, host, stops};
use crate::campaign;
use stillbeam_sim::error::Error;

/// Ticks of a run before the host falls silent: 8 s.
const TICKS: u32 = ticks(8.0);

/// Counts between two ticks of a burst, 20 µs.
const BURST: u32 = 20;

/// Runs every kind of fault `count` times and every stop there is, in the order of the table.
pub fn all(
    seed: u64,
    count: u64,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<(&'static str, Outcome)>, Error> {
    let mut rows = Vec::new();
    for fault in Fault::ALL {
        rows.push((fault.name(), of(fault, seed, count, done)?));
    }
    rows.push(("stop at every tick of a move", stops::all()?));
    Ok(rows)
}

/// Runs one kind of fault `count` times.
pub fn of(fault: Fault, seed: u64, count: u64, done: &(dyn Fn() + Sync)) -> Result<Outcome, Error> {
    campaign::total("run", count, done, |index| one(fault, seed, index), Outcome::add)
}

/// Runs number `index` of a kind of fault.
pub fn one(fault: Fault, seed: u64, index: u64) -> Result<Outcome, Error> {
    let mut rng = StdRng::seed_from_u64(seed ^ (index << 8) ^ fault as u64);
    let configuration = &CONFIGURATIONS[rng.random_range(0..CONFIGURATIONS.len())];
    let mut run = Run::new(fault, configuration, &mut rng)?;
    run.under_the_fault(&mut rng);
    run.in_silence();
    run.recovered();
    let mut outcome = Outcome::of(&run.board, &run.watch);
    outcome.injected = run.injected + run.line.injected;
    outcome.stops = run.stops;
    outcome.broken.extend(run.broken);
    for broken in &mut outcome.broken {
        *broken = format!("{}, run {index}: {broken}", fault.name());
    }
    Ok(outcome)
}

struct Run<'a> {
    fault: Fault,
    configuration: &'a Configuration,
    board: Board,
    watch: Watch,
    line: Line,
    drive: Drive,
    now: u32,
    /// Ticks of a burst that are still to come.
    burst: u32,
    /// Counts of the clock since the first tick, and ticks made.
    elapsed: Option<u64>,
    made: u64,
    /// Mode at the last tick.
    last: Option<Mode>,
    injected: u64,
    stops: [u64; 3],
    broken: Vec<String>,
}

impl<'a> Run<'a> {
    fn new(
        fault: Fault,
        configuration: &'a Configuration,
        rng: &mut StdRng,
    ) -> Result<Self, Error> {
        let Configuration { policy, joint, .. } = configuration;
        Ok(Self {
            fault,
            configuration,
            board: Board::new(configuration, rng.random_range(0..4))?,
            watch: Watch::new(&policy.limits, joint.ratio, TICK),
            line: Line::new(fault),
            drive: Drive::at(rng.random_range(-3.0..3.0)),
            now: rng.random(),
            burst: 0,
            elapsed: None,
            made: 0,
            last: None,
            injected: 0,
            stops: [0; 3],
            broken: Vec::new(),
        })
    }

    fn under_the_fault(&mut self, rng: &mut StdRng) {
        if self.fault == Fault::PowerUp {
            let noise: Vec<u8> = (0..rng.random_range(0..600)).map(|_| rng.random()).collect();
            self.board.receive(&noise);
            self.injected += 1;
        }
        for k in 0..TICKS {
            let limits = &self.configuration.policy.limits;
            let (commands, injected) = host::say(self.fault, limits, k, rng);
            self.injected += injected;
            for command in commands {
                self.line.send(command, k, rng);
            }
            let bytes = self.line.deliver(k);
            self.board.receive(&bytes);
            self.report(k, rng);
            let counts = self.interval(rng);
            self.tick(counts);
        }
    }

    /// Sends the drive's position, or the frame into which the fault turns it.
    fn report(&mut self, k: u32, rng: &mut StdRng) {
        let node = self.board.node();
        let frame = self.drive.report(node);
        let garbage = match self.fault {
            Fault::PowerUp => k < 6,
            Fault::Drive => rng.random_bool(0.2),
            _ => false,
        };
        if garbage {
            self.injected += 1;
            self.board.hear_drive(&altered(&frame, rng));
        } else {
            self.board.hear_drive(&frame);
        }
    }

    /// Returns the counts of the clock to the next tick.
    fn interval(&mut self, rng: &mut StdRng) -> u32 {
        if self.burst > 0 {
            self.burst -= 1;
            self.injected += 1;
            return BURST;
        }
        if self.fault == Fault::Bursts && rng.random_bool(0.03) {
            self.burst = rng.random_range(1..11);
            return PERIOD * self.burst + rng.random_range(0..PERIOD);
        }
        let (counts, chance) = match self.fault {
            Fault::LateTicks => (PERIOD + rng.random_range(0..PERIOD), 0.3),
            Fault::MissedTicks => (PERIOD * rng.random_range(2..11), 0.03),
            _ => return PERIOD,
        };
        if rng.random_bool(chance) {
            self.injected += 1;
            return counts;
        }
        PERIOD
    }

    /// Makes a tick, `counts` of the clock after the one before.
    fn tick(&mut self, counts: u32) {
        let stopped = |mode| matches!(mode, Mode::Stopping | Mode::Stopped);
        let before = self.last;
        self.now = self.now.wrapping_add(counts);
        let elapsed = self.elapsed.map_or(0, |elapsed| elapsed + u64::from(counts));
        self.elapsed = Some(elapsed);
        let Some(step) = self.board.tick(self.now) else { return };
        self.made += 1;
        // The path never runs ahead of time: one tick at the beginning, one a period, to the
        // nearest.
        let period = u64::from(PERIOD);
        if self.made > 1 + (elapsed + period / 2) / period {
            self.broken.push(format!("{} ticks made in {elapsed} µs", self.made));
        }
        self.watch.see(&step);
        self.drive.follow(&step);
        if stopped(step.tick.mode) && !before.is_some_and(stopped) {
            let index = match self.board.axis().cause() {
                Some(Cause::LinkLost) => 1,
                Some(Cause::MissedTicks) => 2,
                _ => 0,
            };
            self.stops[index] += 1;
        }
        self.last = Some(step.tick.mode);
    }

    /// Checks that the axis comes to rest while the host is silent.
    fn in_silence(&mut self) {
        for _ in 0..SILENCE {
            self.tick(PERIOD);
        }
        if !self.board.axis().rests() || self.board.axis().mode() == Mode::Stopping {
            let mode = self.board.axis().mode();
            self.broken.push(format!("turns after {SILENCE} ticks of silence: {mode:?}"));
        }
    }

    /// Checks, after the fault, that the axis can be switched on again and follows a move.
    fn recovered(&mut self) {
        let frame = self.drive.report(self.board.node());
        self.board.hear_drive(&frame);
        // Whatever has come of a frame, a zero ends it.
        self.board.receive(&[0]);
        let garbled = self.board.garbled;
        let lost = |board: &Board| board.axis().generator().hub().angle.radians().abs() > 9e5;
        if matches!(self.fault, Fault::Payload | Fault::Nonsense) {
            // The drive's frames need not carry the torque that another payload takes.
            self.send(Command::Payload(self.configuration.scene.payload));
        }
        self.well(false);
        self.send(Command::Enable);
        if lost(&self.board) {
            // Garbage took it further than a move can name: it is told where it is.
            self.send(Command::Disable);
            self.send(Command::Home(0.0));
            if let Some(order) = self.board.take_order() {
                self.drive.obey(order);
            }
            let frame = self.drive.report(self.board.node());
            self.board.hear_drive(&frame);
            self.send(Command::Enable);
        }
        let from = self.board.axis().generator().hub().angle.radians();
        let to = if from > 0.0 { from - 0.7 } else { from + 0.7 };
        self.send(Command::Move(PlainMove::To { profile: Profile::Quintic, duration: 1.5, to }));
        for k in 0..160 {
            if k % 10 == 0 {
                self.well(true);
            }
            self.send(Command::Heartbeat);
            self.tick(PERIOD);
        }
        let angle = self.board.axis().generator().hub().angle.radians();
        let mode = self.board.axis().mode();
        let arrived = mode == Mode::Enabled && (angle - to).abs() < 1e-6;
        if !arrived || garbled != self.board.garbled {
            self.broken
                .push(format!("does not go on: {mode:?} at {angle} rad, {to} rad asked for"));
        }
    }

    /// Lets the drive say that it is well, where an altered frame may have said otherwise.
    fn well(&mut self, on: bool) {
        let heartbeat = self.drive.heartbeat(self.board.node(), on);
        if let (Fault::Drive | Fault::PowerUp, Some(frame)) = (self.fault, heartbeat) {
            self.board.hear_drive(&frame);
        }
    }

    /// Sends a command over a line without faults.
    fn send(&mut self, command: Command) {
        let mut frame = [0; MAX];
        // Every request fits.
        if let Ok(bytes) = encode(&Request { sequence: 0, axis: 0, command }, &mut frame) {
            self.board.receive(bytes);
        }
    }
}

/// Alters a frame: another identifier, other bytes, fewer bytes, or a request for them.
fn altered(frame: &ClassicFrame, rng: &mut StdRng) -> ClassicFrame {
    use embedded_can::{Frame, StandardId};
    let id = match rng.random_range(0..3) {
        0 => StandardId::new(rng.random_range(0..0x800)).map_or(frame.id(), Into::into),
        _ => frame.id(),
    };
    let mut data: Vec<u8> = frame.data().to_vec();
    match rng.random_range(0..4) {
        0 => data.truncate(rng.random_range(0..8)),
        1 => data.iter_mut().for_each(|byte| *byte = rng.random()),
        2 => return ClassicFrame::new_remote(id, 8).unwrap_or(*frame),
        _ => {
            let special = [f32::NAN, f32::INFINITY, f32::MAX, -2.0e6, 3.0e6];
            let value = special[rng.random_range(0..special.len())];
            data.splice(..4, value.to_le_bytes());
        }
    }
    ClassicFrame::new(id, &data).unwrap_or(*frame)
}
