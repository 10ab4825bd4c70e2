//! Drive frames in both directions: demands out, payloads and reports in.

use arbitrary::{Arbitrary, Result, Unstructured};
use embedded_can::{ExtendedId, Frame, Id, StandardId};
use stillbeam::axis::Sequence;
use stillbeam::drive::{ClassicFrame, cia402 as can402, moteus as fd, odrive as simple};
use stillbeam_protocol::slcan;

use crate::values::{close, demand, double};

/// Turns below which every format gives a position back.
const FAR: f64 = 2_097_151.5;

/// ODrive: demands and axis states out, encoder estimates in.
pub fn odrive(bytes: &[u8]) {
    let _ = of_odrive(&mut Unstructured::new(bytes));
}

fn of_odrive(u: &mut Unstructured<'_>) -> Result<()> {
    let id = u8::arbitrary(u)?;
    let Ok(node) = simple::Node::new(id) else {
        assert!(id > 63);
        return Ok(());
    };
    let out = demand(u)?;
    match node.set_input_pos::<ClassicFrame>(&out) {
        None => assert!(!out.is_finite()),
        Some(encoded) => {
            assert_eq!(encoded.payload.dlc(), 8);
            let back = node.demand(&encoded.payload);
            let turns = out.position.in_turns();
            assert_eq!(back.is_some(), (turns as f32).abs() < FAR as f32, "{out:?}");
            if let Some(back) = back {
                // Half a unit of an f32's last place.
                let near = close(back.position.in_turns(), turns, turns.abs() * 1.2e-7);
                assert!(near, "{out:?}: {back:?}");
                let velocity = close(back.velocity.into(), out.velocity.into(), 0.000_502);
                let torque = close(back.torque.into(), out.torque.into(), 0.000_502);
                assert!(velocity || encoded.saturated.velocity, "{out:?}: {back:?}");
                assert!(torque || encoded.saturated.torque, "{out:?}: {back:?}");
            }
        }
    }
    while !u.is_empty() {
        let frame = frame(u)?;
        // A frame is one of ours or none.
        if let Some(estimates) = node.estimates(&frame) {
            assert!(estimates.position.is_finite() && estimates.velocity.is_finite());
            assert_eq!(node.estimates_frame(&estimates), Some(frame));
        }
        if let Some(on) = node.axis_state(&frame) {
            assert_eq!(node.set_axis_state(on), Some(frame));
        }
        if let Some(heartbeat) = node.heartbeat(&frame) {
            let said = node.heartbeat_frame::<ClassicFrame>(&heartbeat).expect("eight bytes");
            assert_eq!(node.heartbeat(&said), Some(heartbeat));
            let _ = heartbeat.condition();
        }
        let _ = (node.errors(&frame), node.clears_errors(&frame));
        if let Some(heard) = node.demand(&frame) {
            assert!(heard.is_finite());
            let said = node.set_input_pos::<ClassicFrame>(&heard).expect("finite");
            assert_eq!(node.demand(&said.payload), Some(heard));
            assert!(!said.saturated.any());
        }
        let line = slcan::encode(&frame, 59_999);
        assert_eq!(slcan::decode(line.bytes()), Some((frame, 59_999)));
    }
    Ok(())
}

/// CiA 402: PDOs out and in, SYNC.
pub fn cia402(bytes: &[u8]) {
    let _ = of_cia402(&mut Unstructured::new(bytes));
}

