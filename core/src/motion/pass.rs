//! Every profile from any state of the hub to an angle that is passed at a rate.

use core::f64::consts::{PI, TAU};

use heapless::Vec;

use super::joiner::{Curve, Joiner};
use super::piece::{Ends, Piece};
use super::plan::MAX_SEGMENTS;
use super::segment::Shape;
use super::{Peaks, Profile, Segment};
use crate::hub::HubState;
use crate::math::Scalar;

/// Share of a cycloid's time in which an acceleration at its beginning goes.
const FADE: f64 = 0.125;

/// Jump of the acceleration, of its peak, that counts as none.
const JUMP: f64 = 1e-9;

/// Curves of a motion, first to last, and its greatest magnitudes.
pub(super) struct Pass {
    pub curves: Vec<Curve, MAX_SEGMENTS>,
    pub peaks: Peaks,
    /// The hub where the next curve begins; θ̈ from the left.
    here: HubState<f64>,
    /// Time of that, s.
    time: f64,
    tick: f64,
}

impl Pass {
    /// The motion from `start` to `end`, which turns without acceleration, in `duration` s.
    ///
    /// - Cubic: the cubic with these angles and rates; the acceleration jumps at both ends.
    /// - Quintic: the quintic with these angles, rates and accelerations.
    /// - Cycloid: a spin-up by the change of the rate, and a cycloid by what is left of the turn.
    ///   An acceleration at its beginning goes evenly in the first eighth of the time.
    /// - Trapezoid: constant acceleration, rate, deceleration, a third of the time each.
    /// - S-curve: sevenths, in which the acceleration goes to a peak, stays, goes to 0, stays, and
    ///   the same again. The peaks follow from the rate in the middle, and that from the turn.
    #[inline(never)]
    pub fn new(
        profile: Profile,
        start: HubState<f64>,
        end: HubState<f64>,
        duration: f64,
        tick: f64,
    ) -> Self {
        let peaks = Peaks { rate: start.rate.abs(), acceleration: 0.0, jerk: 0.0 };
        let mut pass = Self { curves: Vec::new(), peaks, here: start, time: 0.0, tick };
        match profile {
            Profile::Cubic | Profile::Quintic => pass.polynomial(profile, end, duration),
            Profile::Cycloid => pass.cycloid(end, duration),
            Profile::Trapezoid | Profile::SCurve => pass.stretches(profile, end, duration),
        }
        pass
    }

    /// Hands the segments of the motion, which begins at a tick with the hub in the state `start`,
    /// to `sink`, first to last.
    pub fn emit<T: Scalar>(&self, start: HubState<f64>, sink: &mut dyn FnMut(&Segment<T>)) {
        let mut joiner = Joiner::new(start, self.tick);
        for curve in &self.curves {
            if let Some(segment) = joiner.append(curve) {
                sink(&segment.cast());
            }
        }
    }

    fn polynomial(&mut self, profile: Profile, end: HubState<f64>, duration: f64) {
        let here = self.here;
        let turn = end.angle.since(here.angle);
        let ends = Ends::new(turn, [here.rate, end.rate], [here.acceleration, 0.0], duration);
        let (piece, accelerations) = if profile == Profile::Cubic {
            let cubic = ends.cubic();
            (cubic, cubic.accelerations(duration))
        } else {
            (ends.quintic(), [here.acceleration, 0.0])
        };
        self.lay(piece.shape(), end, accelerations, duration, piece.peaks(duration));
        self.end();
    }

    fn cycloid(&mut self, end: HubState<f64>, mut duration: f64) {
        if self.here.acceleration != 0.0 {
            let fade = FADE * duration;
            self.stretch([self.here.acceleration, 0.0], fade, None);
            duration -= fade;
        }
        let here = self.here;
        // Turns at the rate of the beginning, by the change of the rate, and by the cycloid.
        let [old, change] = [here.rate, end.rate - here.rate].map(|rate| rate * duration / TAU);
        let rest = end.angle.since(here.angle) - old - 0.5 * change;
        let c2 = 0.125 * change;
        let shape = Shape::Harmonic {
            c: [0.5 * old + 2.0 * c2 + 0.5 * rest, c2],
            a: rest / TAU,
            b: -change / (TAU * TAU),
        };
        // θ̈T² = change(1 − cos 2πs) + 2πrest sin 2πs turns; θ̇ has its peak where that is 0.
        let swing = libm::hypot(change, TAU * rest);
        let x = libm::atan2(-TAU * rest, change);
        let x = 2.0 * if x < 0.0 { x + PI } else { x };
        let (sin, cos) = (libm::sin(x), libm::cos(x));
        let middle = old + change * (x - sin) / TAU + rest * (1.0 - cos);
        let per_second = TAU / duration;
        let peaks = Peaks {
            rate: here.rate.abs().max(end.rate.abs()).max(per_second * middle.abs()),
            acceleration: per_second * (change.abs() + swing) / duration,
            jerk: per_second * TAU * swing / (duration * duration),
        };
        self.lay(shape, end, [0.0, 0.0], duration, peaks);
    }

