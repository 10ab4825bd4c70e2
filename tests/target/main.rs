//! Images for the target, run in QEMU where there is a board for them. One program, so
//! that an image that several tests need is built once.

mod application;
mod boards;
mod c;
mod changes;
mod emulator;
mod footprint;
mod golden;
mod instructions;
mod mechanisms;
mod no_panic;
mod paths;
mod portability;
mod record;
mod session;
mod timing;
