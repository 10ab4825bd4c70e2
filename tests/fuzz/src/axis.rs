//! Commands, ticks and a drive's reports in any order, into an axis under its policy.

use arbitrary::{Arbitrary, Result, Unstructured};
use embedded_can::{Frame, StandardId};
use stillbeam::axis::Mode;
use stillbeam::drive::ClassicFrame;
use stillbeam::motion::BULGE;
use stillbeam::{Payload, PlainMove, Profile};
use stillbeam_board::machine::{CONFIGURATIONS, SILENCE, TICK, ticks};
use stillbeam_board::{Board, Drive, PERIOD, Watch};
use stillbeam_protocol::frame::{MAX, encode};
use stillbeam_protocol::{Command, Request};

use crate::values::double;

/// Ticks an input may last: 20 s.
const TICKS: u32 = ticks(20.0);

/// Setpoints keep what [`Watch`] promises, and the axis rests once its host is silent.
pub fn axis(bytes: &[u8]) {
    // A script that ends is not a fault of the axis.
    let _ = script(&mut Unstructured::new(bytes));
}

struct Bench {
    board: Board,
    watch: Watch,
    drive: Drive,
    now: u32,
    ticks: u32,
}

fn script(u: &mut Unstructured<'_>) -> Result<()> {
    let configuration = u.choose(&CONFIGURATIONS)?;
    let takes = u.int_in_range(0..=3)?;
    let limits = &configuration.policy.limits;
    let mut bench = Bench {
        board: Board::new(configuration, takes).expect("a machine"),
        watch: Watch::new(limits, configuration.joint.ratio, TICK),
        drive: Drive::at(0.125),
        now: u32::arbitrary(u)?,
        ticks: 0,
    };
    // Where the bytes end the script does; what it has begun must end well all the same.
    let result = bench.follow(u);
    bench.silence();
    result
}

impl Bench {
    fn follow(&mut self, u: &mut Unstructured<'_>) -> Result<()> {
        while !u.is_empty() && self.ticks < TICKS {
            match u.int_in_range(0..=15)? {
                0 => {
                    let length = u.int_in_range(0..=48)?;
                    self.board.receive(u.bytes(length.min(u.len()))?);
                }
                1 => self.board.hear_drive(&any_frame(u)?),
                2 => {
                    let counts = PERIOD * u.int_in_range(0..=9)? + u.int_in_range(0..=PERIOD)?;
                    self.tick(counts);
                }
                3..=6 => {
                    for _ in 0..u.int_in_range(1..=64)? {
                        self.tick(PERIOD);
                    }
                }
                7 => {
                    self.board.hear_drive(&self.drive.report(self.board.node()));
                    self.send(0, Command::Enable);
                }
                8..=9 => self.send(0, Command::Heartbeat),
                _ => {
                    let axis = u8::from(u.ratio(1, 32)?);
                    let command = command(u)?;
                    self.send(axis, command);
                }
            }
        }
        Ok(())
    }

    fn send(&mut self, axis: u8, command: Command) {
        let mut frame = [0; MAX];
        let request = Request { sequence: self.ticks as u16, axis, command };
        self.board.receive(encode(&request, &mut frame).expect("every request fits"));
    }

    fn tick(&mut self, counts: u32) {
        self.now = self.now.wrapping_add(counts);
        self.ticks += 1;
        let Some(step) = self.board.tick(self.now) else { return };
        self.watch.see(&step);
        self.drive.follow(&step);
        assert_eq!(self.watch.broken, None);
    }

    fn silence(&mut self) {
        for _ in 0..SILENCE {
            self.tick(PERIOD);
        }
        let axis = self.board.axis();
        assert!(axis.rests() && axis.mode() != Mode::Stopping, "turns on: {:?}", axis.mode());
    }
}

fn command(u: &mut Unstructured<'_>) -> Result<Command> {
    Ok(match u.int_in_range(0..=11)? {
        0 => Command::Disable,
        1 => Command::Stop,
        2 => Command::Home(double(u)?),
        3 => {
            Command::Payload(Payload { mass: double(u)?, inertia: double(u)?, offset: double(u)? })
        }
        4 => Command::Still { to: double(u)?, duration: Option::<f64>::arbitrary(u)? },
        5 => Command::Describe,
        6 => Command::Status,
        7 => Command::Enable,
        _ => Command::Move(motion(u)?),
    })
}

fn motion(u: &mut Unstructured<'_>) -> Result<PlainMove> {
    let duration = double(u)?;
    Ok(match u.int_in_range(0..=7)? {
        0 => PlainMove::SpinUp { duration, rate: double(u)? },
        1 => PlainMove::SpinUp { duration, rate: 0.0 },
        2 => PlainMove::Dwell { duration },
        3 => {
            let mut bulge = [0.0; BULGE];
            for factor in &mut bulge {
                *factor = double(u)? as _;
            }
            PlainMove::Still { duration, to: double(u)?, bulge }
        }
        _ => PlainMove::To { profile: *u.choose(&Profile::ALL)?, duration, to: double(u)? },
    })
}

fn any_frame(u: &mut Unstructured<'_>) -> Result<ClassicFrame> {
    let id = StandardId::new(u.int_in_range(0..=0x7ff)?).unwrap_or(StandardId::ZERO);
    let length = u.int_in_range(0..=8)?;
    let frame = if u.ratio(1, 8)? {
        ClassicFrame::new_remote(id, length)
    } else {
        ClassicFrame::new(id, u.bytes(length)?)
    };
    Ok(frame.expect("eight bytes are a frame"))
}
