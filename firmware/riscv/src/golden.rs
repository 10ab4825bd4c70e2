//! Steps every scene with one method of each kind and streams every setpoint's bits to the host, as
//! the firmware's program `golden` does, on RV32IMAC: QEMU's machine `virt`.
#![no_std]
#![no_main]

use semihosting::io::{self, Stdout, Write};
use semihosting::process;
use stillbeam_golden::{record, run};

/// Records that are sent at once: a call of the host stops the machine.
const RECORDS: usize = 512;

/// Exit code of a panic, that of the firmware's programs.
const PANICKED: i32 = 101;

#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    semihosting::eprintln!("{info}");
    process::exit(PANICKED)
}

/// Records on their way to the host.
struct Stream {
    out: Stdout,
    buffer: [u8; RECORDS * record::BYTES],
    filled: usize,
}

impl Stream {
    fn put(&mut self, record: &[u8; record::BYTES]) {
        self.buffer[self.filled..][..record::BYTES].copy_from_slice(record);
        self.filled += record::BYTES;
        if self.filled == self.buffer.len() {
            self.send();
        }
    }

    fn send(&mut self) {
        self.out.write_all(&self.buffer[..self.filled]).expect("the host takes the stream");
        self.filled = 0;
    }
}

/// Makes the run.
#[riscv_rt::entry]
fn main() -> ! {
    let out = io::stdout().expect("standard output by semihosting");
    let mut stream = Stream { out, buffer: [0; RECORDS * record::BYTES], filled: 0 };
    run(&mut |case, tick, setpoint| {
        stream.put(&record::encode(record::stamp(case.index, tick), setpoint));
    })
    .expect("every embedded scene is accepted");
    stream.send();
    process::exit(0)
}
