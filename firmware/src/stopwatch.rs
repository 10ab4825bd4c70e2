//! Counts what a piece of code costs.

/// A free-running counter.
pub trait Counter {
    /// Unit of its counts, as printed in the tables.
    const UNIT: &'static str;

    /// Starts it.
    fn start() -> Self;

    /// Keeps what is counted from moving out of the count.
    fn barrier();

    /// Raw reading; wraps.
    fn read(&self) -> u32;

    /// Raw readings `from` to `to` as counts.
    fn between(&self, from: u32, to: u32) -> u32;
}

/// Counts pieces of code, less what the counting itself costs.
pub struct Stopwatch<C> {
    counter: C,
    overhead: u32,
}

impl<C: Counter> Stopwatch<C> {
    /// Starts the counter and measures an empty piece of code.
    pub fn start() -> Self {
        let mut watch = Self { counter: C::start(), overhead: 0 };
        watch.overhead = watch.count(|| ()).1;
        watch
    }

    /// Returns the result of `work`, and its cost.
    #[inline(always)]
    pub fn count<R>(&self, work: impl FnOnce() -> R) -> (R, u32) {
        let from = self.counter.read();
        C::barrier();
        let result = work();
        C::barrier();
        let to = self.counter.read();
        (result, self.counter.between(from, to).saturating_sub(self.overhead))
    }
}
