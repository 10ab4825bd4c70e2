//! Lock-step: the host grants every tick.

use core::sync::atomic::{AtomicU32, Ordering};

use embassy_futures::yield_now;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::signal::Signal;
use semihosting::fs::File;
use semihosting::io::Read;

use super::serial::UARTS;
use super::time::{PER_MICROSECOND, time};
use crate::link::LINK;
use crate::record::ROWS;
use crate::tick::{TO_DRIVE, TO_HOST};

static TICKED: Signal<CriticalSectionRawMutex, ()> = Signal::new();
/// The counter's reading when the last tick had been made.
static LAST: AtomicU32 = AtomicU32::new(0);

/// A tick has been made.
pub fn ticked() {
    LAST.store(time().reading(), Ordering::Relaxed);
    TICKED.signal(());
}

/// Holds time after every tick, once its setpoints are out, until the host grants the next one.
#[embassy_executor::task]
pub async fn keep_step() {
    let Ok(mut host) = File::open(c"/dev/stdin") else { return };
    let mut granted = [0; 4];
    let mut first = true;
    let mut awaited = [0u32; 2];
    loop {
        TICKED.wait().await;
        let all_out = || TO_DRIVE.is_empty() && TO_HOST.is_empty() && ROWS.is_empty();
        while !(all_out() && LINK.try_lock().is_ok()) {
            yield_now().await;
        }
        match host.read_exact(&mut granted) {
            Ok(()) => first = false,
            // Nobody there: run free. Gone: over.
            Err(_) if first => return,
            Err(_) => semihosting::process::exit(0),
        }
        let [link, bus, low, high] = granted;
        for (awaited, granted) in awaited.iter_mut().zip([link, bus]) {
            *awaited += u32::from(granted);
        }
        time().hold();
        let all_in = || UARTS.iter().zip(awaited).all(|(u, n)| u.taken() >= n);
        while !all_in() {
            // Masked, so that no byte slips in between the look and the sleep; it wakes all the
            // same.
            cortex_m::interrupt::free(|_| {
                if !all_in() {
                    cortex_m::asm::wfi();
                }
            });
        }
        time().go_on();
        stall(u16::from_le_bytes([low, high]));
    }
}

/// Keeps everything from running, the tick too, until so many µs after the last tick: what a fault
/// would do. Counted from that tick, since the time that passes before this task runs again depends
/// on the code: an answer in the short time after a late tick takes until long after the next one.
fn stall(microseconds: u16) {
    if microseconds > 0 {
        let counts = PER_MICROSECOND * u32::from(microseconds);
        cortex_m::interrupt::free(|_| {
            let begin = LAST.load(Ordering::Relaxed);
            while time().reading().wrapping_sub(begin) < counts {}
        });
    }
}
