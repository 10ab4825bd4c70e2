//! Whether ticks come when they should, from any free-running counter.

/// The ticks' due times.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    period: u32,
    due: Option<u32>,
}

/// How a tick came.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Timing {
    /// Counts after its due time.
    pub late: u32,
    /// Whole ticks that did not take place before it.
    pub missed: u32,
}

impl Pace {
    /// A tick every `period` counts, at least one; the first one is never late.
    pub fn new(period: u32) -> Self {
        Self { period: period.max(1), due: None }
    }

    /// A tick at counter reading `now`; readings wrap. Missed ticks are not made up for: the next
    /// one is due a period after the one that came in place of them was.
    #[inline(always)]
    pub fn arrive(&mut self, now: u32) -> Timing {
        let since = self.due.map_or(0, |due| now.wrapping_sub(due));
        // A tick before its time reads as far beyond the half of the range.
        let since = if since > u32::MAX / 2 { 0 } else { since };
        let (missed, late) = (since / self.period, since % self.period);
        self.due = Some(now.wrapping_sub(late).wrapping_add(self.period));
        Timing { late, missed }
    }
}
