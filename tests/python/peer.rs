//! CiA 402's state machine against a node of its own: the drive of `tests/cia402.py`, on canopen's
//! stack and state tables.

use std::io::{BufRead, BufReader, Lines, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use embedded_can::{Frame, Id, StandardId};
use stillbeam::Angle;
use stillbeam::drive::cia402::{Drive, InterpolationPeriod, PowerDrive, State, Status, Wanted};
use stillbeam::drive::{ClassicFrame, Condition};
use stillbeam::motor::Demand;

use super::interpreter;

/// The node, and where it says that its shaft stands at the beginning, increments.
const NODE: u8 = 3;
const BEGIN: i32 = -123_456;

/// Increments a turn.
const INCREMENTS: u32 = 4096;

/// The drive in its interpreter.
struct Peer {
    child: Child,
    input: ChildStdin,
    output: Lines<BufReader<ChildStdout>>,
}

impl Peer {
    fn start() -> Self {
        let mut command = Command::new(interpreter::interpreter());
        command.arg("tests/cia402.py").current_dir(interpreter::PACKAGE);
        command.env("PYTHONDONTWRITEBYTECODE", "1");
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().expect("an interpreter that starts");
        let input = child.stdin.take().expect("a pipe");
        let output = BufReader::new(child.stdout.take().expect("a pipe")).lines();
        Self { child, input, output }
    }

    fn send(&mut self, frame: &ClassicFrame) {
        let Id::Standard(id) = frame.id() else { panic!("11 bits") };
        let bytes: String = frame.data().iter().map(|byte| format!("{byte:02x}")).collect();
        writeln!(self.input, "{:03x}#{bytes}", id.as_raw()).expect("a drive that listens");
    }

    fn fail(&mut self) {
        writeln!(self.input, "!").expect("a drive that listens");
    }

    /// Ends a cycle. Returns what the drive has sent in it.
    fn cycle(&mut self) -> Vec<ClassicFrame> {
        writeln!(self.input).and_then(|()| self.input.flush()).expect("a drive that listens");
        let mut frames = Vec::new();
        loop {
            let line = self.output.next().expect("a drive that answers").expect("text");
            if line.is_empty() {
                return frames;
            }
            frames.push(frame(&line));
        }
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn frame(line: &str) -> ClassicFrame {
    let (id, bytes) = line.split_once('#').expect("a frame");
    let id = u16::from_str_radix(id, 16).ok().and_then(StandardId::new).expect("11 bits");
    let byte = |at: usize| u8::from_str_radix(&bytes[at..at + 2], 16).expect("hexadecimal");
    let bytes: Vec<u8> = (0..bytes.len()).step_by(2).map(byte).collect();
    ClassicFrame::new(id, &bytes).expect("8 bytes at most")
}

/// The master with its drive.
struct Loop {
    drive: Drive,
    master: PowerDrive,
    peer: Peer,
    status: Status,
}

impl Loop {
    fn start() -> Self {
        let drive = Drive::new(NODE, INCREMENTS, 2.0).expect("a drive");
        let mut peer = Peer::start();
        let status = status(&drive, &peer.cycle());
        Self { drive, master: PowerDrive::default(), peer, status }
    }

    fn state(&self) -> Option<State> {
        State::of(self.status.statusword)
    }

    /// Makes cycles with that demand. Returns the states passed, in their order.
    fn run(&mut self, wanted: Wanted, demand: &Demand<f32>) -> Vec<State> {
        let mut passed: Vec<State> = self.state().into_iter().collect();
        for _ in 0..8 {
            let step = self.master.step(&self.status, wanted);
            let mut payload = self.drive.encode(demand).expect("finite").whole().expect("it fits");
            if let Some(held) = step.hold {
                payload[..4].copy_from_slice(&held.to_le_bytes());
            }
            let control = self.drive.control(step.controlword).expect("a frame");
            let setpoint = self.drive.rpdos(&payload).expect("frames");
            for frame in setpoint.iter().chain([&control]) {
                self.peer.send(frame);
            }
            let before = self.status.position;
            self.status = status(&self.drive, &self.peer.cycle());
            passed.extend(self.state());
            if self.state() == Some(State::OperationEnabled) && step.hold.is_some() {
                assert_eq!(self.status.position, before, "enabled with a jump");
            }
        }
        passed.dedup();
        passed
    }
}

fn status(drive: &Drive, frames: &[ClassicFrame]) -> Status {
    frames.iter().find_map(|frame| drive.status(frame)).expect("TPDO 1")
}

fn demand(turns: i32) -> Demand<f32> {
    Demand { position: Angle { turns, part: 0.25 }, velocity: 0.5, torque: -0.1 }
}

/// Enabled step by step and without a jump, it follows; a fault stays until it is reset.
#[test]
fn an_independent_cia_402_node_is_enabled_followed_and_reset() {
    use State::{Fault, OperationEnabled, ReadyToSwitchOn, SwitchOnDisabled, SwitchedOn};
    let mut bus = Loop::start();
    assert_eq!((bus.state(), bus.status.position), (Some(SwitchOnDisabled), BEGIN));
    let passed = bus.run(Wanted::On, &demand(7));
    assert_eq!(passed, [SwitchOnDisabled, ReadyToSwitchOn, SwitchedOn, OperationEnabled]);
    assert_eq!(bus.status.condition(), Condition::On);
    // 7.25 turns of 4096 increments, and as an angle again.
    assert_eq!((bus.status.position, bus.status.mode), (29_696, 8));
    assert_eq!(bus.drive.angle(bus.status.position).in_turns(), 7.25);
    bus.peer.fail();
    let passed = bus.run(Wanted::On, &demand(8));
    assert_eq!(passed, [OperationEnabled, Fault]);
    assert_eq!(bus.status.position, 29_696, "a drive that is off does not follow");
    let passed = bus.run(Wanted::Reset, &demand(8));
    assert_eq!(passed[..2], [Fault, SwitchOnDisabled]);
    let passed = bus.run(Wanted::On, &demand(8));
    assert_eq!(passed.last(), Some(&OperationEnabled));
    assert_eq!(bus.run(Wanted::Off, &demand(8)), [OperationEnabled, ReadyToSwitchOn]);
}

/// The SDO downloads of the interpolation period and of the mode are acknowledged by a server that
/// has the objects, and refused by one that does not.
#[test]
fn an_independent_sdo_server_takes_the_settings() {
    let mut bus = Loop::start();
    let period = InterpolationPeriod::new(0.000_125).expect("a tick");
    let period: [ClassicFrame; 2] = bus.drive.interpolation_period(period).expect("frames");
    let mode = bus.drive.cyclic_synchronous_position().expect("a frame");
    for frame in period.iter().chain([&mode]) {
        bus.peer.send(frame);
        let answers = bus.peer.cycle();
        let answer = answers.iter().find_map(|frame| bus.drive.downloaded(frame));
        assert_eq!(answer, Some(Ok(())), "{frame:?}");
    }
    assert_eq!(status(&bus.drive, &bus.peer.cycle()).mode, 8);
    // 0x6099 is no object of this drive: abort code 0x0602_0000.
    let id = StandardId::new(0x600 + u16::from(NODE)).expect("11 bits");
    let unknown = ClassicFrame::new(id, &[0x2f, 0x99, 0x60, 0, 1, 0, 0, 0]).expect("8 bytes");
    bus.peer.send(&unknown);
    let answers = bus.peer.cycle();
    let answer = answers.iter().find_map(|frame| bus.drive.downloaded(frame));
    assert_eq!(answer, Some(Err(0x0602_0000)));
}
