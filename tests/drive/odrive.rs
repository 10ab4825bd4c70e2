//! ODrive CAN simple, against its documentation and against another crate's encoder.

use embedded_can::{Frame, Id, StandardId};
use proptest::prelude::*;
use stillbeam::drive::odrive::{EncoderEstimates, Node, decode, encode};
use stillbeam::drive::{ClassicFrame, Saturated};

use super::common::{demand, demands, not_finite};

fn standard(id: u16) -> Id {
    Id::Standard(StandardId::new(id).unwrap())
}

/// The documentation's own example: axis 1, command 0x0C, identifier 0x2C. Bytes by hand:
/// 1.5 turns = 0x3FC00000, 2 turn/s = 2000 = 0x07D0, −0.25 N m = −250 = 0xFF06.
#[test]
fn set_input_pos_is_laid_out_as_documented() {
    let frame =
        Node::new(1).unwrap().set_input_pos::<ClassicFrame>(&demand(1, 0.5, 2.0, -0.25)).unwrap();
    assert_eq!(frame.payload.id(), standard(0x2c));
    assert_eq!(frame.payload.data(), [0x00, 0x00, 0xc0, 0x3f, 0xd0, 0x07, 0x06, 0xff]);
    assert!(!frame.saturated.any());
}

/// Frames are those of the published driver crate for the same numbers, whatever they are.
#[test]
fn another_encoder_agrees() {
    proptest!(|(node in 0u8..64, d in demands(1000, 32.0, 32.0))| {
        let theirs: ClassicFrame = odrive_messages::set_input_pos(
            node,
            d.position.turns as f32 + d.position.part,
            (f64::from(d.velocity) * 1000.0).round_ties_even() as i16,
            (f64::from(d.torque) * 1000.0).round_ties_even() as i16,
        );
        let ours = Node::new(node).unwrap().set_input_pos::<ClassicFrame>(&d).unwrap();
        prop_assert_eq!(ours.payload, theirs);
    });
}

#[test]
fn decoding_gives_back_what_was_encoded_to_half_a_count() {
    proptest!(|(d in demands(1000, 32.0, 32.0))| {
        let back = decode(&encode(&d).unwrap().payload).unwrap();
        prop_assert!((back.position.in_turns() - d.position.in_turns()).abs() <= 3.1e-5);
        // Half a count, and the f32 that it is divided in.
        prop_assert!((back.velocity - d.velocity).abs() <= 0.000_502);
        prop_assert!((back.torque - d.torque).abs() <= 0.000_502);
    });
}

#[test]
fn every_payload_round_trips_to_the_bit() {
    proptest!(|(bytes in any::<[u8; 8]>())| {
        if let Some(d) = decode(&bytes) {
            // −0.0 is 0.0 turns.
            let mut expected = bytes;
            if expected[..4] == [0, 0, 0, 0x80] {
                expected[3] = 0;
            }
            prop_assert_eq!(encode(&d).unwrap().payload, expected);
        }
    });
}

#[test]
fn rounding_is_to_nearest() {
    for (torque, counts) in [(0.0014, 1), (0.0016, 2), (-0.0016, -2), (0.000_49, 0)] {
        let payload = encode(&demand(0, 0.0, 0.0, torque)).unwrap().payload;
        assert_eq!(i16::from_le_bytes([payload[6], payload[7]]), counts, "{torque} N m");
    }
}

#[test]
fn saturation_is_reported() {
    let full = encode(&demand(0, 0.0, 32.767, -32.768)).unwrap();
    assert!(!full.saturated.any(), "the last count still fits");
    let over = encode(&demand(0, 0.0, 32.768, -32.769)).unwrap();
    assert_eq!(over.saturated, Saturated { position: false, velocity: true, torque: true });
    assert_eq!(over.payload[4..], [0xff, 0x7f, 0x00, 0x80]);
}

/// Command 0x07, u32: 8 is closed-loop control, 1 is idle.
#[test]
fn axis_states_are_the_documented_ones() {
    let node = Node::new(3).unwrap();
    for (on, state) in [(true, 8), (false, 1)] {
        let frame: ClassicFrame = node.set_axis_state(on).unwrap();
        assert_eq!((frame.id(), frame.data()), (standard(0x67), &[state, 0, 0, 0][..]));
        assert_eq!(node.axis_state(&frame), Some(on));
    }
}

#[test]
fn what_is_not_finite_is_not_sent() {
    for d in not_finite() {
        assert!(encode(&d).is_none(), "{d:?}");
    }
}

#[test]
fn a_frame_of_another_node_or_command_is_not_ours() {
    let (ours, other) = (Node::new(5).unwrap(), Node::new(6).unwrap());
    let estimates = EncoderEstimates { position: -3.25, velocity: 0.5 };
    let frame: ClassicFrame = ours.estimates_frame(&estimates).unwrap();
    assert_eq!(frame.id(), standard(5 << 5 | 0x09));
    assert_eq!(ours.estimates(&frame), Some(estimates));
    assert_eq!(other.estimates(&frame), None);
    assert_eq!(ours.demand(&frame), None);
    let request: ClassicFrame = ours.request_estimates().unwrap();
    assert!(request.is_remote_frame());
    assert_eq!(ours.estimates(&request), None, "a request carries no estimate");
}

#[test]
fn an_estimate_that_is_not_finite_is_none() {
    let node = Node::new(0).unwrap();
    let estimates = EncoderEstimates { position: f32::NAN, velocity: 0.0 };
    let frame: ClassicFrame = node.estimates_frame(&estimates).unwrap();
    assert_eq!(node.estimates(&frame), None);
}

#[test]
fn a_node_beyond_six_bits_is_refused() {
    let error = Node::new(64).unwrap_err().to_string();
    assert_eq!(error, "drive.node = 64: must be 0 to 63");
}

/// Half a turn below 2²¹ the nearest whole number has a bit more than an f32's split gives back: a
/// drive that stood there was taken to stand as far on the other side. Found by fuzzing.
#[test]
fn a_position_past_the_last_turn_is_none() {
    let estimates = |position| EncoderEstimates { position, velocity: 0.0 };
    for position in [2_097_151.8, 2_097_151.5, -2_097_151.5, 1e9, f32::INFINITY, f32::NAN] {
        assert_eq!(estimates(position).angle(), None, "{position}");
    }
    for position in [2_097_151.2_f32, -2_097_151.2, 0.5, -0.25] {
        let angle = estimates(position).angle().expect("an angle");
        assert_eq!(angle.in_turns(), f64::from(position));
    }
}
