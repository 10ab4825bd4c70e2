//! Time, for embassy and for the tick's cost.

use core::cell::RefCell;
use core::task::Waker;

use embassy_sync::blocking_mutex::CriticalSectionMutex;
use embassy_time_driver::Driver;
use embassy_time_queue_utils::Queue;

/// A CMSDK timer: registers CTRL, VALUE (counts down at 25 MHz), RELOAD, INTCLEAR.
struct Timer {
    base: usize,
}

impl Timer {
    fn register(&self, index: usize) -> *mut u32 {
        (self.base as *mut u32).wrapping_add(index)
    }

    #[inline(always)]
    fn value(&self) -> u32 {
        // SAFETY: reading a counter.
        unsafe { self.register(1).read_volatile() }
    }

    /// Counts `from` down, again and again; `control` is 1, or 0b1001 with interrupt.
    fn run(&self, from: u32, control: u32) {
        // SAFETY: registers of this device, used under a critical section or before anything runs.
        unsafe {
            self.register(0).write_volatile(0);
            self.register(2).write_volatile(from);
            self.register(1).write_volatile(from);
            self.register(0).write_volatile(control);
        }
    }

    /// Goes on from where it stands, or stops there.
    fn control(&self, control: u32) {
        // SAFETY: as above.
        unsafe { self.register(0).write_volatile(control) }
    }

    fn acknowledge(&self) {
        // SAFETY: as above.
        unsafe { self.register(3).write_volatile(1) }
    }
}

/// Timer 1 runs free and is extended to 64 bits, timer 0 is the alarm.
pub struct Time {
    alarm: Timer,
    counter: Timer,
    state: CriticalSectionMutex<RefCell<State>>,
}

struct State {
    queue: Queue,
    high: u32,
    low: u32,
}

/// Counts a µs, the unit of embassy-time here.
pub const PER_MICROSECOND: u32 = super::COUNTS_PER_SECOND / 1_000_000;
/// Longest alarm, half of what the counter can tell; whoever asked for a later one is asked again.
const LONGEST: u64 = 1 << 31;

embassy_time_driver::time_driver_impl!(static TIME: Time = Time {
    alarm: Timer { base: 0x4000_0000 },
    counter: Timer { base: 0x4000_1000 },
    state: CriticalSectionMutex::new(RefCell::new(State { queue: Queue::new(), high: 0, low: 0 })),
});

/// The board's time.
#[inline(always)]
pub fn time() -> &'static Time {
    &TIME
}

impl Time {
    /// Starts the counter.
    pub fn start(&self) {
        self.counter.run(u32::MAX, 1);
    }

    /// The counter's reading, 25 MHz.
    #[inline(always)]
    pub fn reading(&self) -> u32 {
        !self.counter.value()
    }

    /// Asked at least every 85 s, half the counter's range.
    fn counts(&self, state: &mut State) -> u64 {
        let low = self.reading();
        state.high += u32::from(low < state.low);
        state.low = low;
        u64::from(state.high) << 32 | u64::from(low)
    }

    /// Wakes who is due and sets the alarm for who is next.
    fn set(&self, state: &mut State) {
        let now = self.counts(state);
        let next = state.queue.next_expiration(now / u64::from(PER_MICROSECOND));
        let wait =
            next.saturating_mul(PER_MICROSECOND.into()).saturating_sub(now).clamp(1, LONGEST);
        self.alarm.run(wait as u32, 0b1001);
    }

    /// In the alarm's interrupt.
    pub fn ring(&self) {
        self.state.lock(|state| {
            self.alarm.control(0);
            self.alarm.acknowledge();
            self.set(&mut state.borrow_mut());
        });
    }

    /// Time stands still.
    pub fn hold(&self) {
        self.alarm.control(0);
        self.counter.control(0);
    }

    /// Time goes on.
    pub fn go_on(&self) {
        self.counter.control(1);
        self.state.lock(|state| self.set(&mut state.borrow_mut()));
    }
}

impl Driver for Time {
    fn now(&self) -> u64 {
        self.state.lock(|state| self.counts(&mut state.borrow_mut())) / u64::from(PER_MICROSECOND)
    }

    fn schedule_wake(&self, at: u64, waker: &Waker) {
        self.state.lock(|state| {
            let state = &mut *state.borrow_mut();
            if state.queue.schedule_wake(at, waker) {
                self.set(state);
            }
        });
    }
}
