//! Frames to the drives and from them. ODrive CAN simple; another protocol of `stillbeam::drive`
//! goes in here.

use stillbeam::Angle;
use stillbeam::axis::{Freshness, Sequence, Tick};
use stillbeam::drive::odrive::TORQUE_STEP;
use stillbeam::drive::{ClassicFrame, Condition, Lost, TorquePeak};
use stillbeam_wiring::axes::{AXES, COUNTS};
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
    let joint = shared::with(|s| {
        let joint = s.joints.get_mut(usize::from(axis))?;
        Some((joint.node(), joint.train, joint.take_order()))
    });
    let Some((node, train, order)) = joint else { return };
    if let Some(frame) = order.and_then(|order| order.frame::<ClassicFrame>(node)) {
        bus.send(&frame, tick.sequence()).await;
    }
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

/// A drive's reports as the log has been told them.
#[derive(Clone, Copy, Default)]
struct Warned {
    lost: bool,
    errors: u32,
}

/// Takes note of what the drives report of encoders and of themselves.
#[embassy_executor::task]
pub async fn receive(mut bus: BusReader) {
    let mut warned = [Warned::default(); AXES];
    loop {
        let frame = bus.receive().await;
        for (i, warned) in warned.iter_mut().enumerate() {
            // One axis at a time, so that the tick is masked no longer than one takes.
            let state = shared::with(|s| {
                let joint = s.joints.get_mut(i)?;
                joint.hear_drive(&frame);
                Some((joint.measured, joint.condition()))
            });
            if let Some((measured, condition)) = state {
                warn(i, measured, condition, warned);
            }
        }
    }
}

/// Warns of an encoder that is so far from its zero that counts are lost, and of a drive's errors,
/// once until they change.
fn warn(
    axis: usize,
    measured: Option<Angle<f32>>,
    condition: Option<Condition>,
    warned: &mut Warned,
) {
    let turns = measured.map_or(0.0, |angle| angle.turns as f32 + angle.part);
    let lost = Lost::at(turns, COUNTS).is_some();
    if lost && !warned.lost {
        defmt::warn!(
            "axis {}: {=i32} turns from the encoder's zero, where counts are lost: home it",
            axis,
            turns as i32
        );
    }
    let errors = if let Some(Condition::Fault(errors)) = condition { errors } else { 0 };
    if errors != 0 && errors != warned.errors {
        defmt::warn!("axis {}: the drive reports errors {=u32:#x}", axis, errors);
    }
    *warned = Warned { lost, errors };
}
