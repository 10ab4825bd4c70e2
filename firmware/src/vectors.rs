//! The table of interrupt vectors, as long as the board's.

/// Defines the vectors of a board with 32 interrupts, none of which the program uses.
///
/// cortex-m-rt's own table is for 240, the most that the processor can have: 832 bytes more flash.
/// A macro, because a program with handlers defines a table with them in it.
#[macro_export]
macro_rules! unused_interrupts {
    () => {
        unsafe extern "C" {
            fn DefaultHandler();
        }

        #[unsafe(link_section = ".vector_table.interrupts")]
        #[unsafe(no_mangle)]
        static __INTERRUPTS: [unsafe extern "C" fn(); 32] = [DefaultHandler; 32];
    };
}
