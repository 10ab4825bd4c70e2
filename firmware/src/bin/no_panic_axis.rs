//! An axis' tick, also of a hub that it follows, with the stop that may come out of it, and nothing
//! else: links only if no panic is reachable from them. As `no_panic_tick`, not for running; built
//! with the environment variable `STILLBEAM_FAULT`, it has a panic and must not link.
//!
//! With the cheapest and the smallest bending stepper: `no_panic_tick` proves the others.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use panic_never as _;
use stillbeam::axis::{Axis, Cause, Pace};
// The fault handler.
use stillbeam_firmware as _;
use stillbeam_golden::methods::{Method, Newmark1, RigidArm};

stillbeam_firmware::unused_interrupts!();

#[inline(never)]
fn axis<M: Method>(memory: *mut u8) {
    let axis = memory.cast::<Axis<M::Stepper, 8>>();
    // SAFETY: this program is linked, never run.
    let axis = unsafe { &mut *axis };
    let mut pace = Pace::new(black_box(250_000));
    black_box(axis.tick_if_due(&pace.arrive(black_box(0))));
    black_box(axis.tick());
    let hub = *axis.generator().hub();
    black_box(axis.follow(black_box(Some(&hub))));
    axis.stop(black_box(Cause::Requested));
    axis.heard();
}

#[entry]
fn main() -> ! {
    if option_env!("STILLBEAM_FAULT").is_some() {
        // The proof can fail: this index may be out of range.
        black_box([0; 4][black_box(0)]);
    }
    let memory = black_box(0x2000_0000 as *mut u8);
    axis::<RigidArm>(memory);
    axis::<Newmark1>(memory);
    loop {
        cortex_m::asm::wfi();
    }
}
