//! The arm: its storage, its initialisation, its change of payload.

use crate::Status;
use crate::fault::Fault;
use crate::memory::{row, structure, versioned};
use crate::methods::AnyAxis;
use crate::object::{self, Object, bytes_of};
use crate::scene::Scene;
use crate::setup::{Lock, Setup};

/// Words of 8 bytes in `sb_arm`.
pub const SB_ARM_WORDS: usize = 416;

/// Storage of an arm under its policy. Its content is not for the caller. It may be static, on a
/// stack or in a heap, and need not be initialised to anything.
#[repr(C)]
#[derive(Debug)]
pub struct Arm {
    words: [u64; SB_ARM_WORDS],
}

/// An arm as it lies in the storage.
pub(crate) struct Body {
    lock: Lock,
    axis: AnyAxis,
}

impl Object for Body {
    const NAME: &'static str = "arm";
    const MAGIC: u32 = u32::from_le_bytes(*b"SBax");
    type Storage = Arm;
}

const _: () = assert!(bytes_of::<Body>() <= size_of::<Arm>());

impl Body {
    fn new(axis: AnyAxis, setup: &Setup) -> Self {
        Self { lock: setup.lock(), axis }
    }

    /// The axis, for a caller that has the arm to itself.
    #[inline(always)]
    pub(crate) fn axis(&mut self) -> &mut AnyAxis {
        &mut self.axis
    }
}

/// An arm that an interrupt may use between any two instructions, but for those under its lock.
pub(crate) struct Shared(*mut Body);

impl Shared {
    /// Works on the axis with the tick kept out.
    pub(crate) fn locked<R>(&self, work: impl FnOnce(&mut AnyAxis) -> R) -> R {
        // SAFETY: `Shared` is made of an initialised arm only, whose lock is not written again.
        let lock = unsafe { (*self.0).lock };
        // SAFETY: the lock keeps out the tick; other calls on this arm are kept out by the caller
        // of the function that made this.
        lock.hold(|| work(unsafe { &mut (*self.0).axis }))
    }
}

/// Works on an initialised arm beside its tick.
///
/// # Safety
/// `arm` is NULL or points to storage of an arm, and no other call on it but `sb_tick` runs at the
/// same time.
pub(crate) unsafe fn with_arm(
    arm: *mut Arm,
    work: impl FnOnce(&Shared) -> Result<(), Fault>,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe { object::with::<Body>(arm, |body| work(&Shared(body))) }
}

/// Finds an arm that is an argument beside the object that a call is made on.
///
/// # Safety
/// As of [`with_arm`].
pub(crate) unsafe fn arm_argument(arm: *mut Arm) -> Result<Shared, Fault> {
    // SAFETY: the caller's promise.
    unsafe { object::argument::<Body>(arm) }.map(Shared)
}

/// Initialises an arm from constants that `stillbeam-sim export --c` has written. It is disabled
/// then, at hub angle 0.
///
/// `bytes` is the size of the storage, `sizeof(sb_arm)`; less will do for some methods.
/// `setup.tick` must be the tick of the export, to the bit.
///
/// # Safety
/// `arm` is NULL or points to `bytes` bytes, `words` is NULL or points to `count` words, `setup` is
/// NULL or points to a structure of the version that its first field names. Nothing else uses the
/// storage during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_init(
    arm: *mut Arm,
    bytes: usize,
    words: *const u32,
    count: usize,
    setup: *const Setup,
) -> Status {
    // SAFETY: the caller's promise, for the storage and for each pointer.
    unsafe {
        object::init::<Body>(arm, bytes, || {
            let setup = versioned(setup)?;
            Ok(Body::new(AnyAxis::load(row("words", words, count)?, setup)?, setup))
        })
    }
}

/// Initialises an arm from its description, by `setup.method`. The same numbers come out as on the
/// desktop, after 10^5 to 10^8 instructions on a processor without double precision.
///
/// # Safety
/// As of `sb_init`; `scene` is NULL or points to a scene.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_init_scene(
    arm: *mut Arm,
    bytes: usize,
    scene: *const Scene,
    setup: *const Setup,
) -> Status {
    // SAFETY: the caller's promise, for the storage and for each pointer.
    unsafe {
        object::init::<Body>(arm, bytes, || {
            let setup = versioned(setup)?;
            let axis = AnyAxis::set_up(&structure("scene", scene)?.arm(), setup)?;
            Ok(Body::new(axis, setup))
        })
    }
}

/// Takes up another payload: the arm goes on as `other`, which was initialised for it, in the mode
/// and at the angle in which it is. Only while the hub rests and no move waits. `other` may be used
/// again or given up.
///
/// # Safety
/// `arm` and `other` are NULL or point to storage of arms; no other call on them but `sb_tick` of
/// `arm` runs at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_payload(arm: *mut Arm, other: *mut Arm) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        with_arm(arm, |arm| {
            let other = arm_argument(other)?;
            if core::ptr::eq(arm.0, other.0) {
                return Ok(());
            }
            // Two arms, of which the other has no tick now.
            arm.locked(|axis| axis.replace(&(*other.0).axis))
        })
    }
}
