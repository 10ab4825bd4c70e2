//! State that the tick shares with the tasks below it. Access masks the tick for as long: a copy
//! in, a copy out, no planning.

use core::cell::RefCell;

use embassy_sync::blocking_mutex::CriticalSectionMutex;
use heapless::Vec;
use stillbeam::{Error, UniformScene};
use stillbeam_protocol::Refusal;
use stillbeam_wiring::Configuration;
use stillbeam_wiring::axes::{AXES, CONFIGURATIONS, Joint, Stepper};

use crate::arms;

/// Result of a request.
pub type Outcome<T> = Result<T, Refusal<'static>>;

/// Counts since power-up.
#[derive(Clone, Copy)]
pub struct Counters {
    /// Cost of the latest tick.
    pub cost: u32,
    /// Cost of the worst.
    pub worst: u32,
    /// Latest start of a tick, in counts of the board.
    pub late: u32,
    /// Ticks that did not take place.
    pub missed: u32,
    /// Ticks that came before they were due, and were not made.
    pub early: u32,
    /// Ticks that were not over when the next was due.
    pub overruns: u32,
    /// Setpoints that found a queue full.
    pub dropped: u32,
    /// Frames that came in garbled.
    pub garbled: u32,
    /// Values that did not fit the drive's format.
    pub saturated: u32,
}

/// Everything shared.
pub struct Shared {
    /// The axes in their order.
    pub joints: Vec<Joint, AXES>,
    /// Counters since power-up.
    pub counters: Counters,
}

static SHARED: CriticalSectionMutex<RefCell<Shared>> =
    CriticalSectionMutex::new(RefCell::new(Shared {
        joints: Vec::new(),
        counters: Counters::NONE,
    }));

impl Counters {
    const NONE: Self = Self {
        cost: 0,
        worst: 0,
        late: 0,
        missed: 0,
        early: 0,
        overruns: 0,
        dropped: 0,
        garbled: 0,
        saturated: 0,
    };
}

/// Looks at it with the tick masked.
pub fn with<R>(look: impl FnOnce(&mut Shared) -> R) -> R {
    SHARED.lock(|shared| look(&mut shared.borrow_mut()))
}

/// Builds every axis, disabled at angle 0. Set-up, before the tick runs.
pub fn set_up() -> Result<(), Error> {
    (0..AXES).try_for_each(add)
}

#[inline(never)]
fn add(axis: usize) -> Result<(), Error> {
    place(&CONFIGURATIONS[axis], arms::at_power_up(axis)?)
}

/// Builds the axis around its stepper.
// Apart from the stepper's set-up, whose stack would else lie on top of the axis' own.
#[inline(never)]
fn place(configuration: &Configuration, stepper: Stepper) -> Result<(), Error> {
    let made = Joint::new(configuration, stepper);
    with(|shared| {
        // There is room for as many as there are configurations.
        made.map(|joint| drop(shared.joints.push(joint)))
    })
}

/// Changes an axis with the tick masked.
pub fn on(axis: usize, change: impl FnOnce(&mut Joint) -> Outcome<()>) -> Outcome<u32> {
    with(|s| {
        let joint = s.joints.get_mut(axis).ok_or(Refusal::Axis(AXES as u8))?;
        let tick = joint.axis.clock();
        change(joint).map(|()| tick)
    })
}

/// The arm as it is now.
pub fn scene(axis: usize) -> Outcome<UniformScene> {
    with(|s| s.joints.get(axis).map(|joint| joint.scene)).ok_or(Refusal::Axis(AXES as u8))
}
