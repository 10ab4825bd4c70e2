//! Cuts a move into segments. Runs once a move: where it begins and ends in f64, what the tick
//! evaluates in the tick's own precision.

use core::f64::consts::TAU;

use heapless::Vec;

use super::demand::Demand;
use super::segment::Shape;
use super::{Limits, Move, Peaks, Profile, Remedy, Segment, curve_peaks};
use crate::Error;
use crate::hub::{Angle, HubState, MAX_ANGLE};
use crate::math::Scalar;

/// Segments of the longest plan, an S-curve.
pub const MAX_SEGMENTS: usize = 7;

/// What a move comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline {
    /// Where it ends: the next move's start.
    pub end: HubState<f64>,
    /// Whole ticks it takes.
    pub ticks: u32,
    /// Greatest magnitudes.
    pub peaks: Peaks,
    /// Duration as planned less duration as asked for, s: what rounding to whole ticks changed.
    pub rounded_by: f64,
}

/// A move that was accepted: its segments and where it ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The motion, first to last.
    pub segments: Vec<Segment<f64>, MAX_SEGMENTS>,
    /// What it comes to.
    pub outline: Outline,
}

impl Plan {
    /// Plans `motion` from `start`, with setpoints every `tick` s.
    ///
    /// # Errors
    /// A parameter of the move out of range, a limit that it exceeds (see [`Self::remedy`]), or a
    /// limit of torque or moment, which a plan of the hub's motion cannot check.
    pub fn new(
        motion: &Move,
        start: HubState<f64>,
        limits: &Limits,
        tick: f64,
    ) -> Result<Self, Error> {
        let mut segments = Vec::new();
        let outline = lay(motion, start, limits, tick, &mut |segment| {
            // No move has more.
            let _ = segments.push(*segment);
        })?;
        Ok(Self { segments, outline })
    }

    /// What would keep the limits, for a move that [`Self::new`] refuses for one of them: the shortest
    /// duration in whole ticks that keeps every limit of the motion and a radian a tick, or why none
    /// does.
    pub fn remedy(motion: &Move, start: HubState<f64>, limits: &Limits, tick: f64) -> Remedy {
        let demand = match *motion {
            Move::To { profile, to, .. } => {
                Demand::Turn(profile, to - TAU * start.angle.in_turns())
            }
            Move::SpinUp { rate, .. } => Demand::Spin { from: start.rate, to: rate },
            Move::Dwell { .. } => Demand::Hold(start.rate),
            // In another time it is another curve.
            Move::Still { .. } => return Remedy::Longer,
        };
        demand.remedy(limits, tick)
    }
}

