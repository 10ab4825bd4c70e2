//! The counters of a Cortex-M: instructions under QEMU, cycles on a board.

use crate::stopwatch::Counter;

/// The counter of this build.
#[cfg(not(feature = "dwt"))]
pub type Chosen = Instructions;
/// The counter of this build.
#[cfg(feature = "dwt")]
pub type Chosen = Cycles;

/// Executed instructions, by CMSDK TIMER0 of the AN386 image at 25 MHz (40 ns a count).
///
/// QEMU must run with `-icount shift=10`: an instruction then takes 1,024 ns, 25.6 counts, and the
/// rounding of one count to the next cannot add up to an instruction. (With `shift=6` an
/// instruction is 1.6 counts, and differences are off by one now and then.) 167 million
/// instructions until it wraps. Conditional instructions count whether they execute or not.
pub struct Instructions(());

impl Instructions {
    /// Arm DAI 0386, memory map: CMSDK APB timer 0; registers CTRL, VALUE (counts down), RELOAD.
    const TIMER0: *mut u32 = 0x4000_0000 as *mut u32;
}

impl Counter for Instructions {
    const UNIT: &'static str = "instructions";

    fn start() -> Self {
        // SAFETY: registers of a device that nothing else in these programs uses.
        unsafe {
            Self::TIMER0.add(2).write_volatile(u32::MAX);
            Self::TIMER0.add(1).write_volatile(u32::MAX);
            Self::TIMER0.write_volatile(1);
        }
        Self(())
    }

    #[inline(always)]
    fn barrier() {
        cortex_m::asm::dmb();
    }

    #[inline(always)]
    fn read(&self) -> u32 {
        // SAFETY: as above; reading has no side effect.
        unsafe { Self::TIMER0.add(1).read_volatile() }
    }

    fn between(&self, from: u32, to: u32) -> u32 {
        // 25.6 = 128/5 counts an instruction, to nearest.
        ((u64::from(from.wrapping_sub(to)) * 5 + 64) / 128) as u32
    }
}

/// Processor cycles, by the data watchpoint and trace unit. QEMU's reads 0. Armv6-M has none.
#[cfg(feature = "dwt")]
pub struct Cycles(());

#[cfg(feature = "dwt")]
impl Counter for Cycles {
    const UNIT: &'static str = "cycles";

    fn start() -> Self {
        // SAFETY: the program's only use of the core peripherals, before anything is measured.
        let mut core = unsafe { cortex_m::Peripherals::steal() };
        core.DCB.enable_trace();
        cortex_m::peripheral::DWT::unlock();
        core.DWT.enable_cycle_counter();
        Self(())
    }

    #[inline(always)]
    fn barrier() {
        cortex_m::asm::dmb();
    }

    #[inline(always)]
    fn read(&self) -> u32 {
        cortex_m::peripheral::DWT::cycle_count()
    }

    fn between(&self, from: u32, to: u32) -> u32 {
        to.wrapping_sub(from)
    }
}
