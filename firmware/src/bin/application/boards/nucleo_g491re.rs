//! NUCLEO-G491RE (STM32G491RET6, Cortex-M4F at 170 MHz): the same board as the NUCLEO-G474RE,
//! MB1367, with another chip, whose flash has one bank only and whose RAM ends where the other's is
//! left unused (ST RM0440, memory map). Builds; nobody has flashed it yet.
//!
//! FLASH : ORIGIN = 0x08000000, LENGTH = 512K
//! RAM : ORIGIN = 0x20000000, LENGTH = 96K

#[path = "nucleo_g474re.rs"]
mod nucleo_g474re;

pub use nucleo_g474re::*;
