//! Tells ticks that come in time from late, missed and early ones, by any free-running counter.

/// The due times of the ticks: one every period, in a fixed phase.
///
/// The tick that is due next may come from half a period before its time to a period after it. What
/// comes earlier is an extra tick, such as those of a burst after a freeze: it is not due, and no
/// setpoint may be made for it. What comes later has missed its time, and stands for a later tick.
/// In any `n` periods (`n` to the nearest) no more than `n + 1` ticks are due, however they come.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    period: u32,
    due: Option<u32>,
}

/// Timing of a tick against its due time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Timing {
    /// True if a tick is to be made. False if it came more than half a period early.
    pub due: bool,
    /// Counts before its due time.
    pub early: u32,
    /// Counts after its due time.
    pub late: u32,
    /// Whole ticks that did not take place before it.
    pub missed: u32,
}

/// Longest period, a quarter of the counter's range: early and late ticks can be told apart.
const LONGEST: u32 = 1 << 30;

impl Pace {
    /// A tick every `period` counts, 1 to 2³⁰; what lies outside is brought to the nearer end. The
    /// first tick is always due. [`Pace::period`] gives the counts of a tick in seconds.
    pub fn new(period: u32) -> Self {
        Self { period: period.clamp(1, LONGEST), due: None }
    }

    /// Counts of a clock in a tick of `tick` s: `tick × per_second`. `None` unless that is a whole
    /// number from 1 to 2³⁰, to 1e-9 of itself; with a fraction the ticks would drift in phase.
    pub const fn period(tick: f64, per_second: u32) -> Option<u32> {
        let exact = tick * per_second as f64;
        if !(exact >= 0.5 && exact <= LONGEST as f64) {
            return None;
        }
        let whole = (exact + 0.5) as u32;
        if (exact - whole as f64).abs() <= 1e-9 * exact { Some(whole) } else { None }
    }

    /// Judges a tick at counter reading `now`; readings wrap. Missed ticks are not made up for, and
    /// neither lateness nor earliness shifts the due times of later ticks.
    ///
    /// The length of a freeze is right up to the counter's range less one and a half periods.
    #[inline(always)]
    pub fn arrive(&mut self, now: u32) -> Timing {
        let due = self.due.unwrap_or(now);
        let half = self.period / 2;
        // No tick comes more than that before the next due time: a tick that is half a period early
        // moves it a period ahead.
        let ahead = due.wrapping_sub(now);
        let early = if ahead <= self.period + half { ahead } else { 0 };
        if early > half {
            return Timing { due: false, early, late: 0, missed: 0 };
        }
        let since = now.wrapping_add(early).wrapping_sub(due);
        let (missed, late) = (since / self.period, since % self.period);
        let slot = now.wrapping_add(early).wrapping_sub(late);
        self.due = Some(slot.wrapping_add(self.period));
        Timing { due: true, early, late, missed }
    }
}

#[cfg(test)]
mod tests {
    use super::{Pace, Timing};

    #[test]
    fn a_period_is_a_whole_number_of_counts() {
        assert_eq!(Pace::period(0.010, 1_000_000), Some(10_000));
        assert_eq!(Pace::period(1.0 / 3.0, 1_000), None, "333.3 counts would drift");
        assert_eq!(Pace::period(0.0, 1_000), None);
        assert_eq!(Pace::period(f64::NAN, 1_000), None);
    }

    /// Ticks at 0, 103, 350 and 400 of a period of 100: one late, one and a half missed, one in
    /// time.
    #[test]
    fn lateness_does_not_shift_later_ticks() {
        let mut pace = Pace::new(100);
        let timing = |late, missed| Timing { due: true, early: 0, late, missed };
        assert_eq!(pace.arrive(0), timing(0, 0));
        assert_eq!(pace.arrive(103), timing(3, 0));
        assert_eq!(pace.arrive(350), timing(50, 1));
        assert_eq!(pace.arrive(400), timing(0, 0));
    }

    #[test]
    fn a_tick_more_than_half_a_period_early_is_not_due() {
        let mut pace = Pace::new(100);
        assert!(pace.arrive(u32::MAX - 9).due, "the counter wraps before the next");
        assert_eq!(pace.arrive(30).early, 60);
        assert!(!pace.arrive(30).due);
        assert_eq!(pace.arrive(45), Timing { due: true, early: 45, late: 0, missed: 0 });
        assert_eq!(pace.arrive(190), Timing { due: true, early: 0, late: 0, missed: 0 });
    }
}
