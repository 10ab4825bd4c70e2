//! Reports of ODrive and moteus, against other crates' encoders and decoders.

use embedded_can::Frame as _;
use moteus_protocol::CanFdFrame;
use moteus_protocol::query::{QueryFormat, QueryResult};
use odrive_messages::messages::{
    AxisState, CanMessage, CanMessageWithId, ControlMode, InputMode as TheirInputMode,
};
use proptest::prelude::*;
use stillbeam::drive::moteus::{Reply, Servo};
use stillbeam::drive::odrive::{Errors, Heartbeat, InputMode, Node};
use stillbeam::drive::{ClassicFrame, Condition};

fn sent(node: u8, message: CanMessage) -> ClassicFrame {
    CanMessageWithId { node_id: node, message }.to_frame()
}

#[test]
fn a_heartbeat_says_what_the_drive_is_at() {
    let node = Node::new(7).expect("a node");
    for (error, state, condition) in [
        (0, AxisState::Idle, Condition::Off),
        (0, AxisState::ClosedLoopControl, Condition::On),
        (0, AxisState::EncoderOffsetCalibration, Condition::Busy),
        (0x0200_0000, AxisState::Idle, Condition::Fault(0x0200_0000)),
        (1, AxisState::ClosedLoopControl, Condition::Fault(1)),
    ] {
        let frame = sent(
            7,
            CanMessage::Heartbeat {
                axis_error: error,
                axis_state: state,
                procedure_result: 0,
                trajectory_done_flag: 0,
                _reserved: 0,
            },
        );
        let heartbeat = node.heartbeat(&frame).expect("its own");
        assert_eq!(heartbeat.condition(), condition);
        assert_eq!(node.heartbeat_frame::<ClassicFrame>(&heartbeat), Some(frame));
        assert_eq!(Node::new(8).expect("a node").heartbeat(&frame), None);
    }
}

#[test]
fn errors_are_read_and_cleared() {
    let node = Node::new(9).expect("a node");
    let frame = sent(9, CanMessage::GetError { active_errors: 0x4000, disarm_reason: 0x10 });
    let read = node.errors(&frame);
    assert_eq!(read, Some(Errors { active: 0x4000, disarm_reason: 0x10 }));
    // A remote frame has the length of the data that it asks for; their crate leaves it 0.
    let theirs: ClassicFrame = odrive_messages::query_error(9);
    let ours: ClassicFrame = node.request_errors().expect("a frame");
    assert!(ours.is_remote_frame() && theirs.is_remote_frame());
    assert_eq!(ours.id(), theirs.id());
    let clear: ClassicFrame = odrive_messages::clear_errors(9, false);
    assert_eq!(node.clear_errors(), Some(clear));
    assert!(node.clears_errors(&clear));
    let heartbeat = Heartbeat { errors: 0, state: 1, procedure_result: 0 };
    assert_eq!(heartbeat.condition(), Condition::Off);
}

#[test]
fn modes_and_a_new_zero_are_as_another_encoder_has_them() {
    let node = Node::new(3).expect("a node");
    for (ours, theirs) in [
        (InputMode::Passthrough, TheirInputMode::Passthrough),
        (InputMode::Filtered, TheirInputMode::PosFilter),
    ] {
        let theirs = odrive_messages::set_controller_mode::<ClassicFrame>(
            3,
            ControlMode::PositionControl,
            theirs,
        );
        assert_eq!(node.position_control(ours), Some(theirs));
    }
    let theirs: ClassicFrame = odrive_messages::set_absolute_position(3, 1.25);
    assert_eq!(node.set_absolute_position(1.25), Some(theirs));
    assert_eq!(node.set_absolute_position::<ClassicFrame>(f32::NAN), None);
}

/// The maker's own crate reads the same reply as we do, and its own query asks for what ours does.
#[test]
fn a_reply_is_read_as_the_maker_reads_it() {
    proptest!(|(
        mode in 0i8..15,
        position in -1e4f32..1e4,
        velocity in -100f32..100.0,
        torque in -50f32..50.0,
        fault in 0i8..100,
        padding in 0usize..8,
    )| {
        let mut payload = vec![0x21, 0x00, mode as u8, 0x2f, 0x01];
        for value in [position, velocity, torque] {
            payload.extend(value.to_le_bytes());
        }
        payload.extend([0x21, 0x0f, fault as u8]);
        payload.extend(std::iter::repeat_n(0x50, padding));
        let ours = Reply::decode(&payload).expect("whole");
        let theirs = QueryResult::parse_data(&payload);
        prop_assert_eq!(ours.mode as u8, theirs.mode as u8);
        prop_assert_eq!((ours.position, ours.velocity), (theirs.position, theirs.velocity));
        prop_assert_eq!((ours.torque, ours.fault), (theirs.torque, theirs.fault));
    });
}

/// The registers that the maker's own query asks for, in other formats, are no reply of ours; a
/// count of its own and unknown registers are.
#[test]
fn replies_of_other_shapes_are_told_apart() {
    let floats = |first: u8, values: &[f32]| {
        let mut bytes = vec![0x2c, values.len() as u8, first];
        values.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
        bytes
    };
    // Mode and fault as int8, five floats from register 1 on, with their number in a byte.
    let whole = [vec![0x21, 0x00, 10], floats(1, &[0.5, 1.0, -2.0, 3.0, 4.0]), vec![0x21, 0x0f, 0]]
        .concat();
    let reply = Reply::decode(&whole).expect("whole");
    assert_eq!((reply.position, reply.velocity, reply.torque), (0.5, 1.0, -2.0));
    assert_eq!(reply.condition(), Condition::On);
    for cut in 0..whole.len() {
        assert_eq!(Reply::decode(&whole[..cut]), None, "{cut} bytes");
    }
    let not_finite = [vec![0x21, 0, 10], floats(1, &[f32::NAN, 0.0, 0.0]), vec![0x21, 15, 0]];
    assert_eq!(Reply::decode(&not_finite.concat()), None);
    let mut theirs = CanFdFrame::new();
    QueryFormat::default().serialize(&mut theirs);
    assert_eq!(Reply::decode(theirs.payload()), None, "a query is no reply");
}

#[test]
fn conditions_and_a_new_zero_of_a_servo() {
    let of = |mode, fault| Reply { mode, fault, ..Reply::default() }.condition();
    assert_eq!(of(0, 0), Condition::Off);
    assert_eq!(of(10, 0), Condition::On);
    assert_eq!(of(1, 33), Condition::Fault(33));
    assert_eq!(of(11, 0), Condition::Fault(0));
    assert_eq!(of(5, 0), Condition::Busy);
    let servo = Servo::new(1, 0.1).expect("a servo");
    // 0x0d: one float; 0x131 as a varuint; 1.0.
    assert_eq!(servo.set_position(1.0), Some([0x0d, 0xb1, 0x02, 0, 0, 0x80, 0x3f, 0x50]));
    assert_eq!(servo.stop(), [0x01, 0x00, 0x00]);
}
