//! CiA 402's state machine against a drive that is written from the profile's table of transitions,
//! with another vocabulary: numbered transitions and bit masks of the controlword.

use stillbeam::drive::cia402::{Drive, PowerDrive, State, Status, VelocityUnit, Wanted};
use stillbeam::drive::{ClassicFrame, Condition};

use super::common::demand;

/// A drive by CiA 402-2's table 4 (controlword) and its figure of transitions 0 to 16.
struct Node {
    /// Statusword pattern of the state.
    state: u16,
    before: u16,
    mode: i8,
    position: i32,
    /// Largest jump of the target at the moment the operation is enabled, increments.
    jump: i32,
}

const NOT_READY: u16 = 0x00;
const DISABLED: u16 = 0x40;
const READY: u16 = 0x21;
const SWITCHED_ON: u16 = 0x23;
const ENABLED: u16 = 0x27;
const QUICK_STOP: u16 = 0x07;
const REACTION: u16 = 0x0f;
const FAULT: u16 = 0x08;

impl Node {
    fn starting(position: i32) -> Self {
        Self { state: NOT_READY, before: 0, mode: 0, position, jump: 0 }
    }

    /// Takes a cycle's controlword, mode and target.
    fn receive(&mut self, controlword: u16, mode: i8, target: i32) {
        let is = |mask: u16, bits: u16| controlword & mask == bits;
        let shutdown = is(0x87, 0x06);
        let switch_on = is(0x8f, 0x07);
        let enable = is(0x8f, 0x0f);
        let disable_voltage = is(0x82, 0x00);
        let quick_stop = is(0x86, 0x02);
        let reset = controlword & 0x80 != 0 && self.before & 0x80 == 0;
        self.state = match self.state {
            NOT_READY => DISABLED,                              // 1
            DISABLED if shutdown => READY,                      // 2
            READY if switch_on || enable => SWITCHED_ON,        // 3
            READY if disable_voltage || quick_stop => DISABLED, // 7
            SWITCHED_ON if enable => {
                self.jump = self.jump.max((target - self.position).abs());
                ENABLED // 4
            }
            SWITCHED_ON if shutdown => READY, // 6
            SWITCHED_ON if disable_voltage || quick_stop => DISABLED, // 10
            ENABLED if switch_on => SWITCHED_ON, // 5
            ENABLED if shutdown => READY,     // 8
            ENABLED if disable_voltage => DISABLED, // 9
            ENABLED if quick_stop => QUICK_STOP, // 11
            QUICK_STOP if disable_voltage => DISABLED, // 12
            REACTION => FAULT,                // 14
            FAULT if reset => DISABLED,       // 15
            same => same,
        };
        if self.state == ENABLED {
            self.position = target;
        }
        (self.before, self.mode) = (controlword, mode);
    }

    fn status(&self) -> Status {
        // Bits of no concern to the state are set at random in real drives; here voltage and
        // remote.
        Status { statusword: self.state | 0x0210, position: self.position, mode: self.mode }
    }
}

/// Cycles of master and drive, both over frames. Returns the states passed.
fn cycles(node: &mut Node, master: &mut PowerDrive, wanted: Wanted, target: i32) -> Vec<u16> {
    let drive = Drive::new(3, 4096, 1.0).expect("a drive");
    let mut passed = vec![node.state];
    for _ in 0..12 {
        let frame: ClassicFrame = drive.status_frame(&node.status()).expect("a frame");
        let status = drive.status(&frame).expect("its own");
        let step = master.step(&status, wanted);
        let control: ClassicFrame = drive.control(step.controlword).expect("a frame");
        let [low, high, mode] = *embedded_can::Frame::data(&control) else { panic!("three bytes") };
        let sent = u16::from_le_bytes([low, high]);
        node.receive(sent, i8::from_le_bytes([mode]), step.hold.unwrap_or(target));
        if passed.last() != Some(&node.state) {
            passed.push(node.state);
        }
    }
    passed
}

#[test]
fn a_drive_is_enabled_step_by_step_and_without_a_jump() {
    let (mut node, mut master) = (Node::starting(-123_456), PowerDrive::default());
    let passed = cycles(&mut node, &mut master, Wanted::On, 777);
    assert_eq!(passed, [NOT_READY, DISABLED, READY, SWITCHED_ON, ENABLED]);
    // Enabled where it stood; the setpoints follow after it says so.
    assert_eq!(node.jump, 0);
    assert_eq!(node.position, 777);
    let passed = cycles(&mut node, &mut master, Wanted::Off, 777);
    assert_eq!(passed, [ENABLED, READY]);
}

