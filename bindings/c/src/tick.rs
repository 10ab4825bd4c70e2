//! The tick: the functions for the interrupt. No allocation, no panic, and no double precision but
//! for one angle of a stop that begins there.

use stillbeam::axis::{self, Cause};
use stillbeam::{Angle, HubState};

use crate::Status;
use crate::arm::{Arm, Body};
use crate::memory::give;
use crate::methods::on_axis;
use crate::object;

/// Setpoint of the hub at one tick. Its angle is `turns + part` turns: the fraction is as fine
/// after a million turns as before the first. `sb_angle` gives radians.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Setpoint {
    /// Number of the tick, from 0.
    pub number: u32,
    /// Mode of the axis at this tick, `SB_MODE_...`. The drive follows in every mode but disabled.
    pub mode: i32,
    /// Reason of the latest stop, `SB_CAUSE_...`.
    pub cause: i32,
    /// Whole turns of the hub angle.
    pub turns: i32,
    /// The rest of the hub angle, turns, -1/2 to 1/2.
    pub part: f32,
    /// Rate, rad/s.
    pub rate: f32,
    /// Acceleration, rad/s^2; where it jumps, the value after the tick.
    pub acceleration: f32,
    /// Torque into the hub, N m.
    pub torque: f32,
    /// Tip in the hub frame along the link where it is clamped, m.
    pub tip_x: f32,
    /// Tip in the hub frame across the link, its deflection, m.
    pub tip_y: f32,
}

/// Mode of an axis.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// The drive is off; setpoints stand still and are not to be sent.
    Disabled = 0,
    /// Follows moves, or holds.
    Enabled = 1,
    /// Brakes.
    Stopping = 2,
    /// Holds after a stop, until enabled again.
    Stopped = 3,
}

/// Reason why an axis stopped.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopCause {
    /// It has not stopped since it was enabled.
    None = 0,
    /// `sb_stop`.
    Requested = 1,
    /// `sb_heard` was not called for the patience.
    LinkLost = 2,
    /// More ticks in a row were missed than are allowed.
    MissedTicks = 3,
    /// No state to follow for more ticks in a row than may be missed.
    FollowLost = 4,
    /// Another reason.
    Other = 5,
}

/// State of a hub that another program moves.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct HubMotion {
    /// Whole turns of the angle.
    pub turns: i32,
    /// The rest of the angle, turns, -1/2 to 1/2.
    pub part: f32,
    /// Rate, rad/s.
    pub rate: f32,
    /// Acceleration, rad/s^2.
    pub acceleration: f32,
}

impl Setpoint {
    #[inline(always)]
    fn of(tick: &axis::Tick<f32>, cause: Option<Cause>) -> Self {
        let mode = match tick.mode {
            axis::Mode::Disabled => Mode::Disabled,
            axis::Mode::Enabled => Mode::Enabled,
            axis::Mode::Stopping => Mode::Stopping,
            axis::Mode::Stopped => Mode::Stopped,
        };
        let cause = match cause {
            None => StopCause::None,
            Some(Cause::Requested) => StopCause::Requested,
            Some(Cause::LinkLost) => StopCause::LinkLost,
            Some(Cause::MissedTicks) => StopCause::MissedTicks,
            Some(Cause::FollowLost) => StopCause::FollowLost,
            Some(_) => StopCause::Other,
        };
        let stillbeam::Setpoint { angle, rate, acceleration, torque, tip } = tick.setpoint;
        Self {
            number: tick.number,
            mode: mode as i32,
            cause: cause as i32,
            turns: angle.turns,
            part: angle.part,
            rate,
            acceleration,
            torque,
            tip_x: tip[0],
            tip_y: tip[1],
        }
    }

    /// Returns the setpoint as the core has it.
    pub(crate) fn core(&self) -> stillbeam::Setpoint<f32> {
        stillbeam::Setpoint {
            angle: Angle { turns: self.turns, part: self.part },
            rate: self.rate,
            acceleration: self.acceleration,
            torque: self.torque,
            tip: [self.tip_x, self.tip_y],
        }
    }
}

/// Writes the next setpoint. The call of the control interrupt: its work does not depend on what
/// waits, nor its speed on the flags that the caller is compiled with.
///
/// # Safety
/// `arm` is NULL or points to storage of an arm. Nothing else uses the arm during the call: see
/// `sb_setup.lock`. `setpoint` is NULL or can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_tick(arm: *mut Arm, setpoint: *mut Setpoint) -> Status {
    // SAFETY: the caller's promise.
    let body = match unsafe { object::value::<Body>(arm) } {
        Ok(body) => body,
        Err(status) => return status,
    };
    on_axis!(body.axis(), axis => {
        let tick = axis.tick();
        // SAFETY: the caller's promise.
        unsafe { give(setpoint, Setpoint::of(&tick, axis.cause())) };
    });
    Status::Ok
}

/// Writes the next setpoint of a hub that another program moves, in place of `sb_tick`. `hub` is
/// its state at this tick, NULL if none has come: the hub then keeps its acceleration, for as many
/// ticks in a row as may be missed, and stops after that. A state that no motion within the limits
/// leads to counts as none.
///
/// # Safety
/// As of `sb_tick`; `hub` is NULL or points to a state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_follow(
    arm: *mut Arm,
    hub: *const HubMotion,
    setpoint: *mut Setpoint,
) -> Status {
    if !hub.is_aligned() {
        return Status::Alignment;
    }
    // SAFETY: the caller's promise; aligned.
    let hub = unsafe { hub.as_ref() }.map(|hub| {
        let angle = Angle { turns: hub.turns, part: hub.part };
        HubState { acceleration: hub.acceleration, ..HubState::turning(angle, hub.rate) }
    });
    // SAFETY: the caller's promise.
    let body = match unsafe { object::value::<Body>(arm) } {
        Ok(body) => body,
        Err(status) => return status,
    };
    on_axis!(body.axis(), axis => {
        let tick = axis.follow(hub.as_ref());
        // SAFETY: the caller's promise.
        unsafe { give(setpoint, Setpoint::of(&tick, axis.cause())) };
    });
    Status::Ok
}

/// Notes that `ticks` ticks did not take place before the coming one; the path waits for them. More
/// than `sb_setup.missed` of them stop the axis. In the interrupt, before `sb_tick`.
///
/// # Safety
/// As of `sb_tick`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_missed(arm: *mut Arm, ticks: u32) -> Status {
    // SAFETY: the caller's promise.
    let body = match unsafe { object::value::<Body>(arm) } {
        Ok(body) => body,
        Err(status) => return status,
    };
    on_axis!(body.axis(), axis => axis.missed(ticks));
    Status::Ok
}
