//! Worst stack, by paint: fill what is free, run, see how far down the paint is gone.

unsafe extern "C" {
    /// First address above the stack, from cortex-m-rt's linker script.
    static mut _stack_start: u32;
    /// First address above the statics.
    static mut __sheap: u32;
}

/// Bytes below the stack's top that are painted at most: many times what any method needs.
const DEPTH: usize = 64 * 1024;
const PAINT: u32 = 0xa5c3_5a3c;

fn top() -> *mut u32 {
    &raw mut _stack_start
}

/// Lowest painted address.
fn bottom() -> usize {
    let statics = &raw mut __sheap as usize;
    statics.max((top() as usize).saturating_sub(DEPTH))
}

/// Paints the free part of the stack.
#[inline(never)]
pub fn paint() {
    let here = cortex_m::register::msp::read() as usize;
    // Below this function's own frame, with room for the loop's.
    let end = here - 64;
    for address in (bottom()..end).step_by(4) {
        // SAFETY: RAM between the statics and the stack pointer, used by nothing.
        unsafe { (address as *mut u32).write_volatile(PAINT) }
    }
}

/// Bytes from the stack's top down to the deepest word that was written since [`paint`].
#[inline(never)]
pub fn deepest() -> usize {
    let mut address = bottom();
    // SAFETY: as above; stops at the paint's end at the latest, where the live stack begins.
    while address < top() as usize && unsafe { (address as *const u32).read_volatile() } == PAINT {
        address += 4;
    }
    top() as usize - address
}
