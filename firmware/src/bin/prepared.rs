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
use stillbeam::{Error, Generator, PlainMove, Profile};
use stillbeam_firmware::{exit, stack};
use stillbeam_golden::methods::Method;

// `Chosen`, the method; `TICK`, s; `ARM`, the words of its stepper.
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
fn one_move() -> Result<(), Error> {
    // Both are used where they were made: taking them out of the results would copy them once more
    // on the stack.
    let loaded = <Chosen as Method>::Stepper::load(black_box(&ARM), TICK);
    let stepper = loaded.as_ref().map_err(|error| *error)?;
    let mut made = Generator::<_, 2>::new(stepper, 0.0);
    let arm = made.as_mut().map_err(|error| *error)?;
    // The profile is known, so that only it is planned; duration and angle are not.
    let (duration, to) = black_box((2.0, core::f64::consts::PI));
    arm.push(&PlainMove::To { profile: Profile::Cubic, duration, to })?;
    for _ in 0..=400 {
        black_box(arm.tick());
    }
    Ok(())
}

#[entry]
fn main() -> ! {
    stack::paint();
    let moved = one_move().is_ok();
    let stack = stack::deepest() as u32;
    let sent = io::stdout().and_then(|mut out| out.write_all(&stack.to_le_bytes()));
    process::exit(if moved && sent.is_ok() { 0 } else { 1 })
}
