//! Frames of the command protocol: there and back, garbled, cut, reordered, duplicated.

use proptest::prelude::*;
use stillbeam::axis::{Cause, Mode, Policy, StopLimits, Tick};
use stillbeam::motion::{Spline, Waypoint};
use stillbeam::motor::{Direction, Joint};
use stillbeam::{Angle, Hub, Limits, Link, Payload, PlainMove, Profile, Setpoint, UniformScene};
use stillbeam_protocol::frame::{Garbled, MAX, Splitter, decode, encode};
use stillbeam_protocol::{Change, Command, Description, Refusal, Report, Request, Sample, Status};

fn profiles() -> impl Strategy<Value = Profile> {
    prop::sample::select(Profile::ALL.to_vec())
}

fn commands() -> impl Strategy<Value = Command> {
    let any = any::<f64>;
    let moves = prop_oneof![
        (profiles(), any(), any()).prop_map(|(profile, duration, to)| PlainMove::To {
            profile,
            duration,
            to
        }),
        (any(), any()).prop_map(|(duration, rate)| PlainMove::SpinUp { duration, rate }),
        any().prop_map(|duration| PlainMove::Dwell { duration }),
    ];
    prop_oneof![
        Just(Command::Heartbeat),
        Just(Command::Enable),
        Just(Command::Disable),
        Just(Command::Stop),
        Just(Command::Describe),
        Just(Command::Status),
        (any(), prop::option::of(any())).prop_map(|(to, duration)| Command::Still { to, duration }),
        moves.prop_map(Command::Move),
        (any(), any()).prop_map(|(mass, inertia)| Command::Payload(Payload {
            mass,
            inertia,
            offset: 0.0
        })),
        any().prop_map(Command::Home),
        proptest::bool::ANY.prop_map(Command::Record),
        (any(), any(), any()).prop_map(|(angle, rate, duration)| {
            Command::Change(Change::Target { angle, rate, duration })
        }),
        any().prop_map(|duration| Command::Change(Change::Duration(duration))),
        prop::sample::select(Spline::ALL.to_vec()).prop_map(Command::Path),
        (any(), any(), prop::option::of(any()), prop::option::of(any()), proptest::bool::ANY)
            .prop_map(|(time, angle, rate, acceleration, last)| {
                let row = Waypoint { time, angle, rate, acceleration };
                Command::Waypoint { row, last }
            }),
        Just(Command::Change(Change::Hold)),
        Just(Command::Change(Change::Cancel)),
    ]
}

fn requests() -> impl Strategy<Value = Request> {
    (any::<u16>(), any::<u8>(), commands()).prop_map(|(sequence, axis, command)| Request {
        sequence,
        axis,
        command,
    })
}

/// The longest reports there are: every varint at its longest.
fn longest() -> [Report<'static>; 7] {
    let big = Angle { turns: i32::MIN, part: 0.5 };
    let limits = Limits {
        rate: Some(1.0),
        acceleration: Some(1.0),
        deceleration: Some(1.0),
        jerk: Some(1.0),
        torque: Some(1.0),
        moment: Some(1.0),
    };
    let direct = Joint::direct(0.05);
    let ratio = stillbeam::motor::Ratio { motor: u16::MAX, link: u16::MAX };
    [
        Report::Description {
            sequence: u16::MAX,
            description: Description {
                axes: 255,
                method: "a-method-of-24-characters",
                tick: 0.01,
                scene: UniformScene {
                    hub: Hub { radius: 1.0, inertia: 1.0, stiffness: Some(1.0) },
                    ..UniformScene::uniform(Link { length: 1.0, mass: 1.0, bending_stiffness: 1.0 })
                },
                policy: Policy {
                    limits,
                    stop: StopLimits::OF_MOVES,
                    patience: f64::MAX,
                    missed: u32::MAX,
                },
                joint: Joint { ratio, ..direct },
                direction: Direction::Opposite,
                zero: big,
                node: 255,
            },
        },
        Report::Status {
            sequence: u16::MAX,
            status: Status {
                mode: Mode::Stopped,
                cause: Some(Cause::LinkLost),
                clock: u32::MAX,
                measured: big,
                cost: u32::MAX,
                worst: u32::MAX,
                late: u32::MAX,
                missed: u32::MAX,
                early: u32::MAX,
                overruns: u32::MAX,
                dropped: u32::MAX,
                garbled: u32::MAX,
                saturated: u32::MAX,
                stack: u32::MAX,
            },
        },
        Report::Refused {
            sequence: u16::MAX,
            refusal: Refusal::Range {
                parameter: "gravity.acceleration on this payload",
                value: 1.0,
                min: 1.0,
                max: 1.0,
                unit: "N m s/rad",
            },
        },
        Report::Tick {
            axis: 255,
            tick: Tick {
                number: u32::MAX,
                mode: Mode::Stopped,
                setpoint: Setpoint {
                    angle: big,
                    rate: 1.0,
                    acceleration: 1.0,
                    torque: 1.0,
                    tip: [1.0; 2],
                },
            },
            cause: Some(Cause::MissedTicks),
        },
        Report::Recording {
            sequence: u16::MAX,
            tick: u32::MAX,
            column: "tip_angular_acceleration_rad_s2",
        },
        Report::Sample {
            axis: 255,
            sample: Sample { time: u32::MAX, hub: big, value: f32::MIN_POSITIVE },
        },
        Report::Recorded { sequence: u16::MAX, samples: u32::MAX, lost: u32::MAX },
    ]
}

