//! Objects in the caller's storage: how storage is claimed, filled and found again.
//!
//! An object begins with a magic word, which is written last when it is initialised, and with the
//! reason of its latest refusal. It holds no pointer to itself, so that its bytes may be copied.

use core::ffi::c_void;
use core::mem::MaybeUninit;
use core::sync::atomic::{AtomicU32, Ordering};

use crate::Status;
use crate::fault::Fault;

/// A type that lives in the caller's storage.
pub(crate) trait Object: Sized {
    /// Name in error texts.
    const NAME: &'static str;
    /// First word of an initialised one.
    const MAGIC: u32;
    /// The storage as C sees it.
    type Storage;
}

/// First word of an object whose initialisation has failed: it holds the reason only.
const FAILED: u32 = u32::from_le_bytes(*b"SBno");

/// Magic words of all objects, for a pointer whose type is not known.
const KNOWN: [u32; 5] = [
    FAILED,
    crate::arm::Body::MAGIC,
    crate::still::Still::MAGIC,
    crate::path::Rows::MAGIC,
    crate::drive::Encoder::MAGIC,
];

/// Beginning of every object.
#[repr(C, align(8))]
struct Header {
    magic: AtomicU32,
    fault: Fault,
}

/// An object with its header.
#[repr(C, align(8))]
pub(crate) struct Held<T> {
    header: Header,
    value: MaybeUninit<T>,
}

/// Returns the bytes of storage that an object takes.
pub(crate) const fn bytes_of<T>() -> usize {
    size_of::<Held<T>>()
}

/// Initialises an object in the caller's storage.
///
/// # Safety
/// `storage` is NULL or points to `bytes` bytes that can be written and that nothing else uses
/// before this returns.
pub(crate) unsafe fn init<T: Object>(
    storage: *mut T::Storage,
    bytes: usize,
    build: impl FnOnce() -> Result<T, Fault>,
) -> Status {
    let held = storage.cast::<Held<T>>();
    if held.is_null() {
        return Status::Null;
    }
    if !held.is_aligned() {
        return Status::Alignment;
    }
    if bytes < size_of::<Header>() {
        return Status::Size;
    }
    let header = held.cast::<Header>();
    // SAFETY: aligned, and room for a header was just checked. Nothing else uses the memory.
    let header = unsafe {
        header.write(Header { magic: AtomicU32::new(FAILED), fault: Fault::None });
        &mut *header
    };
    let (given, needed) = (bytes, bytes_of::<T>());
    let built = if given < needed {
        Err(Fault::Size(T::NAME, given, needed))
    } else {
        // SAFETY: `needed` bytes are there, so that the value lies within them, behind the header.
        build().map(|value| unsafe { (&raw mut (*held).value).cast::<T>().write(value) })
    };
    match built {
        Ok(()) => {
            header.magic.store(T::MAGIC, Ordering::Release);
            Status::Ok
        }
        Err(fault) => {
            header.fault = fault;
            fault.status()
        }
    }
}

/// Finds an object in the caller's storage.
///
/// # Safety
/// `storage` is NULL or points to storage of this type, initialised or not.
unsafe fn find<T: Object>(storage: *mut T::Storage) -> Result<*mut Held<T>, Status> {
    let held = storage.cast::<Held<T>>();
    if held.is_null() {
        return Err(Status::Null);
    }
    if !held.is_aligned() {
        return Err(Status::Alignment);
    }
    // SAFETY: aligned, and storage of this type has room for a header. Its magic word is only
    // accessed as an atomic, which an interrupt may do at any time.
    let magic = unsafe { &(*held).header.magic };
    if magic.load(Ordering::Acquire) == T::MAGIC { Ok(held) } else { Err(Status::NotInitialised) }
}

/// Finds an initialised object for a call that keeps no reason of a refusal: of the tick.
///
/// # Safety
/// As of [`find`]; and nothing else uses the object's value for as long as the reference lives.
#[inline(always)]
pub(crate) unsafe fn value<'a, T: Object>(storage: *mut T::Storage) -> Result<&'a mut T, Status> {
    // SAFETY: the caller's promise.
    let held = unsafe { find::<T>(storage)? };
    // SAFETY: the magic word says that the value was written; nothing else uses it.
    Ok(unsafe { (*held).value.assume_init_mut() })
}

/// Finds an object that is an argument beside the one that a call is made on.
///
/// # Safety
/// As of [`find`].
pub(crate) unsafe fn argument<T: Object>(storage: *mut T::Storage) -> Result<*mut T, Fault> {
    // SAFETY: the caller's promise.
    match unsafe { find::<T>(storage) } {
        // SAFETY: the object is there; no reference is made.
        Ok(held) => Ok(unsafe { (&raw mut (*held).value).cast::<T>() }),
        Err(status) => Err(Fault::Argument(T::NAME, status)),
    }
}

/// Works on an object, and keeps the reason in it if that is refused. The work gets a pointer, as
/// an interrupt may use the same value.
///
/// # Safety
/// As of [`find`]; and nothing else reads or writes the reason during the call.
pub(crate) unsafe fn with<T: Object>(
    storage: *mut T::Storage,
    work: impl FnOnce(*mut T) -> Result<(), Fault>,
) -> Status {
    // SAFETY: the caller's promise.
    let held = match unsafe { find::<T>(storage) } {
        Ok(held) => held,
        Err(status) => return status,
    };
    // SAFETY: the object is there; no reference is made.
    let value = unsafe { (&raw mut (*held).value).cast::<T>() };
    match work(value) {
        Ok(()) => Status::Ok,
        Err(fault) => {
            // SAFETY: the object is there, and nothing else uses its reason.
            unsafe { (*held).header.fault = fault };
            fault.status()
        }
    }
}

/// Returns the reason that an object of any type keeps, if it is one.
///
/// # Safety
/// `object` is NULL or points to storage of an object, initialised or not, and nothing writes its
/// reason during the call.
pub(crate) unsafe fn fault(object: *const c_void) -> Option<Fault> {
    let header = object.cast::<Header>();
    if header.is_null() || !header.is_aligned() {
        return None;
    }
    // SAFETY: aligned, and the storage of any object has room for a header.
    let magic = unsafe { (*header).magic.load(Ordering::Acquire) };
    // SAFETY: one of these words is written behind a reason.
    KNOWN.contains(&magic).then(|| unsafe { (*header).fault })
}
