//! Errors as text in the caller's buffer.

use core::ffi::{c_char, c_void};
use core::fmt::{self, Write};

use crate::Status;
use crate::object;

/// A C string of fixed room. What does not fit is cut, and counted.
struct Cut<'a> {
    room: &'a mut [u8],
    length: usize,
}

impl Write for Cut<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        // The last byte ends the string.
        let free = self.room.len().saturating_sub(1);
        for byte in text.bytes() {
            if self.length < free
                && let Some(place) = self.room.get_mut(self.length)
            {
                *place = byte;
            }
            self.length += 1;
        }
        Ok(())
    }
}

/// Writes why the latest refused call on `object` was refused, in one line: the field, its value,
/// what it must be, what would do. `object` is the first argument of that call: an arm, a planner,
/// a path or a drive, also one whose initialisation has failed. `status` is what it returned; where
/// the object keeps no reason of it, or is NULL, the text is that of the status alone.
///
/// Returns the length of the whole text without its end, as `snprintf`; more than `size - 1` of it
/// is cut. 200 bytes hold most.
///
/// # Safety
/// `object` is NULL or points to storage of an object on which no other call but `sb_tick` runs.
/// `buffer` is NULL or `size` bytes of it can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_error_text(
    object: *const c_void,
    status: i32,
    buffer: *mut c_char,
    size: usize,
) -> usize {
    let room: &mut [u8] = if buffer.is_null() || size == 0 || size > isize::MAX as usize {
        &mut []
    } else {
        // SAFETY: not NULL, no longer than an object may be, and the caller's promise. Written
        // first, as it may not be initialised.
        unsafe {
            buffer.write_bytes(0, size);
            core::slice::from_raw_parts_mut(buffer.cast(), size)
        }
    };
    let mut text = Cut { room, length: 0 };
    // SAFETY: the caller's promise.
    let fault = unsafe { object::fault(object) };
    let written = match fault.filter(|fault| fault.status() as i32 == status) {
        Some(fault) if status != Status::Ok as i32 => write!(text, "{fault}"),
        _ => text.write_str(words(status)),
    };
    // Writing to it does not fail.
    let _ = written;
    text.length
}

/// Returns the text of a status that came back from C.
fn words(status: i32) -> &'static str {
    /// Every status, in the order of its number.
    const ALL: [Status; 20] = [
        Status::Ok,
        Status::Null,
        Status::Size,
        Status::Alignment,
        Status::Abi,
        Status::NotInitialised,
        Status::NotBuilt,
        Status::OutOfRange,
        Status::NotPrepared,
        Status::Limit,
        Status::TooFast,
        Status::NotStill,
        Status::Mode,
        Status::Moving,
        Status::QueueFull,
        Status::Stale,
        Status::Starved,
        Status::Saturated,
        Status::NotFinite,
        Status::Refused,
    ];
    let known = usize::try_from(status).ok().and_then(|i| ALL.get(i));
    known.map_or("status = unknown: must be one that a call has returned", |status| status.words())
}
