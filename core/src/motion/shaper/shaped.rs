//! A motion that has passed a shaper.

use super::{MAX_PULSES, Shaper};
use crate::math::Scalar;
use crate::motion::{Hub, Segment};

/// Segments end to end, summed with their delayed copies: before its beginning a motion stays where
/// it begins, after its end where it ends.
///
/// No history is kept: a delay may be any number of ticks and a fraction, 0.1 Hz costs what 10 Hz
/// do. A tick evaluates one segment a pulse.
///
/// ```
/// use stillbeam::motion::{Limits, Plan, Shaped, Shaper, ShaperKind, Start};
/// use stillbeam::{Move, Profile};
///
/// let motion = Move::To { profile: Profile::Quintic, duration: 1.0, to: 1.57 };
/// let plan = Plan::new(&motion, Start::at_rest(0.0)?, &Limits::default(), 0.010)?;
/// let shaper = Shaper::new(ShaperKind::Zvd, 1.3, 0.0)?;
/// let segments = [plan.segments[0].cast::<f32>()];
/// let shaped = Shaped::new(&segments, &shaper, 0.010);
/// assert_eq!(shaped.ticks(), 177); // 77 of them added: 1/1.3 s
/// assert!((shaped.hub(177).angle.radians() - 1.57).abs() < 1e-6);
/// # Ok::<(), stillbeam::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Shaped<'a, T> {
    segments: &'a [Segment<T>],
    /// Share, and delay in ticks.
    pulses: [(T, T); MAX_PULSES],
    count: usize,
    ticks: u32,
}

impl<'a, T: Scalar> Shaped<'a, T> {
    /// Segments of rest-to-rest moves, at least one, with setpoints every `tick` s.
    pub fn new(segments: &'a [Segment<T>], shaper: &Shaper, tick: f64) -> Self {
        let mut pulses = [(T::ZERO, T::ZERO); MAX_PULSES];
        for (slot, pulse) in pulses.iter_mut().zip(shaper.pulses()) {
            *slot = (T::from_f64(pulse.amplitude), T::from_f64(pulse.delay / tick));
        }
        let base: u32 = segments.iter().map(Segment::count).sum();
        let added = libm::ceil(shaper.delay() / tick - 1e-9) as u32;
        Self { segments, pulses, count: shaper.pulses().len(), ticks: base + added }
    }

    /// Whole ticks it takes, the shaper's delay included.
    pub fn ticks(&self) -> u32 {
        self.ticks
    }

    /// The hub at tick `k` from the beginning.
    pub fn hub(&self, k: u32) -> Hub<T> {
        let mut sum = Hub::ZERO;
        let Some(first) = self.segments.first() else { return sum };
        let start = first.hub_at(-first.ticks_before()).angle;
        let (mut turned, k) = (T::ZERO, T::from_u32(k));
        for &(share, delay) in &self.pulses[..self.count] {
            let hub = self.unshaped(k - delay);
            turned += share * hub.angle.since(start);
            sum.rate += share * hub.rate;
            sum.acceleration += share * hub.acceleration;
        }
        sum.angle = start.plus(turned);
        (sum.sin, sum.cos) = sum.angle.sin_cos();
        sum
    }

    /// The motion itself, any number of ticks after its beginning.
    fn unshaped(&self, ticks: T) -> Hub<T> {
        let still = |hub: Hub<T>| Hub { rate: T::ZERO, acceleration: T::ZERO, ..hub };
        let first = &self.segments[0];
        if ticks < T::ZERO {
            return still(first.hub_at(-first.ticks_before()));
        }
        let (mut segment, mut left) = (first, ticks);
        for next in &self.segments[1..] {
            let length = T::from_u32(segment.count());
            if left < length - next.ticks_before() {
                break;
            }
            (segment, left) = (next, left - length);
        }
        let length = T::from_u32(segment.count());
        if left >= length { still(segment.hub_at(length)) } else { segment.hub_at(left) }
    }
}
