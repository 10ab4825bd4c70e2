//! Paths of any length through waypoints, a few rows at a time.

use stillbeam::motion::{self, Spline};

use crate::Status;
use crate::arm::{Arm, arm_argument, with_arm};
use crate::fault::Fault;
use crate::memory::{give, row};
use crate::methods::on_axis;
use crate::object::{self, Object, bytes_of};

/// Words of 8 bytes in `sb_path`.
pub const SB_PATH_WORDS: usize = 128;

/// Storage of a path.
#[repr(C)]
#[derive(Debug)]
pub struct Path {
    words: [u64; SB_PATH_WORDS],
}

/// A path as it lies in the storage.
pub(crate) struct Rows(motion::Path);

impl Object for Rows {
    const NAME: &'static str = "path";
    const MAGIC: u32 = u32::from_le_bytes(*b"SBpa");
    type Storage = Path;
}

const _: () = assert!(bytes_of::<Rows>() <= size_of::<Path>());

/// Row of a path. Where a rate is not given, the spline has the one that keeps the acceleration
/// continuous, and the last row is at rest.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Waypoint {
    /// Time from the path's beginning, s; in whole ticks or not.
    pub time: f64,
    /// Hub angle, rad.
    pub angle: f64,
    /// Rate, rad/s, if `has_rate` is not 0.
    pub rate: f64,
    /// Acceleration, rad/s^2, if `has_acceleration` is not 0; of a quintic path only.
    pub acceleration: f64,
    /// 1 if the rate is given.
    pub has_rate: u32,
    /// 1 if the acceleration is given.
    pub has_acceleration: u32,
}

/// Progress of a path.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Progress {
    /// Rows of this call that the path has taken. Offer the others again, when ticks have made
    /// room.
    pub rows: u32,
    /// 1 if the axis has the whole path, up to its last row.
    pub done: u32,
}

impl Waypoint {
    fn core(&self) -> motion::Waypoint {
        motion::Waypoint {
            time: self.time,
            angle: self.angle,
            rate: (self.has_rate != 0).then_some(self.rate),
            acceleration: (self.has_acceleration != 0).then_some(self.acceleration),
        }
    }
}

/// Initialises a path from the end of the arm's moves on. With `cubic` not 0 its pieces are cubics,
/// whose ticks are the cheapest, else quintics, whose acceleration does not jump.
///
/// # Safety
/// `path` is NULL or points to `bytes` bytes that nothing else uses during the call. `arm` as of
/// `sb_enable`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_path_init(
    path: *mut Path,
    bytes: usize,
    arm: *mut Arm,
    cubic: u32,
) -> Status {
    let spline = if cubic == 0 { Spline::Quintic } else { Spline::Cubic };
    // SAFETY: the caller's promise, for the storage and for the arm.
    unsafe {
        object::init::<Rows>(path, bytes, || {
            let arm = arm_argument(arm)?;
            Ok(Rows(arm.locked(|axis| on_axis!(axis, axis => axis.path(spline)))?))
        })
    }
}

/// Offers rows to a path, as many as it has room for, and hands those that are ready to the axis.
/// With `last` not 0 the path ends with the last of these rows. Call it again with the rows that
/// are left, or with none, while the arm moves. Behind the last row that the axis has there is
/// always a stop along the path, so that rows which come too late end in a stop.
///
/// A row that is refused is named in the error text; rows before it are kept.
///
/// # Safety
/// As of `sb_move`; `path` is NULL or points to storage of a path, `rows` is NULL or points to
/// `count` rows, `progress` is NULL or can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_waypoints(
    arm: *mut Arm,
    path: *mut Path,
    rows: *const Waypoint,
    count: usize,
    last: u32,
    progress: *mut Progress,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        with_arm(arm, |arm| {
            let Rows(path) = &mut *object::argument::<Rows>(path)?;
            let rows = row("rows", rows, count)?;
            let mut offered = 0;
            let mut result;
            loop {
                result = offer(path, rows, &mut offered, last != 0);
                if result.is_err() {
                    break;
                }
                let advanced = arm.locked(|axis| on_axis!(axis, axis => axis.advance(path)));
                result = advanced.map(drop).map_err(Fault::from);
                if result.is_err() || offered == rows.len() || !path.has_room() {
                    break;
                }
            }
            let done = u32::from(path.is_done());
            give(progress, Progress { rows: offered as u32, done });
            result
        })
    }
}

/// Offers rows while there is room, and closes the path behind the last one.
fn offer(
    path: &mut motion::Path,
    rows: &[Waypoint],
    offered: &mut usize,
    last: bool,
) -> Result<(), Fault> {
    while let Some(row) = rows.get(*offered).filter(|_| path.has_room()) {
        path.offer(row.core())?;
        *offered += 1;
    }
    if last && *offered == rows.len() {
        path.close();
    }
    Ok(())
}
