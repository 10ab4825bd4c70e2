//! Requests: enable, move, re-target, hold, stop. Beside the tick, never in its interrupt.

use stillbeam::axis::{Cause, Change};
use stillbeam::{Angle, PlainMove, Profile};

use crate::Status;
use crate::arm::{Arm, with_arm};
use crate::fault::Fault;
use crate::memory::{give, structure};
use crate::methods::on_axis;

/// Greatest angle either way, rad.
const MAX_ANGLE: f64 = 1e6;

/// A move, from the end of the moves before it. Its duration is rounded to whole ticks.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Move {
    /// `SB_KIND_...`.
    pub kind: i32,
    /// Shape of a move to an angle, `SB_PROFILE_...`.
    pub profile: i32,
    /// Duration, s.
    pub duration: f64,
    /// Hub angle at the end, rad; of a move to an angle.
    pub to: f64,
    /// Rate of the hub at the end, rad/s; of a spin-up.
    pub rate: f64,
}

/// Kind of a move.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// From rest to rest at the angle `to`.
    To = 0,
    /// A smooth change of the rate to `rate`, which the hub then keeps.
    SpinUp = 1,
    /// The hub keeps its rate.
    Dwell = 2,
}

/// Shape of a move from rest to rest.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Cubic polynomial; its acceleration jumps at both ends.
    Cubic = 0,
    /// Quintic polynomial.
    Quintic = 1,
    /// Cycloid.
    Cycloid = 2,
    /// Constant acceleration, rate, deceleration; the acceleration jumps four times.
    Trapezoid = 3,
    /// Seven stretches of constant jerk.
    SCurve = 4,
}

/// A move that was accepted.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Accepted {
    /// Number of its first tick.
    pub begins: u32,
    /// Ticks that it takes.
    pub ticks: u32,
}

/// Profiles in the order of [`Shape`].
const PROFILES: [Profile; 5] =
    [Profile::Cubic, Profile::Quintic, Profile::Cycloid, Profile::Trapezoid, Profile::SCurve];

impl Move {
    fn plain(&self) -> Result<PlainMove, Fault> {
        let Self { kind, profile, duration, to, rate } = *self;
        const TO: i32 = Kind::To as i32;
        const SPIN_UP: i32 = Kind::SpinUp as i32;
        const DWELL: i32 = Kind::Dwell as i32;
        match kind {
            TO => {
                let named = usize::try_from(profile).ok().and_then(|i| PROFILES.get(i));
                let Some(&profile) = named else {
                    return Err(Fault::range("move.profile", f64::from(profile), (0.0, 4.0), ""));
                };
                Ok(PlainMove::To { profile, duration, to })
            }
            SPIN_UP => Ok(PlainMove::SpinUp { duration, rate }),
            DWELL => Ok(PlainMove::Dwell { duration }),
            _ => Err(Fault::range("move.kind", f64::from(kind), (0.0, 2.0), "")),
        }
    }
}

/// Switches on. A disabled axis begins at the measured hub angle, rad, without a step; a stopped
/// one goes on where it holds.
///
/// # Safety
/// `arm` is NULL or points to storage of an arm; no other call on it but `sb_tick` runs at the same
/// time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_enable(arm: *mut Arm, measured: f64) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        with_arm(arm, |arm| {
            let range = (-MAX_ANGLE, MAX_ANGLE);
            let angle = Angle::from_radians(Fault::check("measured", measured, range, "rad")?);
            Ok(arm.locked(|axis| on_axis!(axis, axis => axis.enable(angle.cast())))?)
        })
    }
}

/// Plans a move behind the others; with none waiting it begins at the next tick. `sb_tick` is kept
/// out for some hundred instructions, not while the move is planned.
///
/// # Safety
/// As of `sb_enable`; `motion` is NULL or points to a move, `accepted` is NULL or can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_move(
    arm: *mut Arm,
    motion: *const Move,
    accepted: *mut Accepted,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        with_arm(arm, |arm| {
            let motion = structure("move", motion)?.plain()?;
            let context = arm.locked(|axis| on_axis!(axis, axis => axis.plan_context()))?;
            let planned = context.plan::<f32>(&motion)?;
            let begins = arm.locked(|axis| on_axis!(axis, axis => axis.take(&planned)))?;
            give(accepted, Accepted { begins, ticks: planned.summary().ticks });
            Ok(())
        })
    }
}

/// Meets a target from whatever the hub does now, by a quintic, `duration` s from the latest
/// setpoint: `angle`, rad, is where the target is at that setpoint, and it turns at `rate`, rad/s.
/// All moves are dropped. `sb_tick` is kept out for some thousand instructions.
///
/// # Safety
/// As of `sb_enable`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_retarget(
    arm: *mut Arm,
    angle: f64,
    rate: f64,
    duration: f64,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        with_arm(arm, |arm| {
            let range = (-MAX_ANGLE, MAX_ANGLE);
            let angle = Angle::from_radians(Fault::check("target.angle", angle, range, "rad")?);
            let rate = Fault::check("target.rate", rate, range, "rad/s")? as f32;
            let target = Change::Target { angle: angle.cast(), rate, duration };
            Ok(arm.locked(|axis| on_axis!(axis, axis => axis.change(&target)))?)
        })
    }
}

/// Brakes along the path and holds; the axis stays enabled and takes moves. All moves are dropped.
///
/// # Safety
/// As of `sb_enable`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_hold(arm: *mut Arm) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        with_arm(arm, |arm| {
            Ok(arm.locked(|axis| on_axis!(axis, axis => axis.change(&Change::Hold)))?)
        })
    }
}

/// Brakes along the path and holds until enabled again; moves are refused. With `then_off` not 0
/// the axis is disabled as soon as it is at rest.
///
/// # Safety
/// As of `sb_enable`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_stop(arm: *mut Arm, then_off: u32) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        with_arm(arm, |arm| {
            arm.locked(|axis| {
                on_axis!(axis, axis => {
                    if then_off == 0 { axis.stop(Cause::Requested) } else { axis.disable() }
                });
            });
            Ok(())
        })
    }
}

/// Notes a valid message from whoever commands the arm: see `sb_setup.patience`.
///
/// # Safety
/// As of `sb_enable`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_heard(arm: *mut Arm) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        with_arm(arm, |arm| {
            arm.locked(|axis| on_axis!(axis, axis => axis.heard()));
            Ok(())
        })
    }
}
