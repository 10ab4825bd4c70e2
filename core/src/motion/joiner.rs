//! Lays curves end to end whose borders may lie between the ticks.

use super::Segment;
use super::segment::Shape;
use crate::hub::{Angle, HubState};

/// Borders closer to a tick than this, in ticks, lie on it.
const CLOSE: f64 = 1e-7;

/// The end of a motion that is laid curve by curve, in f64.
///
/// Times are in ticks from the motion's beginning, which is a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Joiner {
    /// h, s.
    tick: f64,
    /// Ticks that belong to segments so far.
    ticks: u64,
    /// Time of the border, at most one tick before the tick number `ticks`.
    border: f64,
    /// The hub at the border; θ̈ from the left.
    here: HubState<f64>,
    last: Option<LastTick>,
}

/// The hub at the last tick before the border.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LastTick {
    angle: Angle<f64>,
    /// rad/s.
    rate: f64,
    /// rad/s².
    acceleration: f64,
    /// θ̈ at the end of the segment that holds the tick, rad/s².
    end_acceleration: f64,
    /// True if curves without a tick follow that segment.
    followed: bool,
}

/// A curve to be laid: its shape, its end and how it is there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curve {
    pub shape: Shape<f64>,
    /// Time of its end, ticks.
    pub until: f64,
    /// The hub at its end.
    pub end: HubState<f64>,
    /// θ̈ at its beginning, from the right, rad/s².
    pub begin_acceleration: f64,
}

impl Joiner {
    /// A motion that begins at a tick with the hub in state `start`.
    pub fn new(start: HubState<f64>, tick: f64) -> Self {
        Self { tick, ticks: 0, border: 0.0, here: start, last: None }
    }

    /// The hub at the border; its acceleration is the left-hand value.
    pub fn here(&self) -> &HubState<f64> {
        &self.here
    }

    /// Time of the border, ticks.
    pub fn border(&self) -> f64 {
        self.border
    }

    /// Ticks that belong to segments so far.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Appends a curve. Returns its segment, which holds no tick if none lies within the curve;
    /// none if the curve is as good as without duration.
    pub fn append(&mut self, curve: &Curve) -> Option<Segment<f64>> {
        let length = curve.until - self.border;
        let before = self.ticks as f64 - self.border;
        let before = if before < CLOSE { 0.0 } else { before };
        let until = snapped(curve.until);
        let count = (libm::ceil(until) - self.ticks as f64).max(0.0) as u32;
        let mut segment =
            (count > 0 || length > CLOSE).then(|| self.segment(curve, length, before, count));
        self.ticks += u64::from(count);
        (self.border, self.here) = (until, curve.end);
        if count > 0 {
            self.last = segment.map(|segment| {
                let HubState { angle, rate, acceleration, .. } =
                    segment.hub_at(f64::from(count - 1));
                let end_acceleration = curve.end.acceleration;
                LastTick { angle, rate, acceleration, end_acceleration, followed: false }
            });
        } else if let (Some(segment), Some(last)) = (&mut segment, &mut self.last) {
            last.followed = true;
            segment.set_kink_moment(self.border_moment());
        }
        segment
    }

    fn segment(&self, curve: &Curve, length: f64, before: f64, count: u32) -> Segment<f64> {
        let mut segment =
            Segment::new(self.here.angle, curve.shape, length, before, count, self.tick)
                .ending(curve.end.acceleration);
        if before == 0.0 {
            segment = segment.beginning(self.here.rate, curve.begin_acceleration);
            segment.set_kink_moment(self.border_moment());
        } else if count > 0 {
            segment.set_kink_moment(self.moment(&segment.hub(0)));
        }
        segment
    }

    /// True if the border is a tick.
    pub fn is_at_tick(&self) -> bool {
        self.ticks as f64 - self.border < CLOSE
    }

    /// Moment within the tick before of a border that is a tick: not zero if curves without a tick
    /// lie before it. Zero if the border lies inside a tick.
    fn border_moment(&self) -> f64 {
        let followed = self.last.is_some_and(|last| last.followed);
        if followed && self.is_at_tick() { self.moment(&self.here) } else { 0.0 }
    }

    /// Ends the motion: the hub keeps its rate from the border on. Returns its state at the first
    /// tick from there on, and the moment of the border within the tick before.
    pub fn finish(&self) -> (HubState<f64>, f64) {
        if self.is_at_tick() {
            let end = HubState::turning(self.here.angle, self.here.rate);
            return (end, self.border_moment());
        }
        let left = self.ticks as f64 - self.border;
        let turned = self.here.rate * left * self.tick / core::f64::consts::TAU;
        let end = HubState::turning(self.here.angle.plus(turned), self.here.rate);
        (end, self.moment(&end))
    }

    /// See [`Segment::kink_moment`]: `∫(½ − s)θ̈ ds` over the tick up to `next`, by parts
    /// `Δθ − ½(θ̇₀ + θ̇₁)`, less `−(θ̈₁ − θ̈₀)/12` of the parabola with ends θ̈₀ and θ̈₁.
    fn moment(&self, next: &HubState<f64>) -> f64 {
        let Some(last) = self.last else { return 0.0 };
        let turned = core::f64::consts::TAU * next.angle.since(last.angle) / self.tick;
        (turned - 0.5 * (last.rate + next.rate)) / self.tick
            + (last.end_acceleration - last.acceleration) / 12.0
    }
}

/// A time in ticks, moved onto a tick that it misses by rounding only.
fn snapped(time: f64) -> f64 {
    let whole = libm::round(time);
    if libm::fabs(time - whole) < CLOSE { whole } else { time }
}
