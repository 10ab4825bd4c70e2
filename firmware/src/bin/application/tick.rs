//! The hard tick: 10 ms, above everything but the alarm that starts it.

use core::sync::atomic::{AtomicU32, Ordering};

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use embassy_time::{Duration, Instant, Timer};
use stillbeam::axis::{Cause, Pace, Tick};

use crate::axes::{AXES, TICK};
use crate::{board, shared};

/// A setpoint on its way.
#[derive(Clone, Copy)]
pub struct Setpoint {
    /// Which axis.
    pub axis: u8,
    /// Number, mode, setpoint.
    pub tick: Tick<f32>,
    /// Why the axis stopped, if it did.
    pub cause: Option<Cause>,
}

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
    let period = Duration::from_micros((TICK * 1e6) as u64);
    let mut due = Instant::now();
    let mut pace = Pace::new(board::PERIOD);
    loop {
        due += period;
        Timer::at(due).await;
        let begin = board::counts();
        let timing = pace.arrive(begin);
        // No burst to catch up: the path waits. The phase is kept, which a ticker that is reset to
        // now would not do.
        due += period * timing.missed;
        shared::with(|shared| {
            for (i, joint) in shared.joints.iter_mut().enumerate() {
                if timing.missed > 0 {
                    joint.axis.missed(timing.missed);
                }
                let tick = joint.axis.tick();
                let setpoint = Setpoint { axis: i as u8, tick, cause: joint.axis.cause() };
                for outlet in [&TO_DRIVE, &TO_HOST] {
                    shared.counters.dropped += u32::from(!hand_on(outlet, setpoint));
                }
            }
            MADE.store(MADE.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
            let took = board::counts().wrapping_sub(begin);
            let counters = &mut shared.counters;
            counters.cost = board::cost(took);
            counters.worst = counters.worst.max(counters.cost);
            counters.late = counters.late.max(timing.late);
            counters.missed += timing.missed;
            counters.overruns += u32::from(timing.late.saturating_add(took) > board::PERIOD);
        });
        board::ticked();
    }
}

/// Puts a setpoint behind the others, in place of the oldest if there is no room. Whether there was.
fn hand_on(outlet: &Outlet, setpoint: Setpoint) -> bool {
    let room = outlet.try_send(setpoint).is_ok();
    if !room {
        let _ = outlet.try_receive();
        let _ = outlet.try_send(setpoint);
    }
    room
}
