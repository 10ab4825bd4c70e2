//! Every way out of the emulator passes an exit code; none loops for ever.

use cortex_m_rt::{ExceptionFrame, exception};

/// Exit code of a panic.
pub const PANICKED: i32 = 101;
/// Exit code of a fault of the processor.
pub const FAULTED: i32 = 102;

/// A fault ends the run. cortex-m-rt's own handler would loop.
#[exception]
unsafe fn HardFault(_: &ExceptionFrame) -> ! {
    semihosting::process::exit(FAULTED)
}

/// Defines a panic handler that prints where and ends the run. A macro, because the image that
/// proves the absence of panics must be free of any handler but its own.
#[macro_export]
macro_rules! exit_on_panic {
    () => {
        #[panic_handler]
        fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
            semihosting::eprintln!("{info}");
            semihosting::process::exit($crate::exit::PANICKED)
        }
    };
}
