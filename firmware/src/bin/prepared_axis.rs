//! The example of the C binding, `bindings/c/examples/cortex-m4f`, once more in Rust: the same arm,
//! move, ticks and bytes. Tests hold the C program's setpoints and its size against it.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use semihosting::io::{self, Write};
use semihosting::process;
use stillbeam::axis::{Axis, Policy, StopLimits, Tick};
use stillbeam::drive::odrive;
use stillbeam::motor::{Direction, Drivetrain, Joint, Ratio};
use stillbeam::prepared::Prepared;
use stillbeam::stepper::Elastica2;
use stillbeam::{Angle, Error, Limits, PlainMove, Profile};
use stillbeam_firmware::exit;

// `TICK`, s; `ARM`, the words of the example's stepper.
include!(concat!(env!("OUT_DIR"), "/exported.rs"));

stillbeam_firmware::unused_interrupts!();

/// Of `stillbeam_firmware::exit_on_panic`'s two lines, the one that needs no formatting.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    process::exit(exit::PANICKED)
}

/// A setpoint as C's `sb_setpoint`, and behind it the drive's bytes.
fn record(tick: &Tick<f32>, bytes: [u8; 8]) -> [u8; 48] {
    let at = tick.setpoint;
    let words = [
        tick.number,
        tick.mode as u32,
        0,
        at.angle.turns as u32,
        at.angle.part.to_bits(),
        at.rate.to_bits(),
        at.acceleration.to_bits(),
        at.torque.to_bits(),
        at.tip[0].to_bits(),
        at.tip[1].to_bits(),
    ];
    let mut record = [0; 48];
    for (to, from) in record.chunks_exact_mut(4).zip(words) {
        to.copy_from_slice(&from.to_le_bytes());
    }
    record[40..].copy_from_slice(&bytes);
    record
}

/// Loads the arm, makes one move and sends every tick. Its numbers are not known to the compiler,
/// as those of C are not: any limits, any gear, any move.
#[inline(never)]
fn run() -> Result<bool, Error> {
    let stepper = Elastica2::<f32>::load(black_box(&ARM), TICK)?;
    let limits = Limits { rate: Some(15.0), acceleration: Some(150.0), ..Limits::default() };
    let origin = Angle { turns: 0, part: 0.0 };
    let policy = Policy { limits, stop: StopLimits::OF_MOVES, patience: 10.0, missed: 2 };
    let mut axis = Axis::<_, 8>::new(stepper, origin, black_box(policy))?;
    let joint = Joint { ratio: Ratio { motor: 6, link: 1 }, ..Joint::direct(1.0) };
    let train = Drivetrain::<f32>::new(black_box(&joint), Direction::Same, 0.0)?;
    axis.enable(origin)?;
    let motion = PlainMove::To { profile: Profile::Quintic, duration: 0.4, to: 1.57 };
    let planned = axis.plan_context()?.plan(black_box(&motion))?;
    axis.take(&planned)?;
    let Ok(mut out) = io::stdout() else { return Ok(false) };
    for _ in 0..=planned.summary().ticks + 20 {
        let tick = axis.tick();
        let Some(encoded) = odrive::encode(&train.demand(&tick.setpoint)) else {
            return Ok(false);
        };
        if out.write_all(&record(&tick, encoded.payload)).is_err() {
            return Ok(false);
        }
    }
    Ok(true)
}

#[entry]
fn main() -> ! {
    let sent = run().unwrap_or(false);
    process::exit(if sent { 0 } else { 1 })
}
