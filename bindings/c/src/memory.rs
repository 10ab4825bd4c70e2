//! Structures, rows and results in the caller's memory.

use crate::Status;
use crate::fault::Fault;

/// A structure whose first field is the version of the header that its caller was compiled with.
///
/// # Safety
/// The type is `repr(C)`, its first field is a `u32`, and every pattern of bits is a value of it.
pub(crate) unsafe trait Versioned {
    /// Name in error texts.
    const NAME: &'static str;
}

/// Returns the structure that a pointer leads to.
///
/// # Safety
/// `pointer` is NULL or leads to a `T` that nothing writes for as long as the reference lives.
pub(crate) unsafe fn structure<'a, T>(
    name: &'static str,
    pointer: *const T,
) -> Result<&'a T, Fault> {
    check(name, pointer)?;
    // SAFETY: not NULL, aligned, and the caller's promise.
    Ok(unsafe { &*pointer })
}

/// Returns a structure of this version of the header.
///
/// # Safety
/// As of [`structure`], and a structure of another version has at least its first field.
pub(crate) unsafe fn versioned<'a, T: Versioned>(pointer: *const T) -> Result<&'a T, Fault> {
    check(T::NAME, pointer)?;
    // SAFETY: not NULL and aligned; the first field is a `u32` in every version.
    let abi = unsafe { pointer.cast::<u32>().read() };
    if abi != crate::SB_ABI {
        return Err(Fault::Abi(T::NAME, abi));
    }
    // SAFETY: of this version; the caller's promise.
    Ok(unsafe { &*pointer })
}

/// Returns `count` values in a row; none may be NULL.
///
/// # Safety
/// `pointer` is NULL or leads to `count` values that nothing writes for as long as the slice lives.
pub(crate) unsafe fn row<'a, T>(
    name: &'static str,
    pointer: *const T,
    count: usize,
) -> Result<&'a [T], Fault> {
    if count == 0 {
        return Ok(&[]);
    }
    check(name, pointer)?;
    // Beyond it no object of any program reaches.
    let most = isize::MAX as usize / size_of::<T>();
    Fault::check(name, count as f64, (0.0, most as f64), "values")?;
    // SAFETY: not NULL, aligned, no longer than an object may be, and the caller's promise.
    Ok(unsafe { core::slice::from_raw_parts(pointer, count) })
}

/// Writes a result that the caller may leave out.
///
/// # Safety
/// `to` is NULL or leads to a `T` that can be written.
pub(crate) unsafe fn give<T>(to: *mut T, value: T) {
    if !to.is_null() && to.is_aligned() {
        // SAFETY: not NULL, aligned, and the caller's promise.
        unsafe { to.write(value) };
    }
}

/// Refuses a pointer that leads to nothing.
pub(crate) fn check<T>(name: &'static str, pointer: *const T) -> Result<(), Fault> {
    if pointer.is_null() {
        Err(Fault::Argument(name, Status::Null))
    } else if !pointer.is_aligned() {
        Err(Fault::Argument(name, Status::Alignment))
    } else {
        Ok(())
    }
}
