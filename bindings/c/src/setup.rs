//! Tick, limits, policy and method of an arm, and how its calls keep out of the interrupt.

use core::ffi::c_void;

use stillbeam::Limits;
use stillbeam::axis::{Policy, StopLimits};

use crate::memory::Versioned;

/// Set-up of an arm. `abi`, `tick` and `acceleration` must be given; another field that is 0 is not
/// there.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// `SB_ABI`.
    pub abi: u32,
    /// Method that an arm is set up with from a scene, `SB_METHOD_...`. Constants name their own.
    pub method: i32,
    /// Control period, s; 1e-6 to 1.
    pub tick: f64,
    /// Limit of the hub's rate, rad/s.
    pub rate: f64,
    /// Limit of its acceleration, rad/s^2. Must be given: a stop takes it.
    pub acceleration: f64,
    /// Limit of its deceleration, rad/s^2; 0: that of the acceleration.
    pub deceleration: f64,
    /// Limit of its jerk, rad/s^3. With it, moves whose acceleration jumps are refused.
    pub jerk: f64,
    /// Limit of the deceleration of a stop, rad/s^2, at least that of a move; 0: that of a move.
    pub stop_deceleration: f64,
    /// Limit of the jerk of a stop, rad/s^3; 0: that of a move.
    pub stop_jerk: f64,
    /// Limit of the hub's torque, N m. Of a planner of still moves only.
    pub torque: f64,
    /// Limit of the bending moment at the clamp, N m. Of a planner of still moves only.
    pub moment: f64,
    /// Share by which the arm's frequencies may be off, 0.01 to 0.3, in a planner set up from a
    /// scene. 0: they are known.
    pub spread: f64,
    /// Greatest angle of the tip against the hub that elastica is fitted for from a scene, rad, to
    /// 2. 0: what the limit of the acceleration makes it.
    pub bend: f64,
    /// Time without `sb_heard` after which the axis stops, s. 0 waits for ever.
    pub patience: f64,
    /// Ticks in a row that may be missed before the axis stops.
    pub missed: u32,
    /// 1: elastica from a scene takes two half-steps a tick, in place of one step.
    pub fine: u32,
    /// Function that keeps `sb_tick` out from here on, as by masking its interrupt. NULL: the
    /// caller keeps other calls and `sb_tick` apart.
    pub lock: Option<extern "C" fn(context: *mut c_void)>,
    /// Function that lets `sb_tick` in again.
    pub unlock: Option<extern "C" fn(context: *mut c_void)>,
    /// Argument of both.
    pub lock_context: *mut c_void,
}

/// Method that advances an arm by one tick.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Exact kinematics in two modes: the first choice for an arm that bends.
    Elastica2 = 0,
    /// One element and Newmark's rule, the paper's scheme: the cheapest that bends.
    Newmark1 = 1,
    /// An arm that does not bend.
    Rigid = 2,
    /// Small deflections in two modes.
    Modal2 = 3,
    /// Exact kinematics in one mode.
    Elastica1 = 4,
    /// Exact kinematics in three modes.
    Elastica3 = 5,
}

// SAFETY: `repr(C)`, and `abi` is first. A pointer to a function is NULL or that of a function that
// the caller has put there; the other fields are numbers.
unsafe impl Versioned for Setup {
    const NAME: &'static str = "setup";
}

/// Pair of functions around what the interrupt must not see half done.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lock {
    lock: Option<extern "C" fn(*mut c_void)>,
    unlock: Option<extern "C" fn(*mut c_void)>,
    context: *mut c_void,
}

impl Lock {
    /// Does `work` with the tick kept out.
    pub(crate) fn hold<R>(self, work: impl FnOnce() -> R) -> R {
        if let Some(lock) = self.lock {
            lock(self.context);
        }
        let result = work();
        if let Some(unlock) = self.unlock {
            unlock(self.context);
        }
        result
    }
}

impl Setup {
    pub(crate) fn lock(&self) -> Lock {
        Lock { lock: self.lock, unlock: self.unlock, context: self.lock_context }
    }

    /// Returns the policy; its limits are those of the hub's motion.
    pub(crate) fn policy(&self) -> Policy {
        let limits = Limits {
            rate: present(self.rate),
            acceleration: present(self.acceleration),
            deceleration: present(self.deceleration),
            jerk: present(self.jerk),
            torque: None,
            moment: None,
        };
        let stop = StopLimits {
            deceleration: present(self.stop_deceleration),
            jerk: present(self.stop_jerk),
        };
        Policy { limits, stop, patience: self.patience, missed: self.missed }
    }

    /// Returns the limits of torque and moment, for a planner.
    pub(crate) fn loads(&self) -> (Option<f64>, Option<f64>) {
        (present(self.torque), present(self.moment))
    }
}

fn present(value: f64) -> Option<f64> {
    if value == 0.0 { None } else { Some(value) }
}
