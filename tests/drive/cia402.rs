//! CiA 402 cyclic synchronous position, bytes by hand from the object descriptions.

use embedded_can::{Frame, Id, StandardId};
use proptest::prelude::*;
use stillbeam::axis::Sequence;
use stillbeam::drive::cia402::{Drive, InterpolationPeriod, sync};
use stillbeam::drive::{ClassicFrame, Saturated};

use super::common::{demand, demands, not_finite};

fn drive() -> Drive {
    Drive::new(3, 10_000, 2.0).unwrap()
}

fn id(frame: &ClassicFrame) -> u16 {
    match frame.id() {
        Id::Standard(id) => id.as_raw(),
        Id::Extended(_) => panic!("CANopen identifiers have 11 bits"),
    }
}

/// −1.25 turns = −12,500 = 0xFFFFCF2C; 0.5 turn/s = 5,000 = 0x1388; 0.3 N m of 2 = 150 ‰ = 0x0096.
#[test]
fn objects_stand_in_the_order_of_their_indices() {
    let encoded = drive().encode(&demand(-1, -0.25, 0.5, 0.3)).unwrap();
    assert_eq!(encoded.payload, [0x2c, 0xcf, 0xff, 0xff, 0x88, 0x13, 0x00, 0x00, 0x96, 0x00]);
    assert!(!encoded.saturated.any());
}

#[test]
fn over_classic_can_it_is_two_rpdos() {
    let payload = drive().encode(&demand(-1, -0.25, 0.5, 0.3)).unwrap().payload;
    let [first, second] = drive().rpdos::<ClassicFrame>(&payload).unwrap();
    assert_eq!((id(&first), id(&second)), (0x203, 0x303));
    assert_eq!([first.data(), second.data()].concat(), payload);
}

/// 10 × 10⁻³ s: sub-index 1 = 10, sub-index 2 = −3 = 0xFD; expedited download of one byte.
#[test]
fn the_interpolation_period_is_ten_milliseconds() {
    let period = InterpolationPeriod::new(0.010).unwrap();
    let [value, index] = drive().interpolation_period::<ClassicFrame>(period).unwrap();
    assert_eq!((id(&value), id(&index)), (0x603, 0x603));
    assert_eq!(value.data(), [0x2f, 0xc2, 0x60, 0x01, 0x0a, 0, 0, 0]);
    assert_eq!(index.data(), [0x2f, 0xc2, 0x60, 0x02, 0xfd, 0, 0, 0]);
}

/// Sub-index 1 × 10^(sub-index 2) s is the tick, in milliseconds where these are whole.
#[test]
fn every_tick_that_a_drive_can_take_is_told_exactly() {
    let told = [
        (0.001, 1, -3),
        (0.255, 255, -3),
        (0.0025, 25, -4),
        (0.000_125, 125, -6),
        (0.000_25, 25, -5),
        (0.3, 30, -2),
        (2.0, 200, -2),
        (200.0, 200, 0),
    ];
    for (tick, value, index) in told {
        let period = InterpolationPeriod::new(tick).unwrap();
        let frames = drive().interpolation_period::<ClassicFrame>(period).unwrap();
        let [first, second] = [frames[0].data()[4], frames[1].data()[4]];
        assert_eq!((first, second as i8), (value, index), "{tick} s");
    }
}

#[test]
fn a_tick_that_no_drive_can_take_is_refused() {
    let error = |tick| InterpolationPeriod::new(tick).unwrap_err().to_string();
    assert_eq!(
        error(1.0 / 3000.0),
        "drive.interpolation_period = 0.0003333333333333333: must be 0.00033 s"
    );
    assert_eq!(error(0.0), "drive.interpolation_period = 0: must be 0.000001 to 255 s");
    assert!(error(f64::NAN).starts_with("drive.interpolation_period = NaN"));
}

#[test]
fn the_mode_is_cyclic_synchronous_position() {
    let frame = drive().cyclic_synchronous_position::<ClassicFrame>().unwrap();
    assert_eq!(frame.data(), [0x2f, 0x60, 0x60, 0x00, 0x08, 0, 0, 0]);
}

#[test]
fn the_sync_counts_from_one_to_its_overflow() {
    let counter = |n| sync::<ClassicFrame>(Sequence(n), 240).unwrap();
    assert_eq!(counter(0).id(), Id::Standard(StandardId::new(0x080).unwrap()));
    assert_eq!([0, 1, 239, 240].map(|n| counter(n).data()[0]), [1, 2, 240, 1]);
}

#[test]
fn decoding_gives_back_what_was_encoded_to_half_a_count() {
    proptest!(|(d in demands(200_000, 1000.0, 60.0))| {
        let encoded = drive().encode(&d).unwrap();
        prop_assert!(!encoded.saturated.any());
        let back = drive().decode(&encoded.payload);
        let turned = back.position.in_turns() - d.position.in_turns();
        prop_assert!(turned.abs() <= 0.5e-4 + 1e-7, "{turned} turns, however many are gone");
        prop_assert!((back.velocity - d.velocity).abs() <= 0.5e-4 + 1e-4);
        prop_assert!((back.torque - d.torque).abs() <= 0.001_01);
    });
}

#[test]
fn every_payload_round_trips_to_the_bit() {
    // Beyond 2²³ increments a second an f32 does not resolve single ones.
    proptest!(|(p in any::<i32>(), v in -4_000_000i32..4_000_000, t in any::<i16>())| {
        let bytes: Vec<u8> =
            [&p.to_le_bytes()[..], &v.to_le_bytes()[..], &t.to_le_bytes()[..]].concat();
        let payload: [u8; 10] = bytes.try_into().unwrap();
        prop_assert_eq!(drive().encode(&drive().decode(&payload)).unwrap().payload, payload);
    });
}

#[test]
fn saturation_is_reported() {
    let over = drive().encode(&demand(214_749, 0.0, 2.2e5, -65.54)).unwrap();
    assert_eq!(over.saturated, Saturated { position: true, velocity: true, torque: true });
    let limits = [&i32::MAX.to_le_bytes()[..], &i32::MAX.to_le_bytes(), &i16::MIN.to_le_bytes()];
    assert_eq!(over.payload, limits.concat()[..]);
    // 2³¹ − 3,648 increments still fit.
    assert!(!drive().encode(&demand(214_748, 0.0, 2.1e5, 65.5)).unwrap().saturated.any());
}

#[test]
fn what_is_not_finite_is_not_sent() {
    for d in not_finite() {
        assert!(drive().encode(&d).is_none(), "{d:?}");
    }
}

#[test]
fn a_broadcast_node_is_refused() {
    let error = Drive::new(0, 10_000, 2.0).unwrap_err().to_string();
    assert_eq!(error, "drive.node = 0: must be 1 to 127");
}
