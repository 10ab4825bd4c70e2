//! The way out of a panic.

use semihosting::process;

/// Exit code of a panic, that of the firmware's programs.
const PANICKED: i32 = 101;

#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    semihosting::eprintln!("{info}");
    process::exit(PANICKED)
}
