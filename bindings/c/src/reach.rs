//! Moves in the shortest time that bounds allow.

use stillbeam::Move;
use stillbeam::motion::optimal::Bounds;

use crate::Status;
use crate::arm::{Arm, with_arm};
use crate::fault::Fault;
use crate::memory::{give, structure};
use crate::methods::on_axis;
use crate::motion::{Accepted, Kind};

/// A move in the shortest time, from the end of the moves before it, at rest or turning. Its bounds
/// lie within the limits of the arm's set-up.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Reach {
    /// `SB_KIND_TO`: to the angle `to`. `SB_KIND_SPIN_UP`: to the rate, at any angle.
    pub kind: i32,
    /// Hub angle at the end, rad; of a move to an angle.
    pub to: f64,
    /// Rate at the end, rad/s, which the hub then keeps. 0: it comes to rest.
    pub rate: f64,
    /// Bound of the rate, rad/s. Must be given.
    pub max_rate: f64,
    /// Bound of the acceleration, rad/s^2. 0: only the jerk is bound.
    pub max_acceleration: f64,
    /// Bound of the deceleration, rad/s^2; 0: that of the acceleration.
    pub max_deceleration: f64,
    /// Bound of the jerk, rad/s^3. 0: the acceleration may jump.
    pub max_jerk: f64,
}

impl Reach {
    fn motion(&self) -> Result<Move, Fault> {
        const TO: i32 = Kind::To as i32;
        const SPIN_UP: i32 = Kind::SpinUp as i32;
        let Self { to, rate, .. } = *self;
        let bound = |value: f64| if value == 0.0 { f64::INFINITY } else { value };
        let acceleration = bound(self.max_acceleration);
        let deceleration =
            if self.max_deceleration == 0.0 { acceleration } else { self.max_deceleration };
        let jerk = bound(self.max_jerk);
        let bounds = Bounds { rate: self.max_rate, acceleration, deceleration, jerk };
        match self.kind {
            TO => Ok(Move::Reach { to, rate, bounds }),
            SPIN_UP => Ok(Move::Ramp { rate, bounds }),
            other => Err(Fault::range("reach.kind", f64::from(other), (0.0, 1.0), "")),
        }
    }
}

/// Plans a move in the shortest time behind the others, as `sb_move` does a move of given duration.
///
/// # Safety
/// As of `sb_enable`; `motion` is NULL or points to a move, `accepted` is NULL or can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_reach(
    arm: *mut Arm,
    motion: *const Reach,
    accepted: *mut Accepted,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        with_arm(arm, |arm| {
            let motion = structure("reach", motion)?.motion()?;
            let context = arm.locked(|axis| on_axis!(axis, axis => axis.plan_context()))?;
            let planned = context.plan::<f32>(&motion)?;
            let begins = arm.locked(|axis| on_axis!(axis, axis => axis.take(&planned)))?;
            give(accepted, Accepted { begins, ticks: planned.summary().ticks });
            Ok(())
        })
    }
}