/// Plans `motion` and hands its segments to `sink`, first to last; none if it is refused.
pub(crate) fn lay<T: Scalar>(
    motion: &Move,
    start: HubState<f64>,
    limits: &Limits,
    tick: f64,
    sink: &mut dyn FnMut(&Segment<T>),
) -> Result<Outline, Error> {
    let ticks = motion.ticks(tick)?;
    let duration = f64::from(ticks) * tick;
    let turned = |rate: f64| rate * duration / TAU;
    let limits = limits.of_motion()?;
    let (shapes, end, demand) = match *motion {
        Move::To { profile, to, .. } => {
            let to = Error::check("move.to", to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
            if start.rate != 0.0 {
                return Err(Error::NotAtRest { rate: start.rate });
            }
            let (delta, end) = turn_to(to, &start);
            (rest_to_rest(profile, delta), end, Demand::Turn(profile, delta * TAU))
        }
        Move::SpinUp { rate, .. } => {
            let rate = Error::check("move.rate", rate, -MAX_ANGLE, MAX_ANGLE, "rad/s")?;
            let change = rate - start.rate;
            let mean = 0.5 * (rate + start.rate);
            let end = HubState::turning(start.angle.plus(turned(mean)), rate);
            let demand = Demand::Spin { from: start.rate, to: rate };
            let (old, change) = (turned(start.rate), turned(change));
            (Shapes::One(spin_up(T::from_f64(old), T::from_f64(change))), end, demand)
        }
        Move::Still { to, bulge, .. } => {
            let to = Error::check("move.to", to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
            if start.rate != 0.0 {
                return Err(Error::NotAtRest { rate: start.rate });
            }
            for b in bulge {
                Error::check("move.bulge", b, -MAX_ANGLE, MAX_ANGLE, "rad")?;
            }
            let (delta, end) = turn_to(to, &start);
            let (c, d) = (quintic(T::from_f64(delta)), bulge.map(|b| T::from_f64(b / TAU)));
            let demand = Demand::Curve(curve_peaks(&c, &d, duration));
            (Shapes::One(Shape::Bulged { c, d }), end, demand)
        }
        Move::Dwell { .. } => {
            let angle = start.angle.plus(turned(start.rate));
            (Shapes::Hold, HubState::turning(angle, start.rate), Demand::Hold(start.rate))
        }
    };
    let peaks = demand.admit(&limits, ticks, tick)?;
    match shapes {
        Shapes::Hold => sink(&Segment::cruise(start.angle, start.rate, ticks, tick)),
        Shapes::One(shape) => {
            let length = T::from_u32(ticks);
            let segment = Segment::new(start.angle, shape, length, T::ZERO, ticks, tick);
            // Every shape of one piece begins and ends without acceleration.
            let rate = T::from_f64(start.rate);
            sink(&segment.beginning(rate, T::ZERO).landing_with(T::ZERO));
        }
        Shapes::Cubics(pieces, turn) => lay_cubics(pieces, turn, start.angle, ticks, tick, sink),
    }
    Ok(Outline { end, ticks, peaks, rounded_by: duration - motion.duration() })
}

/// Turns from `start` to the angle `to` in rad, and the rest there: exactly that angle, whatever the
/// turns round to.
#[inline(always)]
fn turn_to(to: f64, start: &HubState<f64>) -> (f64, HubState<f64>) {
    let end = HubState::at_rest(Angle::from_radians(to));
    (end.angle.since(start.angle), end)
}

/// The formulas of a move.
enum Shapes<T> {
    /// Constant rate, exact over any number of turns.
    Hold,
    One(Shape<T>),
    /// Equal shares of the move's time, of a turn by 1, and the turn.
    Cubics(&'static [Piece], f64),
}

/// A share of a move by 1 in a time of 1.
struct Piece {
    /// Where it begins, the rate there, and the accelerations at its beginning and end.
    start: f64,
    rate: f64,
    accelerations: [f64; 2],
    /// About its middle, `[c₁, c₂, c₃]`.
    cubic: [f64; 3],
}

/// The cubic `3s² − 2s³`.
const CUBIC: Piece =
    Piece { start: 0.0, rate: 0.0, accelerations: [6.0, -6.0], cubic: [0.75, 0.0, -0.25] };

/// A quintic's coefficients, of a turn by `turn`.
fn quintic<T: Scalar>(turn: T) -> [T; 5] {
    let n = T::from_f64;
    [n(0.9375), T::ZERO, n(-0.625), T::ZERO, n(0.1875)].map(|c| c * turn)
}

/// Turns by `d`.
fn rest_to_rest<T: Scalar>(profile: Profile, d: f64) -> Shapes<T> {
    let (n, turn) = (T::from_f64, T::from_f64(d));
    match profile {
        Profile::Cubic => Shapes::Cubics(&[CUBIC], d),
        Profile::Quintic => Shapes::One(Shape::Quintic(quintic(turn))),
        Profile::Cycloid => Shapes::One(Shape::Harmonic {
            c: [T::HALF * turn, T::ZERO],
            a: turn / n(TAU),
            b: T::ZERO,
        }),
        Profile::Trapezoid => {
            Shapes::Cubics(const { &integrate([(4.5, 0.0), (0.0, 0.0), (-4.5, 0.0)]) }, d)
        }
        Profile::SCurve => Shapes::Cubics(const { &integrate(S_CURVE) }, d),
    }
}

/// Acceleration at the beginning of each seventh, and its jerk, of a turn by 1 in a time of 1.
const S_CURVE: [(f64, f64); 7] = {
    let (a, j) = (6.125, 42.875);
    [(0.0, j), (a, 0.0), (a, -j), (0.0, 0.0), (0.0, -j), (-a, 0.0), (-a, j)]
};

/// Cubics about their middles for `N` equal stretches `(acceleration at its beginning, jerk)`, per
/// T² and T³, from rest.
const fn integrate<const N: usize>(stretches: [(f64, f64); N]) -> [Piece; N] {
    let f = 1.0 / N as f64;
    let mut pieces = [const { CUBIC }; N];
    let (mut start, mut rate, mut i) = (0.0, 0.0, 0);
    while i < N {
        let (a, j) = stretches[i];
        // c₁s + c₂s² + c₃s³ about s = ½.
        let (c1, c2, c3) = (rate * f, a * f * f / 2.0, j * f * f * f / 6.0);
        let cubic = [(c1 + c2 + 0.75 * c3) / 2.0, (c2 + 1.5 * c3) / 4.0, c3 / 8.0];
        pieces[i] = Piece { start, rate, accelerations: [a, a + j * f], cubic };
        start += c1 + c2 + c3;
        rate += (a + j * f / 2.0) * f;
        i += 1;
    }
    pieces
}

/// `v` turns at the old rate, and half of `dv` more by the end:
/// `Δ = v s + dv [s²/2 + (cos 2πs − 1)/4π²]`, about `s = ½`.
fn spin_up<T: Scalar>(v: T, dv: T) -> Shape<T> {
    let c2 = T::from_f64(0.125) * dv;
    let b = T::from_f64(-1.0 / (TAU * TAU)) * dv;
    Shape::Harmonic { c: [T::HALF * v + T::TWO * c2, c2], a: T::ZERO, b }
}

/// Lays cubics end to end over `ticks` ticks. A stretch that contains no tick is left out.
fn lay_cubics<T: Scalar>(
    pieces: &[Piece],
    turn: f64,
    start: Angle<f64>,
    ticks: u32,
    tick: f64,
    sink: &mut dyn FnMut(&Segment<T>),
) {
    let share = pieces.len() as u32;
    let length = T::from_u32(ticks) / T::from_u32(share);
    let shares = |n: u32| T::from_u32(n) / T::from_u32(share);
    // Borders are multiples of a tick's share, counted in integers: at most 7 × 2²⁴ of them.
    // 2π/D and 2π/D²: rates and accelerations at the borders, rounded once.
    let duration = f64::from(ticks) * tick;
    let rate_scale = TAU * turn / duration;
    let acceleration_scale = rate_scale / duration;
    let (mut first, mut border, mut entry) = (0, 0, T::ZERO);
    for piece in pieces {
        let end = border + ticks;
        let next = end.div_ceil(share);
        let (before, after) = (shares(first * share - border), shares(next * share - end));
        let shape = Shape::Cubic(piece.cubic.map(|c| T::from_f64(c) * T::from_f64(turn)));
        let start = start.plus(piece.start * turn);
        let [begin, landing] = piece.accelerations.map(|a| T::from_f64(acceleration_scale * a));
        let mut segment =
            Segment::new(start, shape, length, before, next - first, tick).landing_with(landing);
        if before == T::ZERO {
            segment = segment.beginning(T::from_f64(rate_scale * piece.rate), begin);
        }
        let [at_first, at_last] = segment.accelerations();
        if next == first {
            entry += moment(T::ONE - before, T::ONE - after, begin, landing);
        } else {
            if before == T::ZERO {
                entry = T::ZERO;
            }
            entry += moment(T::ONE - before, T::ONE, begin, at_first);
            segment.enter(entry);
            sink(&segment);
            // The tick's parabola goes up to the left-hand value at the border.
            let parabola = T::from_f64(1.0 / 12.0) * (at_last - landing);
            entry = moment(T::ZERO, T::ONE - after, at_last, landing) - parabola;
        }
        (first, border) = (next, end);
    }
}

/// `∫ (½ − x) θ̈ dx` over the part `a..b` of a tick `0..1`, in which θ̈ goes straight from `from` to
/// `to`.
fn moment<T: Scalar>(a: T, b: T, from: T, to: T) -> T {
    let n = T::from_f64;
    let length = b - a;
    length * (n(0.25) * (T::ONE - a - b) * (from + to) - n(1.0 / 12.0) * length * (to - from))
}
