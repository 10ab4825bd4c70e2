//! Cuts a move into segments. Runs once a move, in f64.

use core::f64::consts::TAU;

use heapless::Vec;

use super::segment::Shape;
use super::{Angle, Limits, Move, Peaks, Profile, Segment};
use crate::Error;

/// Segments of the longest plan, an S-curve.
pub const MAX_SEGMENTS: usize = 7;

/// Where a move begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// θ.
    pub angle: Angle<f64>,
    /// θ̇, rad/s.
    pub rate: f64,
}

impl Start {
    /// At rest at `from` rad.
    pub fn at_rest(from: f64) -> Result<Self, Error> {
        let from = Error::check("move.from", from, -MAX_ANGLE, MAX_ANGLE, "rad")?;
        Ok(Self { angle: Angle::from_radians(from), rate: 0.0 })
    }
}

/// What a move comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline {
    /// Where it ends: the next move's start.
    pub end: Start,
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
    pub fn new(motion: &Move, start: Start, limits: &Limits, tick: f64) -> Result<Self, Error> {
        let mut segments = Vec::new();
        let outline = lay(motion, start, limits, tick, &mut |segment| {
            // No move has more.
            let _ = segments.push(*segment);
        })?;
        Ok(Self { segments, outline })
    }
}

/// Plans `motion` and hands its segments to `sink`, first to last; none if it is refused.
pub(crate) fn lay(
    motion: &Move,
    start: Start,
    limits: &Limits,
    tick: f64,
    sink: &mut dyn FnMut(&Segment<f64>),
) -> Result<Outline, Error> {
    let ticks = motion.ticks(tick)?;
    let duration = f64::from(ticks) * tick;
    let turned = |rate: f64| rate * duration / TAU;
    let (shapes, end, peaks) = match *motion {
        Move::To { profile, to, .. } => {
            let to = Error::check("move.to", to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
            if start.rate != 0.0 {
                return Err(Error::NotAtRest { rate: start.rate });
            }
            let delta = to / TAU - start.angle.in_turns();
            let end = Start { angle: start.angle.plus(delta), rate: 0.0 };
            (rest_to_rest(profile, delta), end, profile.peaks(delta * TAU, duration))
        }
        Move::SpinUp { rate, .. } => {
            let rate = Error::check("move.rate", rate, -MAX_ANGLE, MAX_ANGLE, "rad/s")?;
            let change = rate - start.rate;
            let mean = 0.5 * (rate + start.rate);
            let end = Start { angle: start.angle.plus(turned(mean)), rate };
            let peaks = Peaks {
                rate: rate.abs().max(start.rate.abs()),
                acceleration: 2.0 * change.abs() / duration,
                jerk: TAU * change.abs() / (duration * duration),
            };
            (Shapes::One(spin_up(turned(start.rate), turned(change))), end, peaks)
        }
        Move::Dwell { .. } => {
            let angle = start.angle.plus(turned(start.rate));
            let peaks = Peaks { rate: start.rate.abs(), acceleration: 0.0, jerk: 0.0 };
            (Shapes::Hold, Start { angle, rate: start.rate }, peaks)
        }
    };
    limits.admit(&peaks)?;
    if peaks.rate * tick > 1.0 {
        return Err(Error::TooFast { rate: peaks.rate, max: 1.0 / tick });
    }
    match shapes {
        Shapes::Hold => sink(&Segment::cruise(start.angle, start.rate, ticks, tick)),
        Shapes::One(shape) => {
            sink(&Segment::new(start.angle, shape, f64::from(ticks), 0.0, ticks, tick));
        }
        Shapes::Cubics(pieces, turn) => lay_cubics(pieces, turn, start.angle, ticks, tick, sink),
    }
    Ok(Outline { end, ticks, peaks, rounded_by: duration - motion.duration() })
}

/// The formulas of a move.
enum Shapes {
    /// Constant rate, exact over any number of turns.
    Hold,
    One(Shape<f64>),
    /// Equal shares of the move's time, of a turn by 1, and the turn.
    Cubics(&'static [[f64; 3]], f64),
}

/// Largest angle and rate that a move may name: 1e6 rad resolve to 1e-10 rad.
const MAX_ANGLE: f64 = 1e6;

/// Turns by `d`.
fn rest_to_rest(profile: Profile, d: f64) -> Shapes {
    match profile {
        Profile::Cubic => Shapes::Cubics(&[[0.75, 0.0, -0.25]], d),
        Profile::Quintic => {
            Shapes::One(Shape::Quintic([15.0, 0.0, -10.0, 0.0, 3.0].map(|c| c * d / 16.0)))
        }
        Profile::Cycloid => Shapes::One(Shape::Harmonic { c: [0.5 * d, 0.0], a: d / TAU, b: 0.0 }),
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
const fn integrate<const N: usize>(stretches: [(f64, f64); N]) -> [[f64; 3]; N] {
    let f = 1.0 / N as f64;
    let mut cubics = [[0.0; 3]; N];
    let (mut rate, mut i) = (0.0, 0);
    while i < N {
        let (a, j) = stretches[i];
        // c₁s + c₂s² + c₃s³ about s = ½.
        let (c1, c2, c3) = (rate * f, a * f * f / 2.0, j * f * f * f / 6.0);
        cubics[i] = [(c1 + c2 + 0.75 * c3) / 2.0, (c2 + 1.5 * c3) / 4.0, c3 / 8.0];
        rate += (a + j * f / 2.0) * f;
        i += 1;
    }
    cubics
}

/// `v` turns at the old rate, and half of `dv` more by the end:
/// `Δ = v s + dv [s²/2 + (cos 2πs − 1)/4π²]`, about `s = ½`.
fn spin_up(v: f64, dv: f64) -> Shape<f64> {
    Shape::Harmonic { c: [v / 2.0 + dv / 4.0, dv / 8.0], a: 0.0, b: -dv / (TAU * TAU) }
}

/// Lays cubics end to end over `ticks` ticks. A stretch that contains no tick is left out.
fn lay_cubics(
    pieces: &[[f64; 3]],
    turn: f64,
    start: Angle<f64>,
    ticks: u32,
    tick: f64,
    sink: &mut dyn FnMut(&Segment<f64>),
) {
    let length = f64::from(ticks) / pieces.len() as f64;
    let (mut angle, mut first, mut last) = (start, 0.0, None::<Segment<f64>>);
    for (i, piece) in pieces.iter().enumerate() {
        let next = first_tick((i + 1) as f64 * length).min(f64::from(ticks));
        let before = (first - i as f64 * length).max(0.0);
        let shape = Shape::Cubic(piece.map(|c| c * turn));
        let segment = Segment::new(angle, shape, length, before, (next - first) as u32, tick);
        if next > first {
            let segment = last.map_or(segment, |last| segment.behind(&last, tick));
            sink(&segment);
            last = Some(segment);
        }
        (angle, first) = (segment.end(), next);
    }
}

/// The first whole tick at or after `t` ticks, with room for the rounding of thirds and sevenths.
fn first_tick(t: f64) -> f64 {
    libm::ceil(t - 1e-6)
}
