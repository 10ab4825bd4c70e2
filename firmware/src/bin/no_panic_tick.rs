//! The tick path of every method and nothing else: links only if no panic is reachable from it.
//!
//! Not for running. The generators are memory that the compiler knows nothing about, so that
//! set-up, which may check its arguments with panics, is not linked. Built with the environment
//! variable `STILLBEAM_FAULT`, it has a panic in place of the ticks and must not link.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use panic_never as _;
use stillbeam::Generator;
use stillbeam::axis::MechanismAxes;
use stillbeam_golden::methods::{Method, Visitor, visit_all};

stillbeam_firmware::unused_interrupts!();

const FAULT: bool = option_env!("STILLBEAM_FAULT").is_some();

struct Ticks(*mut u8);

impl Visitor for Ticks {
    #[inline(never)]
    fn visit<M: Method>(&mut self) {
        let arm = self.0.cast::<Generator<M::Stepper, 8>>();
        // SAFETY: this program is linked, never run.
        let arm = unsafe { &mut *arm };
        black_box(arm.tick());
        black_box(arm.setpoint());
        black_box(arm.setpoint_before());
        let hub = *arm.hub();
        black_box(arm.follow(&hub));
    }
}

/// The ticks of a chain as axes of one mechanism, those of a stop and of an impact included.
#[inline(never)]
fn visit_chain<const LINKS: usize, const W: usize, const C: usize, const Q: usize>(
    memory: *mut u8,
) {
    let arm = memory.cast::<MechanismAxes<f32, LINKS, W, C, Q, 8>>();
    // SAFETY: this program is linked, never run.
    let arm = unsafe { &mut *arm };
    arm.missed(black_box(1));
    black_box(arm.tick());
    black_box(arm.generator().setpoint());
}

#[entry]
fn main() -> ! {
    let memory = black_box(0x2000_0000 as *mut u8);
    if FAULT {
        // The proof can fail: this index may be out of range, and is what does not link.
        black_box([0; 4][black_box(0)]);
    } else {
        visit_ticks(memory);
    }
    loop {
        cortex_m::asm::wfi();
    }
}

fn visit_ticks(memory: *mut u8) {
    visit_all(&mut Ticks(memory));
    visit_chain::<1, 3, 3, 3>(memory);
    visit_chain::<2, 3, 6, 3>(memory);
    visit_chain::<3, 3, 9, 3>(memory);
    visit_chain::<2, 4, 8, 5>(memory);
    visit_chain::<3, 4, 12, 5>(memory);
}
