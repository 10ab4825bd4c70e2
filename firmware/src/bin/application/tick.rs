//! The hard tick, above everything but the alarm that starts it.

use core::sync::atomic::{AtomicU32, Ordering};

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use embassy_time::{Duration, Instant, Timer};
use stillbeam::axis::Pace;
use stillbeam_wiring::axes::{AXES, TICK};
use stillbeam_wiring::drive::Setpoint;

use crate::{board, record, shared};

/// The tick in µs, the timer's unit.
pub const MICROSECONDS: u32 =
    Pace::period(TICK, 1_000_000).expect("axes.rs: TICK must be a whole number of µs");

/// The tick in counts of the board.
pub const PERIOD: u32 = Pace::period(TICK, board::COUNTS_PER_SECOND)
    .expect("axes.rs: TICK must be a whole number of the board's counts");

/// Setpoints of two ticks: whoever is later than that gets the newest and a count of what is lost.
pub type Outlet = Channel<CriticalSectionRawMutex, Setpoint, { 2 * AXES }>;

/// Ticks made: the report's time.
pub static MADE: AtomicU32 = AtomicU32::new(0);

/// To the drives.
pub static TO_DRIVE: Outlet = Channel::new();
/// To the host.
pub static TO_HOST: Outlet = Channel::new();

/// Deadline: over before the next tick is due. Only steps the axes and hands their setpoints on.
#[embassy_executor::task]
pub async fn run() {
    let period = Duration::from_micros(MICROSECONDS.into());
    let mut due = Instant::now();
    let mut pace = Pace::new(PERIOD);
    loop {
        due += period;
        Timer::at(due).await;
        let begin = board::counts();
        let timing = pace.arrive(begin);
        // No burst to catch up: the path waits. The phase is kept, which a ticker that is reset to
        // now would not do.
        due += period * timing.missed;
        if !timing.due {
            // Nothing is made or sent. The timer goes on in its phase, so that the next one is due.
            shared::with(|shared| shared.counters.early += 1);
            continue;
        }
        shared::with(|shared| {
            for (i, joint) in shared.joints.iter_mut().enumerate() {
                let tick = joint.tick_by(timing.missed, stillbeam_tick::advance);
                let setpoint = Setpoint { axis: i as u8, tick, cause: joint.axis.cause() };
                for outlet in [&TO_DRIVE, &TO_HOST] {
                    shared.counters.dropped += u32::from(!hand_on(outlet, setpoint));
                }
                record::tick(i, joint, &timing);
            }
            MADE.store(MADE.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
            let took = board::counts().wrapping_sub(begin);
            let counters = &mut shared.counters;
            counters.cost = board::cost(took);
            counters.worst = counters.worst.max(counters.cost);
            counters.late = counters.late.max(timing.late);
            counters.missed += timing.missed;
            counters.overruns += u32::from(timing.late.saturating_add(took) > PERIOD);
        });
        board::ticked();
    }
}

/// Counts of the board as µs.
pub fn microseconds(counts: u32) -> u32 {
    (u64::from(counts) * 1_000_000 / u64::from(board::COUNTS_PER_SECOND)) as u32
}

/// Puts a setpoint behind the others, in place of the oldest if there is no room. Returns whether
/// there was room.
fn hand_on(outlet: &Outlet, setpoint: Setpoint) -> bool {
    let room = outlet.try_send(setpoint).is_ok();
    if !room {
        let _ = outlet.try_receive();
        let _ = outlet.try_send(setpoint);
    }
    room
}
