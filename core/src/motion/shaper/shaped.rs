//! A motion that has passed a shaper.

use super::{Kink, MAX_PULSES, Shaper};
use crate::hub::HubState;
use crate::math::{Scalar, array};
use crate::motion::Segment;

/// Segments end to end, summed with their delayed copies: before its beginning a motion stays where
/// it begins, after its end where it ends.
///
/// No history is kept: a delay may be any number of ticks and a fraction, 0.1 Hz costs what 10 Hz
/// do. A tick evaluates one segment a pulse.
///
/// A delay moves the borders of segments into ticks, and there θ̈ jumps or kinks. [`Self::advance`]
/// takes a stepper through a tick with all that is in it.
///
/// ```
/// use stillbeam::model::EightElements;
/// use stillbeam::motion::{Limits, Plan, Shaped, Shaper, ShaperKind};
/// use stillbeam::stepper::{AnyMotion, Modal, Stepper};
/// use stillbeam::{HubState, Link, Move, Profile, Scene};
///
/// let motion = Move::To { profile: Profile::Quintic, duration: 1.0, to: 1.57 };
/// let plan = Plan::new(&motion, HubState::resting_at(0.0)?, &Limits::default(), 0.010)?;
/// let shaper = Shaper::new(ShaperKind::Zvd, 1.3, 0.0)?;
/// let segments = [plan.segments[0].cast::<f32>()];
/// let shaped = Shaped::new(&segments, &shaper, 0.010);
/// assert_eq!(shaped.ticks(), 177); // 77 of them added: 1/1.3 s
/// assert!((shaped.hub(177).angle.radians() - 1.57).abs() < 1e-6);
///
/// let scene = Scene::new(Link { length: 1.0, mass: 0.5, bending_stiffness: 6.9 });
/// let stepper = Modal::<f32, 2>::new(&EightElements::consistent(&scene)?, 0.010)?;
/// let mut state = stepper.equilibrium(&shaped.hub(0));
/// for k in 0..shaped.ticks() {
///     shaped.advance(&stepper, &mut state, k);
///     let setpoint = stepper.response::<AnyMotion>(&state, &shaped.hub(k + 1));
///     assert!(setpoint.torque.abs() < 3.0);
/// }
/// # Ok::<(), stillbeam::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
#[must_use]
pub struct Shaped<'a, T> {
    segments: &'a [Segment<T>],
    copies: [Delayed<T>; MAX_PULSES],
    count: usize,
    ticks: u32,
}

/// A copy of the motion: its share, and its delay in whole ticks and a part of one. Apart, so that
/// f32 resolves the part however long the delay and the motion are.
#[derive(Clone, Copy, Debug)]
struct Delayed<T> {
    share: T,
    whole: u32,
    part: T,
}

/// Time at which a segment begins or the motion ends: `part` ticks, 0 to 1, after tick `tick`.
#[derive(Clone, Copy)]
struct Border<T> {
    tick: u32,
    part: T,
}

/// Side of a jump of the acceleration from which the hub is evaluated.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Left,
    Right,
}

impl<'a, T: Scalar> Shaped<'a, T> {
    /// Segments of rest-to-rest moves, at least one, with setpoints every `tick` s.
    pub fn new(segments: &'a [Segment<T>], shaper: &Shaper, tick: f64) -> Self {
        let mut copies = [Delayed { share: T::ZERO, whole: 0, part: T::ZERO }; MAX_PULSES];
        for (copy, pulse) in copies.iter_mut().zip(shaper.pulses()) {
            let delay = pulse.delay / tick;
            let whole = libm::floor(delay + CLOSE);
            *copy = Delayed {
                share: T::from_f64(pulse.amplitude),
                whole: whole as u32,
                part: T::from_f64((delay - whole).max(0.0)),
            };
        }
        let base: u32 = segments.iter().map(Segment::count).sum();
        let added = libm::ceil(shaper.delay() / tick - CLOSE) as u32;
        Self { segments, copies, count: shaper.pulses().len(), ticks: base.saturating_add(added) }
    }

    /// Whole ticks it takes, the shaper's delay included.
    pub fn ticks(&self) -> u32 {
        self.ticks
    }

    /// The hub at tick `k` from the beginning; where it jumps, just after.
    pub fn hub(&self, k: u32) -> HubState<T> {
        self.at(k, Side::Right)
    }

    /// The hub at tick `k` from the beginning; where it jumps, just before.
    pub fn arrival(&self, k: u32) -> HubState<T> {
        self.at(k, Side::Left)
    }

