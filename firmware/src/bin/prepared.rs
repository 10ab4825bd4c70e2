//! The least that a user needs whose arm is prepared on the desktop: its words, one move, the ticks
//! of it. Beside it, `minimal` sets the same arm up on the target.
//!
//! The build script writes the words, for the method that the environment variable
//! `STILLBEAM_METHOD` names.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use semihosting::io::{self, Write};
use semihosting::process;
use stillbeam::prepared::Prepared;
use stillbeam::{Generator, PlainMove, Profile};
use stillbeam_firmware::{exit, stack};
use stillbeam_golden::methods::Method;

// `Chosen`, the method; `TICK`, s; `ARM`, the words of its stepper; `known`, which returns the
// stepper with what is known of it.
include!(concat!(env!("OUT_DIR"), "/prepared.rs"));

stillbeam_firmware::unused_interrupts!();

/// Of `stillbeam_firmware::exit_on_panic`'s two lines, the one that needs no formatting.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    process::exit(exit::PANICKED)
}

/// Loads the arm and makes the paper's move of member B. A board would write each setpoint to its
/// drive.
#[inline(never)]
fn one_move() -> Option<()> {
    // Both are used where they were made: taking them out of the results would copy them once more
    // on the stack.
    let loaded = <Chosen as Method>::Stepper::load(black_box(&ARM), TICK);
    let stepper = loaded.as_ref().ok()?;
    let mut made = Generator::<_, 2>::new(known(stepper)?, 0.0);
    let arm = made.as_mut().ok()?;
    // The profile is known, so that only it is planned; duration and angle are not.
    let (duration, to) = black_box((2.0, core::f64::consts::PI));
    arm.push(&PlainMove::To { profile: Profile::Cubic, duration, to }).ok()?;
    for _ in 0..=400 {
        black_box(arm.tick());
    }
    Some(())
}

#[entry]
fn main() -> ! {
    stack::paint();
    let moved = one_move().is_some();
    let stack = stack::deepest() as u32;
    let sent = io::stdout().and_then(|mut out| out.write_all(&stack.to_le_bytes()));
    process::exit(if moved && sent.is_ok() { 0 } else { 1 })
}