#[test]
fn every_message_fits_a_frame_and_comes_back() {
    for report in longest() {
        let mut frame = [0; MAX];
        let mut bytes = encode(&report, &mut frame).expect("it fits").to_vec();
        assert_eq!(bytes.iter().filter(|&&byte| byte == 0).count(), 1, "one zero, the last");
        assert_eq!(decode(&mut bytes), Ok(report));
    }
}

#[test]
fn requests_come_back_to_the_bit() {
    proptest!(|(request in requests())| {
        let mut frame = [0; MAX];
        let mut bytes = encode(&request, &mut frame).unwrap().to_vec();
        let back: Request = decode(&mut bytes).unwrap();
        // NaN is not itself; its bytes are.
        let mut again = [0; MAX];
        let again = encode(&back, &mut again).unwrap().to_vec();
        let mut frame = [0; MAX];
        prop_assert_eq!(encode(&request, &mut frame).unwrap(), &again[..]);
    });
}

/// The wire format, by hand: sequence 1, axis 0, command 3 (stop), CRC-32/ISCSI of `01 00 03`.
#[test]
fn a_frame_is_laid_out_as_written() {
    let request = Request { sequence: 1, axis: 0, command: Command::Stop };
    let mut frame = [0; MAX];
    let bytes = encode(&request, &mut frame).unwrap();
    let mut body = vec![1, 0, 3];
    body.extend(bitwise_crc(&body).to_le_bytes());
    let mut expected = vec![0; 16];
    let n = cobs_by_hand(&body, &mut expected);
    assert_eq!(bytes, &expected[..n]);
}

/// Reflected polynomial 0x82F63B78, start and end inverted.
fn bitwise_crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0x82f6_3b78 & (crc & 1).wrapping_neg())
        })
    })
}

fn cobs_by_hand(body: &[u8], out: &mut [u8]) -> usize {
    let mut n = 0;
    for run in body.split(|&byte| byte == 0) {
        out[n] = run.len() as u8 + 1;
        out[n + 1..=n + run.len()].copy_from_slice(run);
        n += run.len() + 1;
    }
    out[n] = 0;
    n + 1
}

#[test]
fn one_altered_byte_is_noticed_wherever_it_is() {
    proptest!(|(request in requests(), place in any::<prop::sample::Index>(), flip in 1u8..)| {
        let mut frame = [0; MAX];
        let mut bytes = encode(&request, &mut frame).unwrap().to_vec();
        let place = place.index(bytes.len() - 1);
        bytes[place] ^= flip;
        prop_assert!(decode::<Request>(&mut bytes).is_err());
    });
}

#[test]
fn a_cut_frame_is_noticed() {
    proptest!(|(request in requests(), cut in any::<prop::sample::Index>())| {
        let mut frame = [0; MAX];
        let bytes = encode(&request, &mut frame).unwrap();
        let mut cut = bytes[..cut.index(bytes.len() - 1)].to_vec();
        prop_assert!(decode::<Request>(&mut cut).is_err());
    });
}

#[test]
fn garbage_is_never_a_message_and_never_a_panic() {
    proptest!(ProptestConfig::with_cases(2000), |(bytes in prop::collection::vec(any::<u8>(), 0..400))| {
        prop_assert!(decode::<Request>(&mut bytes.clone()).is_err());
        prop_assert!(decode::<Report<'_>>(&mut bytes.clone()).is_err());
    });
}

#[test]
fn a_good_checksum_over_nonsense_is_refused() {
    let mut frame = [0; MAX];
    let mut bytes = encode(&[0xffu8; 6], &mut frame).unwrap().to_vec();
    assert_eq!(decode::<Request>(&mut bytes), Err(Garbled::Content));
}

/// Frames in a stream with anything between them.
#[test]
fn the_splitter_finds_every_whole_frame_between_garbage() {
    let garbage = || prop::collection::vec(1u8.., 0..700);
    proptest!(|(list in prop::collection::vec((requests(), garbage()), 1..8))| {
        let (mut stream, mut frame) = (Vec::new(), [0; MAX]);
        for (request, garbage) in &list {
            stream.extend(garbage);
            stream.push(0);
            stream.extend(encode(request, &mut frame).unwrap());
        }
        let mut splitter = Splitter::new();
        let (mut found, mut too_long) = (Vec::new(), 0);
        for byte in stream {
            match splitter.push(byte) {
                Some(Ok(frame)) => found.extend(decode::<Request>(frame).ok()),
                Some(Err(error)) => {
                    prop_assert_eq!(error, Garbled::TooLong);
                    too_long += 1;
                }
                None => {}
            }
        }
        let sent: Vec<u16> = list.iter().map(|(request, _)| request.sequence).collect();
        prop_assert_eq!(found.iter().map(|r| r.sequence).collect::<Vec<_>>(), sent);
        prop_assert_eq!(too_long, list.iter().filter(|(_, g)| g.len() > MAX).count());
    });
}

#[test]
fn a_refusal_names_field_value_and_what_it_must_be() {
    let refusal = Refusal::from(stillbeam::Error::LimitExceeded {
        parameter: "limits.rate",
        limit: 6.0,
        needed: 7.5,
        unit: "rad/s",
    });
    assert_eq!(refusal.to_string(), "limits.rate = 7.5 rad/s: must be 0 to 6 rad/s");
    assert_eq!(Refusal::Axis(2).to_string(), "axis: must be 0 to 1");
    let mode = Refusal::Mode(Mode::Stopped).to_string();
    assert_eq!(mode, "mode = Stopped: enable the axis first");
}