    /// Stretches of equal time in which θ̈ is a straight line.
    fn stretches(&mut self, profile: Profile, end: HubState<f64>, duration: f64) {
        let start = self.here;
        let turn = TAU * end.angle.since(start.angle);
        // The turn grows evenly with the rate in the middle.
        let turned = |middle: f64| {
            let (stretches, each) = table(profile, &start, end.rate, middle, duration);
            let add = |(angle, rate): (f64, f64), [from, to]: &[f64; 2]| {
                let gained = 0.5 * (from + to) * each;
                (angle + rate * each + each * each * (2.0 * from + to) / 6.0, rate + gained)
            };
            stretches.iter().fold((0.0, start.rate), add).0
        };
        let still = turned(0.0);
        let middle = (turn - still) / (turned(1.0) - still);
        let (stretches, each) = table(profile, &start, end.rate, middle, duration);
        let last = stretches.len() - 1;
        for (i, accelerations) in stretches.iter().enumerate() {
            self.stretch(*accelerations, each, (i == last).then_some(end));
        }
        self.end();
    }

    /// A stretch of `duration` s in which θ̈ goes evenly from one value to another, up to `end` if
    /// that is known.
    fn stretch(&mut self, accelerations: [f64; 2], duration: f64, end: Option<HubState<f64>>) {
        let [from, to] = accelerations;
        let here = self.here;
        let rate = here.rate + 0.5 * (from + to) * duration;
        let turned = (here.rate + duration * (2.0 * from + to) / 6.0) * duration / TAU;
        let end = end.unwrap_or(HubState::turning(here.angle.plus(turned), rate));
        let turn = end.angle.since(here.angle);
        let piece: Piece<f64> =
            Ends::new(turn, [here.rate, end.rate], accelerations, duration).cubic();
        self.lay(piece.shape(), end, accelerations, duration, piece.peaks(duration));
    }

    /// Appends a curve to `end`.
    fn lay(
        &mut self,
        shape: Shape<f64>,
        end: HubState<f64>,
        [begin_acceleration, acceleration]: [f64; 2],
        duration: f64,
        peaks: Peaks,
    ) {
        self.time += duration;
        let most = self.peaks.acceleration.max(peaks.acceleration);
        let jumps = (begin_acceleration - self.here.acceleration).abs() > JUMP * most;
        let jerk = if jumps { f64::INFINITY } else { self.peaks.jerk.max(peaks.jerk) };
        self.peaks = Peaks { rate: self.peaks.rate.max(peaks.rate), acceleration: most, jerk };
        let end = HubState { acceleration, ..end };
        let curve = Curve { shape, until: self.time / self.tick, end, begin_acceleration };
        // No profile has more.
        let _ = self.curves.push(curve);
        self.here = end;
    }

    /// Takes note of a jump of the acceleration at the end.
    fn end(&mut self) {
        if self.here.acceleration.abs() > JUMP * self.peaks.acceleration {
            self.peaks.jerk = f64::INFINITY;
        }
    }
}

/// θ̈ at both ends of every stretch for a rate `middle` in the middle of the motion, and the time
/// of a stretch, s.
fn table(
    profile: Profile,
    start: &HubState<f64>,
    end_rate: f64,
    middle: f64,
    duration: f64,
) -> (Vec<[f64; 2], MAX_SEGMENTS>, f64) {
    let rows: &[[f64; 2]] = if profile == Profile::Trapezoid {
        let each = duration / 3.0;
        let (up, down) = ((middle - start.rate) / each, (end_rate - middle) / each);
        &[[up, up], [0.0, 0.0], [down, down]]
    } else {
        let (each, first) = (duration / 7.0, start.acceleration);
        let up = 0.5 * ((middle - start.rate) / each - 0.5 * first);
        let down = 0.5 * (end_rate - middle) / each;
        &[[first, up], [up, up], [up, 0.0], [0.0, 0.0], [0.0, down], [down, down], [down, 0.0]]
    };
    (rows.iter().copied().collect(), duration / rows.len() as f64)
}