    /// Jumps inside the tick from `k` to `k + 1`.
    pub fn kink(&self, k: u32) -> Kink<T> {
        let rest = [[T::ZERO; 4]; 2];
        let mut kink = Kink::NONE;
        for copy in &self.copies[..self.count] {
            let (mut first, mut last) = (0, None);
            let mut meet = |first, before, last: Option<&Segment<T>>, next: Option<&Segment<T>>| {
                let border = copy.border(first, before);
                if border.is_within(k) {
                    let [_, from] = last.map_or(rest, Segment::courses);
                    let [to, _] = next.map_or(rest, Segment::courses);
                    kink.add(T::ONE - border.part, copy.jumps(from, to));
                }
                border.tick > k
            };
            let behind = self.segments.iter().any(|segment| {
                let behind = meet(first, segment.ticks_before(), last, Some(segment));
                first += segment.count();
                last = Some(segment);
                behind
            });
            if !behind {
                meet(first, T::ZERO, last, None);
            }
        }
        kink
    }

    /// Ticks of the motion before it passed the shaper.
    fn base(&self) -> u32 {
        self.segments.iter().map(Segment::count).sum()
    }

    fn at(&self, k: u32, side: Side) -> HubState<T> {
        let mut sum = HubState::ZERO;
        let Some(first) = self.segments.first() else { return sum };
        let start = first.hub_at(-first.ticks_before()).angle;
        let mut turned = T::ZERO;
        for copy in &self.copies[..self.count] {
            let hub = self.delayed(copy, k, side);
            turned += copy.share * hub.angle.since(start);
            sum.rate += copy.share * hub.rate;
            sum.acceleration += copy.share * hub.acceleration;
        }
        sum.angle = start.plus(turned);
        (sum.sin, sum.cos) = sum.angle.sin_cos();
        sum
    }

    /// A copy of the motion at tick `k`.
    fn delayed(&self, copy: &Delayed<T>, k: u32, side: Side) -> HubState<T> {
        let still = |hub: HubState<T>| HubState { rate: T::ZERO, acceleration: T::ZERO, ..hub };
        let (mut segment, mut first, mut next) = (&self.segments[0], 0, 0);
        let mut begun = false;
        for candidate in self.segments {
            if !copy.border(next, candidate.ticks_before()).is_passed(k, side) {
                break;
            }
            (segment, first, begun) = (candidate, next, true);
            next += candidate.count();
        }
        if !begun {
            return still(segment.hub_at(-segment.ticks_before()));
        }
        if next == self.base() && copy.border(next, T::ZERO).is_passed(k, side) {
            return still(segment.hub_at(T::from_u32(segment.count())));
        }
        // The first tick of a segment may lie a part of a tick after its beginning.
        let since = i64::from(k) - i64::from(copy.whole) - i64::from(first);
        let whole = T::from_u32(since.unsigned_abs() as u32);
        segment.hub_at((if since < 0 { -whole } else { whole }) - copy.part)
    }
}

impl<T: Scalar> Delayed<T> {
    /// Time at which the copy passes a border that lies `before` ticks before the motion's tick
    /// `first`.
    fn border(&self, first: u32, before: T) -> Border<T> {
        let close = T::from_f64(f64::max(CLOSE, 16.0 * T::EPSILON.to_f64()));
        let (tick, part) = (first.saturating_add(self.whole), self.part - before);
        if part < -close {
            Border { tick: tick.saturating_sub(1), part: part + T::ONE }.snapped(close)
        } else {
            Border { tick, part }.snapped(close)
        }
    }

    /// The copy's share of the jumps from one course to another.
    fn jumps(&self, from: [T; 4], to: [T; 4]) -> [T; 4] {
        array(|n| self.share * (to[n] - from[n]))
    }
}

impl<T: Scalar> Border<T> {
    /// Moves the border onto a tick that it misses by rounding only.
    fn snapped(self, close: T) -> Self {
        if self.part < close {
            Self { part: T::ZERO, ..self }
        } else if self.part > T::ONE - close {
            Self { tick: self.tick.saturating_add(1), part: T::ZERO }
        } else {
            self
        }
    }

    /// True if it lies between the ticks `k` and `k + 1`.
    fn is_within(&self, k: u32) -> bool {
        self.tick == k && self.part > T::ZERO
    }

    /// True if tick `k`, seen from that side, lies behind it.
    fn is_passed(&self, k: u32, side: Side) -> bool {
        self.tick < k || self.tick == k && self.part == T::ZERO && side == Side::Right
    }
}

/// Ticks closer than this are one.
const CLOSE: f64 = 1e-9;