#[test]
fn a_fault_stays_until_it_is_reset() {
    let (mut node, mut master) = (Node::starting(10), PowerDrive::default());
    cycles(&mut node, &mut master, Wanted::On, 10);
    node.state = REACTION;
    let passed = cycles(&mut node, &mut master, Wanted::On, 10);
    assert_eq!(passed, [REACTION, FAULT]);
    let passed = cycles(&mut node, &mut master, Wanted::Reset, 10);
    assert_eq!(passed[..2], [FAULT, DISABLED]);
    // A second fault needs a second rising edge.
    node.state = FAULT;
    assert_eq!(cycles(&mut node, &mut master, Wanted::Reset, 10)[..2], [FAULT, DISABLED]);
    node.position = 99;
    assert_eq!(cycles(&mut node, &mut master, Wanted::On, 99).last(), Some(&ENABLED));
    assert_eq!(node.jump, 0);
}

#[test]
fn quick_stop_and_a_wrong_mode_are_no_operation() {
    let (mut node, mut master) = (Node::starting(0), PowerDrive::default());
    cycles(&mut node, &mut master, Wanted::On, 0);
    node.state = QUICK_STOP;
    assert_eq!(cycles(&mut node, &mut master, Wanted::On, 0).last(), Some(&ENABLED));
    // In another mode the target would be something else: the operation is not enabled.
    let status = Status { statusword: SWITCHED_ON, position: 5, mode: 1 };
    let step = PowerDrive::default().step(&status, Wanted::On);
    assert_eq!((step.controlword, step.hold), (0x0007, Some(5)));
}

/// Every statusword there is has one state or none, and every state its condition.
#[test]
fn every_statusword_is_read() {
    let mut known = 0;
    for word in 0..=u16::MAX {
        let Some(state) = State::of(word) else { continue };
        known += 1;
        let condition = state.condition();
        assert_eq!(condition == Condition::On, word & 0x6f == 0x27, "{word:#06x}");
        assert_eq!(matches!(condition, Condition::Fault(_)), word & 0x48 == 0x08, "{word:#06x}");
    }
    assert!(known > 10_000, "{known}");
}

/// 60 rpm are 1 turn/s: 60 in rpm, 600 in 0.1 rpm, 4096 increments/s.
#[test]
fn the_velocity_offset_is_in_the_unit_that_the_drive_was_told() {
    let drive = Drive::new(1, 4096, 1.0).expect("a drive");
    for (unit, counts) in [
        (VelocityUnit::Increments, 4096),
        (VelocityUnit::PerMinute { decimals: 0 }, 60),
        (VelocityUnit::PerMinute { decimals: 1 }, 600),
        (VelocityUnit::PerMinute { decimals: 3 }, 60_000),
    ] {
        let drive = drive.with_velocity_unit(unit).expect("a unit");
        let payload = drive.encode(&demand(0, 0.0, 1.0, 0.0)).expect("finite").payload;
        assert_eq!(payload[4..8], i32::to_le_bytes(counts), "{unit:?}");
        assert_eq!(drive.decode(&payload).velocity, 1.0);
    }
    assert!(drive.with_velocity_unit(VelocityUnit::PerMinute { decimals: 4 }).is_err());
}

#[test]
fn emergencies_and_answers_are_read() {
    use embedded_can::{Frame, StandardId};
    let drive = Drive::new(5, 4096, 1.0).expect("a drive");
    let frame = |id: u16, data: &[u8]| {
        ClassicFrame::new(StandardId::new(id).expect("11 bits"), data).expect("8 bytes")
    };
    let emergency = drive.emergency(&frame(0x085, &[0x11, 0x86, 0x20, 0, 0, 0, 0, 0]));
    assert_eq!(emergency.map(|found| (found.code, found.register)), Some((0x8611, 0x20)));
    assert_eq!(drive.emergency(&frame(0x086, &[0; 8])), None);
    let done = frame(0x585, &[0x60, 0xc2, 0x60, 1, 0, 0, 0, 0]);
    assert_eq!(drive.downloaded(&done), Some(Ok(())));
    let abort = frame(0x585, &[0x80, 0xc2, 0x60, 1, 0x30, 0x00, 0x09, 0x06]);
    assert_eq!(drive.downloaded(&abort), Some(Err(0x0609_0030)));
}
