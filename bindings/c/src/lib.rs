#![no_std]
#![warn(clippy::too_many_lines, clippy::undocumented_unsafe_blocks)]
//! C binding: an arm under a policy, moves, the tick, and the bytes of a drive, behind a static
//! library and one header.
//!
//! The caller owns all memory. An object ([`arm::Arm`], [`still::Planner`], [`path::Path`],
//! [`drive::Drive`]) is storage of stated size, which its `init` function checks and fills. There
//! is no allocation and no global state. Every function returns a [`Status`]; the object it was
//! called on keeps the reason, which [`text::sb_error_text`] writes.
//!
//! `include/stillbeam.h` is made from this crate, and a test compares the two. `docs/c.md` is for
//! the reader who writes C. This is the one crate of the product with `unsafe` code: raw pointers
//! come in at this border and go no further than `object` and `memory`.

// On a host the panic handler and the unwinder are those of the standard library.
#[cfg(not(target_os = "none"))]
extern crate std;

mod fault;
mod memory;
mod methods;
mod object;
mod status;

// In the order of the header, which rustfmt keeps between empty lines.
pub mod scene;

pub mod setup;

pub mod arm;

pub mod motion;

pub mod reach;

pub mod still;

pub mod path;

pub mod tick;

pub mod drive;

pub mod text;

pub use status::Status;

/// Version of the header. A structure that begins with it is refused if it was compiled against
/// another one.
pub const SB_ABI: u32 = 1;

/// No panic can be reached from the calls of the interrupt; the language asks for a handler all the
/// same, as the compiler cannot see it of set-up. A watchdog ends its loop.
#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        core::hint::spin_loop();
    }
}
