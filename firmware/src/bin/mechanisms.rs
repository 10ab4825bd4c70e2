//! Runs every chain of links, counts its ticks and prints the bits of its setpoints: lines
//! `bits,name,tick,…` with the words of every joint in hexadecimal, `frame,joint,…` with the bytes
//! for its drive, and `tick,name,least,worst`.
#![no_std]
#![no_main]

use core::fmt::Write;
use core::hint::black_box;

use cortex_m_rt::entry;
use semihosting::process::ExitCode;
use stillbeam::chain::ChainSetpoint;
use stillbeam_firmware::counter::Chosen;
use stillbeam_firmware::output::Output;
use stillbeam_firmware::stopwatch::{Counter, Stopwatch};
use stillbeam_golden::{mechanisms, record};

stillbeam_firmware::exit_on_panic!();
stillbeam_firmware::unused_interrupts!();

/// Counts and prints.
struct Lines<'a, C> {
    watch: &'a Stopwatch<C>,
    output: Output,
    name: &'static str,
    least: u32,
    worst: u32,
}

impl<C: Counter> Lines<'_, C> {
    /// Ends a chain's lines with its counts.
    fn end(&mut self) {
        if !self.name.is_empty() {
            writeln!(self.output, "tick,{},{},{}", self.name, self.least, self.worst)
                .expect("the host takes the lines");
        }
        (self.least, self.worst) = (u32::MAX, 0);
    }
}

impl<C: Counter> mechanisms::Sink for Lines<'_, C> {
    fn tick<const LINKS: usize>(
        &mut self,
        name: &'static str,
        tick: u32,
        make: impl FnOnce() -> ChainSetpoint<f32, LINKS>,
    ) {
        if name != self.name {
            self.end();
            self.name = name;
        }
        let (setpoint, count) = self.watch.count(|| black_box(make()));
        // The first tick makes no step.
        if tick > 0 {
            self.least = self.least.min(count);
            self.worst = self.worst.max(count);
        }
        write!(self.output, "bits,{name},{tick}").expect("the host takes the lines");
        for (joint, end) in setpoint.joints.iter().zip(setpoint.ends) {
            for word in record::bits(joint).into_iter().chain(end.map(f32::to_bits)) {
                write!(self.output, ",{word:08x}").expect("the host takes the lines");
            }
        }
        writeln!(self.output).expect("the host takes the lines");
    }

    fn frame(&mut self, joint: usize, payload: [u8; 8]) {
        let payload = u64::from_le_bytes(payload);
        writeln!(self.output, "frame,{joint},{payload:016x}").expect("the host takes the lines");
    }
}

#[entry]
fn main() -> ! {
    let watch = Stopwatch::<Chosen>::start();
    let output = Output::open().expect("standard output by semihosting");
    let mut lines = Lines { watch: &watch, output, name: "", least: u32::MAX, worst: 0 };
    mechanisms::run(&mut lines).expect("every chain is accepted");
    lines.end();
    lines.output.flush().expect("the host takes the lines");
    ExitCode::SUCCESS.exit_process()
}
