//! CAN frames as text.

use embedded_can::{ExtendedId, Frame, StandardId};
use proptest::prelude::*;
use stillbeam::drive::ClassicFrame;
use stillbeam_protocol::slcan::{decode, encode};

/// From the CANUSB manual: `t10021133` is identifier 0x100 with the bytes 0x11, 0x33; here with a
/// stamp.
#[test]
fn lines_are_the_manuals() {
    let frame = ClassicFrame::new(StandardId::new(0x100).unwrap(), &[0x11, 0x33]).unwrap();
    assert_eq!(encode(&frame, 0xea5f).bytes(), b"t10021133EA5F\r");
    let frame = ClassicFrame::new(ExtendedId::new(0x123).unwrap(), &[]).unwrap();
    assert_eq!(encode(&frame, 1).bytes(), b"T0000012300001\r");
    let frame = ClassicFrame::new_remote(StandardId::new(0x7ff).unwrap(), 8).unwrap();
    assert_eq!(encode(&frame, 0).bytes(), b"r7FF80000\r");
}

#[test]
fn every_frame_comes_back() {
    let data = prop::collection::vec(any::<u8>(), 0..=8);
    proptest!(|(id in 0u32..1 << 29, long in any::<bool>(), remote in any::<bool>(), data in data, stamp in any::<u16>())| {
        let id: embedded_can::Id = if long {
            ExtendedId::new(id).unwrap().into()
        } else {
            StandardId::new(id as u16 & 0x7ff).unwrap().into()
        };
        let frame = if remote {
            ClassicFrame::new_remote(id, data.len())
        } else {
            ClassicFrame::new(id, &data)
        };
        let frame = frame.unwrap();
        prop_assert_eq!(decode(encode(&frame, stamp).bytes()), Some((frame, stamp)));
    });
}

#[test]
fn garbage_is_no_frame_and_no_panic() {
    for bad in
        ["", "t", "t80000000", "t1009", "t1001G10000", "t100111000", "x1000", "t1000\u{e9}000"]
    {
        assert_eq!(decode(bad.as_bytes()), None, "{bad}");
    }
    proptest!(|(bytes in prop::collection::vec(any::<u8>(), 0..40))| { let _ = decode(&bytes); });
}
