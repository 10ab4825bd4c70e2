//! Recordings: the hub's angle and what a sensor shows, a row a tick to the host.
//!
//! Rows are streamed; a few wait where the line is busy. A row that finds no room is dropped and
//! counted, and the count goes to the host with the recording's end.

use core::cell::RefCell;
use core::sync::atomic::{AtomicBool, Ordering};

use embassy_sync::blocking_mutex::CriticalSectionMutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use stillbeam::axis::{Cause, Mode, Timing};
use stillbeam_protocol::Refusal;
use stillbeam_wiring::axes::{AXES, Joint};
use stillbeam_wiring::{Recorder, Recording, Sensor};

use crate::board::Sensors;
use crate::shared::{Outcome, on};
use crate::tick::{MICROSECONDS, microseconds};

/// Name of the sensors' column.
pub const COLUMN: &str = Sensors::COLUMN;

/// To the host: rows of four ticks, each with its axis.
pub static ROWS: Channel<CriticalSectionRawMutex, (u8, Recording), { 4 * AXES }> = Channel::new();

/// Recorders of the axes, and the board's sensors.
struct State {
    recorders: [Recorder; AXES],
    sensors: Option<Sensors>,
}

static STATE: CriticalSectionMutex<RefCell<State>> =
    CriticalSectionMutex::new(RefCell::new(State {
        recorders: [Recorder::OFF; AXES],
        sensors: None,
    }));
/// True if any axis is recorded: all that a tick looks at otherwise.
static IS_ON: AtomicBool = AtomicBool::new(false);

/// Takes the board's sensors. Set-up, before the tick runs.
pub fn set_up(sensors: Sensors) {
    with(|state| state.sensors = Some(sensors));
}

/// Begins a recording and returns the number of its first tick.
pub fn begin(axis: usize) -> Outcome<u32> {
    on(axis, |joint| {
        if axis >= Sensors::AXES {
            return Err(Refusal::NoSensor);
        }
        joint.measured.ok_or(Refusal::NotMeasured)?;
        if is_left_alone(joint) {
            return Err(Refusal::Mode(joint.axis.mode()));
        }
        with(|state| state.recorders.get_mut(axis).map(Recorder::begin));
        IS_ON.store(true, Ordering::Relaxed);
        Ok(())
    })
}

/// Ends a recording; the last row answers the request. False if there is none to end.
pub fn end(axis: usize, sequence: u16) -> bool {
    with(|state| state.recorders.get_mut(axis).is_some_and(|recorder| recorder.end(sequence)))
}

/// Takes the row of a tick, within it.
#[inline(always)]
pub fn tick(axis: usize, joint: &Joint, timing: &Timing) {
    if IS_ON.load(Ordering::Relaxed) {
        take(axis, joint, timing);
    }
}

#[inline(never)]
fn take(axis: usize, joint: &Joint, timing: &Timing) {
    let hub = joint.measured.map(|shaft| joint.train.mapping().to_link(shaft));
    let times = [MICROSECONDS, microseconds(timing.late)];
    with(|State { recorders, sensors }| {
        let Some((recorder, sensors)) = recorders.get_mut(axis).zip(sensors.as_mut()) else {
            return;
        };
        if is_left_alone(joint) {
            recorder.drop_it();
        }
        let read = |time, hub| sensors.read(axis, time, hub);
        recorder.tick(timing, times, hub, read, |row| ROWS.try_send((axis as u8, row)).is_ok());
        // Behind the last axis of a tick.
        if axis + 1 == AXES {
            IS_ON.store(recorders.iter().any(Recorder::is_on), Ordering::Relaxed);
        }
    });
}

/// True if the axis has stopped because nobody listens.
fn is_left_alone(joint: &Joint) -> bool {
    joint.axis.cause() == Some(Cause::LinkLost) && joint.axis.mode() != Mode::Disabled
}

fn with<R>(look: impl FnOnce(&mut State) -> R) -> R {
    STATE.lock(|state| look(&mut state.borrow_mut()))
}