fn of_cia402(u: &mut Unstructured<'_>) -> Result<()> {
    let (id, increments, rated) = (u8::arbitrary(u)?, u32::arbitrary(u)?, double(u)?);
    let Ok(drive) = can402::Drive::new(id, increments, rated) else { return Ok(()) };
    let out = demand(u)?;
    match drive.encode(&out) {
        None => assert!(!out.is_finite()),
        Some(encoded) => {
            let frames = drive.rpdos::<ClassicFrame>(&encoded.payload).expect("two frames");
            assert_eq!(frames.map(|frame| frame.dlc()), [8, 2]);
            let (back, cut) = (drive.decode(&encoded.payload), encoded.saturated);
            assert!(back.is_finite(), "{out:?}: {back:?}");
            let per_turn = f64::from(increments);
            // Half an increment, and the f32s on the way.
            let turns = [back.position.in_turns(), out.position.in_turns()];
            let near = close(turns[0], turns[1], 0.5 / per_turn + 1.2e-7);
            assert!(near || cut.position, "{out:?}: {back:?}");
            let [v, w] = [f64::from(back.velocity), f64::from(out.velocity)];
            assert!(close(v, w, 0.5 / per_turn + 4e-7 * w.abs()) || cut.velocity, "{v} {w}");
            let [t, s] = [f64::from(back.torque), f64::from(out.torque)];
            let step = f64::from(drive.torque_step());
            assert!(close(t, s, 0.51 * step + 4e-7 * s.abs()) || cut.torque, "{t} {s}");
        }
    }
    let payload: [u8; 10] = u.arbitrary()?;
    assert!(drive.decode(&payload).is_finite());
    let mut power = can402::PowerDrive::default();
    for wanted in [can402::Wanted::On, can402::Wanted::Reset, can402::Wanted::Off] {
        let frame = frame(u)?;
        let _ = (drive.emergency(&frame), drive.downloaded(&frame));
        let (statusword, position, mode) = (u.arbitrary()?, u.arbitrary()?, u.arbitrary()?);
        let status = can402::Status { statusword, position, mode };
        let said = drive.status_frame::<ClassicFrame>(&status).expect("seven bytes");
        assert_eq!(drive.status(&said), Some(status));
        assert!(
            (drive.angle(position).in_turns() - f64::from(position) / f64::from(increments)).abs()
                < 1e-6
        );
        let step = power.step(&status, wanted);
        // The actual position is sent until the drive follows.
        assert!(step.hold.is_none_or(|hold| hold == position));
        assert!(step.hold.is_some() || step.controlword == 0x0f);
    }
    let (sequence, overflow) = (u16::arbitrary(u)?, u8::arbitrary(u)?);
    let sync = can402::sync::<ClassicFrame>(Sequence(sequence), overflow).expect("a frame");
    assert!((1..=overflow.clamp(2, 240)).contains(&sync.data()[0]));
    Ok(())
}

/// moteus: CAN FD payloads out and in.
pub fn moteus(bytes: &[u8]) {
    let _ = of_moteus(&mut Unstructured::new(bytes));
}

fn of_moteus(u: &mut Unstructured<'_>) -> Result<()> {
    let Ok(servo) = fd::Servo::new(u8::arbitrary(u)?, double(u)?) else { return Ok(()) };
    assert!(servo.id(true) <= 0xffff);
    let out = demand(u)?;
    match servo.encode(&out) {
        None => assert!(!out.is_finite()),
        Some(encoded) => {
            let back = servo.decode(&encoded.payload);
            let turns = out.position.in_turns();
            assert_eq!(back.is_some(), (turns as f32).abs() < FAR as f32, "{out:?}");
            if let Some(back) = back {
                let near = close(back.position.in_turns(), turns, turns.abs() * 1.2e-7);
                assert!(near && back.velocity == out.velocity && back.torque == out.torque);
            }
            // One byte of it is another.
            let mut altered = encoded.payload;
            let place = u.choose_index(altered.len())?;
            altered[place] ^= u8::arbitrary(u)?;
            if let Some(heard) = servo.decode(&altered) {
                assert!(heard.is_finite());
                // What is read is what would be written, but for the sign of zero turns.
                let said = servo.encode(&heard).expect("finite").payload;
                assert!(said == altered || altered[5..9] == [0, 0, 0, 0x80]);
            }
        }
    }
    if let Some(heard) = servo.decode(&u.arbitrary()?) {
        assert!(heard.is_finite());
    }
    let rest = u.bytes(u.len())?;
    if let Some(reply) = fd::Reply::decode(rest) {
        assert!(reply.position.is_finite() && reply.velocity.is_finite());
        let _ = reply.condition();
    }
    Ok(())
}

/// Any frame, mostly of a command that is known.
fn frame(u: &mut Unstructured<'_>) -> Result<ClassicFrame> {
    let raw = u16::arbitrary(u)? & 0x7ff;
    let raw = match u.int_in_range(0..=3)? {
        0 => raw,
        1 => raw & !0x1f | 0x07,
        2 => raw & !0x1f | 0x09,
        _ => raw & !0x1f | 0x0c,
    };
    let standard = StandardId::new(raw).unwrap_or(StandardId::ZERO);
    let extended = ExtendedId::new(raw.into()).unwrap_or(ExtendedId::ZERO);
    let id: Id = if u.ratio(1, 16)? { extended.into() } else { standard.into() };
    let length = u.int_in_range(0..=8)?;
    let frame = if u.ratio(1, 16)? {
        ClassicFrame::new_remote(id, length)
    } else {
        ClassicFrame::new(id, u.bytes(length)?)
    };
    Ok(frame.expect("eight bytes are a frame"))
}
