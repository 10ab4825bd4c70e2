//! Moves after which the arm is at rest: a planner of its own, which several arms may share.

use stillbeam::prepared::Prepared;

use crate::Status;
use crate::arm::{Arm, with_arm};
use crate::fault::Fault;
use crate::memory::{give, row, structure, versioned};
use crate::methods::on_axis;
use crate::motion::Accepted;
use crate::object::{self, Object, bytes_of};
use crate::scene::Scene;
use crate::setup::Setup;

/// Words of 8 bytes in `sb_planner`.
pub const SB_PLANNER_WORDS: usize = 320;

/// Storage of a planner of still moves.
#[repr(C)]
#[derive(Debug)]
pub struct Planner {
    words: [u64; SB_PLANNER_WORDS],
}

/// A planner as it lies in the storage.
pub(crate) struct Still(stillbeam::planner::Planner<f32, 2>);

impl Object for Still {
    const NAME: &'static str = "planner";
    const MAGIC: u32 = u32::from_le_bytes(*b"SBpl");
    type Storage = Planner;
}

const _: () = assert!(bytes_of::<Still>() <= size_of::<Planner>());

impl Still {
    /// Adds the limits of torque and moment.
    fn new(planner: stillbeam::planner::Planner<f32, 2>, setup: &Setup) -> Result<Self, Fault> {
        match setup.loads() {
            (None, None) => Ok(Self(planner)),
            (torque, moment) => Ok(Self(planner.with_load_limits(torque, moment)?)),
        }
    }
}

/// Initialises a planner of still moves from the constants of `stillbeam-sim export --c --still`.
/// `setup` is that of the arm.
///
/// # Safety
/// As of `sb_init`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_planner_init(
    planner: *mut Planner,
    bytes: usize,
    words: *const u32,
    count: usize,
    setup: *const Setup,
) -> Status {
    // SAFETY: the caller's promise, for the storage and for each pointer.
    unsafe {
        object::init::<Still>(planner, bytes, || {
            let setup = versioned(setup)?;
            Still::new(Prepared::load(row("words", words, count)?, setup.tick)?, setup)
        })
    }
}

/// Initialises a planner of still moves from the description of an arm.
///
/// # Safety
/// As of `sb_init_scene`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_planner_init_scene(
    planner: *mut Planner,
    bytes: usize,
    scene: *const Scene,
    setup: *const Setup,
) -> Status {
    use stillbeam::planner::Planner;
    // SAFETY: the caller's promise, for the storage and for each pointer.
    unsafe {
        object::init::<Still>(planner, bytes, || {
            let setup = versioned(setup)?;
            let scene = structure("scene", scene)?.arm();
            let planner = if setup.spread == 0.0 {
                Planner::new(&scene, setup.tick)?
            } else {
                Planner::robust(&scene, setup.tick, setup.spread)?
            };
            Still::new(planner, setup)
        })
    }
}

/// Plans a move to the hub angle `to`, rad, after which the arm is at rest, in `duration` s, or
/// with 0 in the shortest time within the limits; then puts it behind the others. Takes 10^5 to
/// 10^8 instructions, all but some hundred of them with `sb_tick` let in.
///
/// # Safety
/// As of `sb_move`; `planner` is NULL or points to storage of a planner that no other call uses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_still(
    arm: *mut Arm,
    planner: *mut Planner,
    to: f64,
    duration: f64,
    accepted: *mut Accepted,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        with_arm(arm, |arm| {
            let Still(planner) = &*object::argument::<Still>(planner)?;
            let context = arm.locked(|axis| on_axis!(axis, axis => axis.plan_context()))?;
            let duration = if duration == 0.0 { None } else { Some(duration) };
            let planned = context.plan_still(planner, to, duration)?;
            let begins = arm.locked(|axis| on_axis!(axis, axis => axis.take(&planned)))?;
            give(accepted, Accepted { begins, ticks: planned.summary().ticks });
            Ok(())
        })
    }
}
