//! The formulas behind each kind of move, over a time and a turn of 1.

use core::f64::consts::TAU;

use super::Profile;
use super::segment::Shape;
use crate::math::{Each, Scalar};

/// The formulas of a move.
pub(super) enum Shapes<T> {
    /// Constant rate, exact over any number of turns.
    Hold,
    /// One formula from beginning to end.
    One(Shape<T>),
    /// Pieces of equal duration, for a turn by 1, and the actual turn.
    Cubics(&'static [Piece], f64),
}

/// A piece of a move by 1 in a time of 1.
pub(super) struct Piece {
    /// Position and rate at its beginning, and accelerations at its beginning and end.
    pub start: f64,
    pub rate: f64,
    pub accelerations: [f64; 2],
    /// Coefficients `[c₁, c₂, c₃]` about its middle.
    pub cubic: [f64; 3],
}

/// The cubic `3s² − 2s³`.
const CUBIC: Piece =
    Piece { start: 0.0, rate: 0.0, accelerations: [6.0, -6.0], cubic: [0.75, 0.0, -0.25] };

/// Coefficients `c₁ … c₅` of the quintic that turns by `turn`, in turns.
pub(super) fn quintic<T: Scalar>(turn: T) -> [T; 5] {
    let n = T::from_f64;
    [n(0.9375), T::ZERO, n(-0.625), T::ZERO, n(0.1875)].each(|c| c * turn)
}

/// Formulas of a rest-to-rest move by `d` turns.
pub(super) fn rest_to_rest<T: Scalar>(profile: Profile, d: f64) -> Shapes<T> {
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

/// Formula of a spin-up that would turn by `v` turns at the old rate and turns by half of `dv`
/// more: `Δ = v s + dv [s²/2 + (cos 2πs − 1)/4π²]`, about `s = ½`.
pub(super) fn spin_up<T: Scalar>(v: T, dv: T) -> Shape<T> {
    let c2 = T::from_f64(0.125) * dv;
    let b = T::from_f64(-1.0 / (TAU * TAU)) * dv;
    Shape::Harmonic { c: [T::HALF * v + T::TWO * c2, c2], a: T::ZERO, b }
}
