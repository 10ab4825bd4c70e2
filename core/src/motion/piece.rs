//! One polynomial from one state of the hub to another.

use core::f64::consts::TAU;

use super::Peaks;
use super::polynomial::greatest;
use super::segment::Shape;
use crate::math::{Each, Scalar};

/// Motion at both ends of a piece, from within: the turn between them in turns, and rates and
/// accelerations in turns per `u` and per `u²`, `u = −1..1` over the piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ends<T> {
    /// Turns from the beginning to the end.
    pub turn: T,
    /// dΔ/du at the beginning and at the end.
    pub rates: [T; 2],
    /// d²Δ/du² at the beginning and at the end.
    pub accelerations: [T; 2],
}

/// Coefficients `c₁ … c₅` of a polynomial of `u = −1..1`, turns from its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece<T>(pub [T; 5]);

impl<T: Scalar> Ends<T> {
    /// Ends in rad/s and rad/s² of a piece that lasts `duration` s and turns by `turn` turns.
    pub fn new(turn: T, rates: [T; 2], accelerations: [T; 2], duration: T) -> Self {
        let per_u = T::HALF * duration * T::from_f64(1.0 / TAU);
        let per_u2 = T::HALF * duration * per_u;
        Self {
            turn,
            rates: rates.each(|rate| rate * per_u),
            accelerations: accelerations.each(|acceleration| acceleration * per_u2),
        }
    }

    /// The cubic with this turn and these rates; its accelerations follow from them.
    pub fn cubic(&self) -> Piece<T> {
        let [p0, p1] = self.rates;
        let quarter = T::HALF * T::HALF;
        let c3 = quarter * (p0 + p1 - self.turn);
        Piece([T::HALF * self.turn - c3, quarter * (p1 - p0), c3, T::ZERO, T::ZERO])
    }

    /// The quintic with this turn, these rates and these accelerations.
    pub fn quintic(&self) -> Piece<T> {
        let n = T::from_f64;
        let ([p0, p1], [q0, q1]) = (self.rates, self.accelerations);
        // Even terms by the change of the rate, odd ones by what the rates leave of the turn.
        let gain = T::HALF * (p1 - p0);
        let c4 = n(0.125) * (T::HALF * (q0 + q1) - gain);
        let c2 = T::HALF * gain - T::TWO * c4;
        let left = T::HALF * (p0 + p1 - self.turn);
        let c5 = n(0.125) * (T::HALF * (q1 - q0) - n(3.0) * left);
        let c3 = T::HALF * left - T::TWO * c5;
        Piece([T::HALF * self.turn - c3 - c5, c2, c3, c4, c5])
    }
}

impl<T: Scalar> Piece<T> {
    /// The curve as a segment's shape.
    pub fn shape(&self) -> Shape<T> {
        let [c1, c2, c3, c4, c5] = self.0;
        if c4 == T::ZERO && c5 == T::ZERO {
            Shape::Cubic([c1, c2, c3])
        } else {
            Shape::Quintic(self.0)
        }
    }

    /// Greatest magnitudes in `duration` s, exact but for rounding. Jumps at the ends are not
    /// looked at.
    pub fn peaks(&self, duration: T) -> Peaks {
        let mut c = [T::ZERO; 6];
        c[1..].copy_from_slice(&self.0);
        let mut scale = T::from_f64(TAU);
        let [rate, acceleration, jerk] = [(); 3].map(|()| {
            for k in 1..6 {
                c[k - 1] = c[k] * T::from_u32(k as u32);
            }
            c[5] = T::ZERO;
            scale = scale * (T::TWO / duration);
            let [c0, c1, c2, c3, c4, _] = c;
            (scale * greatest(&[c0, c1, c2, c3, c4])).to_f64()
        });
        Peaks { rate, acceleration, jerk }
    }

    /// θ̈ at both ends, from within, rad/s².
    pub fn accelerations(&self, duration: T) -> [T; 2] {
        let n = T::from_f64;
        let [_, c2, c3, c4, c5] = self.0;
        let scale = n(TAU) * (T::TWO / duration) * (T::TWO / duration);
        let (even, odd) = (T::TWO * c2 + n(12.0) * c4, n(6.0) * c3 + n(20.0) * c5);
        [scale * (even - odd), scale * (even + odd)]
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::Ends;
    use crate::hub::Angle;
    use crate::motion::Segment;

    /// Both polynomials meet the ends that they are made for.
    #[test]
    fn a_piece_meets_its_ends() {
        let (turn, rates, bends) = (0.3, [2.0, -1.5], [7.0, 11.0]);
        for quintic in [false, true] {
            let ends = Ends::new(turn, rates, bends, 0.5);
            let piece = if quintic { ends.quintic() } else { ends.cubic() };
            let start = Angle::from_radians(1.0);
            let segment = Segment::<f64>::new(start, piece.shape(), 50.0, 0.0, 50, 0.01);
            let accelerations = piece.accelerations(0.5);
            for (end, ticks) in [(0, 0.0), (1, 50.0)] {
                let hub = segment.hub_at(ticks);
                let angle = 1.0 + end as f64 * turn * TAU;
                assert!((hub.angle.radians() - angle).abs() < 1e-14, "{hub:?}");
                assert!((hub.rate - rates[end]).abs() < 1e-13, "{hub:?}");
                assert!((hub.acceleration - accelerations[end]).abs() < 1e-12, "{hub:?}");
                if quintic {
                    assert!((hub.acceleration - bends[end]).abs() < 1e-12, "{hub:?}");
                }
            }
        }
    }

    /// A quintic's peaks at rest are the profile's: 1.875, 10/√3 and 60.
    #[test]
    fn peaks_are_the_profiles() {
        let piece = Ends::new(1.0 / TAU, [0.0; 2], [0.0; 2], 1.0).quintic();
        let peaks = piece.peaks(1.0);
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b, "{a} {b}");
        near(peaks.rate, 1.875);
        near(peaks.acceleration, 10.0 / 3.0_f64.sqrt());
        near(peaks.jerk, 60.0);
    }
}
