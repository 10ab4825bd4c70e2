//! moteus, against its documentation and its maker's own encoder.

use moteus_protocol::command::{PositionCommand, PositionFormat};
use moteus_protocol::{CanFdFrame, calculate_arbitration_id};
use proptest::prelude::*;
use stillbeam::drive::moteus::{BYTES, Servo};

use super::common::{demand, demands, not_finite};

/// By hand from the documentation: `01 00 0a` mode position, `0f 20` three floats from 0x020,
/// 0.5, 1.0, −2.0, `0d 27` one float to 0x027, 0.1 s, filled up to 24 with `50`.
#[test]
fn the_payload_is_laid_out_as_documented() {
    let servo = Servo::new(1, 0.1).unwrap();
    let payload = servo.encode(&demand(0, 0.5, 1.0, -2.0)).unwrap().payload;
    let expected = [
        [0x01, 0x00, 0x0a, 0x0f, 0x20, 0x00, 0x00, 0x00],
        [0x3f, 0x00, 0x00, 0x80, 0x3f, 0x00, 0x00, 0x00],
        [0xc0, 0x0d, 0x27, 0xcd, 0xcc, 0xcc, 0x3d, 0x50],
    ];
    assert_eq!(payload, expected.concat()[..]);
    const { assert!(BYTES <= 64) };
}

/// The documentation's identifiers: 0x8001 from 0 to 1 with a reply.
#[test]
fn identifiers_are_the_documented_ones() {
    let servo = Servo::new(1, 0.1).unwrap();
    assert_eq!((servo.id(true), servo.id(false)), (0x8001, 0x0001));
    assert_eq!(servo.id(true), calculate_arbitration_id(0, 1, 0, true));
}

#[test]
fn the_makers_own_encoder_agrees() {
    proptest!(|(d in demands(1000, 50.0, 50.0), watchdog in 0.001f32..10.0)| {
        let mut frame = CanFdFrame::new();
        let command = PositionCommand::new()
            .position(d.position.turns as f32 + d.position.part)
            .velocity(d.velocity)
            .feedforward_torque(d.torque)
            .watchdog_timeout(watchdog);
        command.serialize(&mut frame, &PositionFormat::default());
        let ours = Servo::new(1, watchdog.into()).unwrap().encode(&d).unwrap().payload;
        let written = usize::from(frame.size);
        prop_assert_eq!(&ours[..written], frame.payload());
        prop_assert!(ours[written..].iter().all(|&byte| byte == 0x50));
        prop_assert_eq!(CanFdFrame::round_up_dlc(written), BYTES);
    });
}

#[test]
fn decoding_gives_back_what_was_encoded() {
    proptest!(|(d in demands(1000, 50.0, 50.0))| {
        let servo = Servo::new(7, 0.05).unwrap();
        let back = servo.decode(&servo.encode(&d).unwrap().payload).unwrap();
        prop_assert!((back.position.in_turns() - d.position.in_turns()).abs() <= 3.1e-5);
        prop_assert_eq!((back.velocity, back.torque), (d.velocity, d.torque));
    });
}

#[test]
fn garbage_is_not_decoded_and_does_not_panic() {
    let servo = Servo::new(1, 0.1).unwrap();
    let good = servo.encode(&demand(3, 0.25, 1.0, 1.0)).unwrap().payload;
    for place in [0, 1, 2, 3, 4, 17, 18, 19, 23] {
        let mut bad = good;
        bad[place] ^= 0x40;
        assert_eq!(servo.decode(&bad), None, "byte {place}");
    }
    proptest!(|(bytes in any::<[u8; 24]>())| { let _ = servo.decode(&bytes); });
}

#[test]
fn a_nan_which_would_mean_ignore_is_not_sent() {
    let servo = Servo::new(1, 0.1).unwrap();
    for d in not_finite() {
        assert!(servo.encode(&d).is_none(), "{d:?}");
    }
}

#[test]
fn a_watchdog_of_zero_which_would_mean_the_default_is_refused() {
    let error = Servo::new(1, 0.0).unwrap_err().to_string();
    assert_eq!(error, "drive.watchdog = 0: must be 0.001 to 10 s");
}
