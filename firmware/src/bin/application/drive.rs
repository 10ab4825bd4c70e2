//! Frames to the drives and from them. ODrive CAN simple; another protocol of `stillbeam::drive`
//! goes in here.

use stillbeam::axis::{Freshness, Sequence, Tick};
use stillbeam::drive::odrive::TORQUE_STEP;
use stillbeam::drive::{ClassicFrame, TorquePeak};
use stillbeam_wiring::axes::AXES;
use stillbeam_wiring::drive::{Setpoint, Switch, demand};

use crate::board::{BusReader, BusWriter};
use crate::shared;
use crate::tick::TO_DRIVE;

/// State of the talk with one drive.
#[derive(Clone, Copy, Default)]
struct Drive {
    switch: Switch,
    sent: Option<Sequence>,
    moving: bool,
    peak: TorquePeak,
}

/// Sends every setpoint as it comes, and switches the drives.
#[embassy_executor::task]
pub async fn send(mut bus: BusWriter) {
    let mut drives = [Drive::default(); AXES];
    loop {
        let Setpoint { axis, tick, .. } = TO_DRIVE.receive().await;
        let Some(drive) = drives.get_mut(usize::from(axis)) else { continue };
        let fresh = drive.sent.is_none_or(|last| {
            matches!(tick.sequence().after(last), Freshness::Next | Freshness::Skipped(_))
        });
        if fresh {
            drive.sent = Some(tick.sequence());
            one(&mut bus, axis, &tick, drive).await;
        }
    }
}

async fn one(bus: &mut BusWriter, axis: u8, tick: &Tick<f32>, drive: &mut Drive) {
    let joint =
        shared::with(|s| s.joints.get(usize::from(axis)).map(|joint| (joint.node(), joint.train)));
    let Some((node, train)) = joint else { return };
    if let Some(demand) = demand(&train, tick) {
        // What is not finite is not sent: the drive's own watchdog is the last resort.
        let Some(encoded) = node.set_input_pos::<ClassicFrame>(&demand) else { return };
        bus.send(&encoded.payload, tick.sequence()).await;
        if encoded.saturated.any() {
            shared::with(|s| s.counters.saturated += 1);
            defmt::warn!("axis {}: saturated {}", axis, encoded.saturated);
        }
        let moving = tick.setpoint.rate != 0.0;
        if moving {
            drive.peak.note(demand.torque);
        } else if drive.moving
            && let Some(coarse) = drive.peak.finish(TORQUE_STEP)
        {
            defmt::warn!(
                "axis {}: a torque peak of {=u32} counts of the drive's format, under 100",
                axis,
                coarse.counts as u32
            );
        }
        drive.moving = moving;
    }
    if let Some(on) = drive.switch.turn(tick.mode) {
        defmt::info!("axis {}: {}", axis, tick.mode);
        if let Some(frame) = node.set_axis_state::<ClassicFrame>(on) {
            bus.send(&frame, tick.sequence()).await;
        }
    }
}

/// Takes note of what the encoders report.
#[embassy_executor::task]
pub async fn receive(mut bus: BusReader) {
    loop {
        let frame = bus.receive().await;
        for i in 0..AXES {
            // One axis at a time, so that the tick is masked no longer than one takes.
            shared::with(|s| {
                if let Some(joint) = s.joints.get_mut(i) {
                    joint.hear_drive(&frame);
                }
            });
        }
    }
}
