//! Kinks of the commanded motion inside a tick, as moments that a stepper can integrate.

use crate::math::Scalar;

/// Jumps of θ̈ and of its first three derivatives inside one tick: all that a quintic has.
///
/// A stepper takes θ̈ within a tick as a parabola through the values at both ends, with the mean
/// that the rate gained. A jump at a fraction `x` of the tick is far from a parabola. Its departure
/// is kept as Legendre moments, the jump's part of θ̈ being `J(s)`, `s = 0..1` over the tick:
///
/// `mₖ = ∫₀¹ J(s) Pₖ(2s − 1) ds`, `k = 0..8`, in rad/s².
///
/// A mode that turns by `ωh` in a tick answers to `mₖ` by `jₖ(ωh/2)`, a spherical Bessel function:
/// of a mode with `ωh = 12.6` (`2.0`) the moments leave out 6e-5 (1e-12) of the answer to a jump.
///
/// The moments come from repeated integrals of Legendre polynomials, without cancellation: error
/// 3e-7 of the jump in f32.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kink<T> {
    /// `m₀ … m₈`.
    moments: [T; ORDERS + 1],
    /// `J(1)`, rad/s².
    end: T,
}

/// Moments beyond the mean.
pub(crate) const ORDERS: usize = 8;

/// Legendre polynomials that three further integrals of the last moment take.
const POLYNOMIALS: usize = ORDERS + 5;

impl<T: Scalar> Kink<T> {
    /// A tick in which nothing jumps.
    pub const NONE: Self = Self { moments: [T::ZERO; ORDERS + 1], end: T::ZERO };

    /// True if nothing jumps in the tick.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// Returns the same in another scalar.
    pub(crate) fn cast<U: Scalar>(&self) -> Kink<U> {
        let cast = |x: T| U::from_f64(x.to_f64());
        Kink { moments: self.moments.map(cast), end: cast(self.end) }
    }

    /// Adds jumps at `left` ticks, 0 to 1, before the end of the tick: of θ̈, rad/s², and of its
    /// first three derivatives by the tick.
    pub(super) fn add(&mut self, left: T, jumps: [T; 4]) {
        let mut integrals = legendre(T::ONE - T::TWO * left);
        let mut power = T::ONE;
        let three = T::TWO + T::ONE;
        for (n, jump) in [T::ONE, T::TWO, three, T::TWO + T::TWO].into_iter().zip(jumps) {
            integrals = integrated(&integrals);
            for (moment, &integral) in self.moments.iter_mut().zip(&integrals[1..]) {
                *moment += jump * integral;
            }
            self.end += jump * power;
            power = power * left / n;
        }
    }

    /// `m₁ … m₈` less those of the parabola that has the mean and the ends of `J`.
    pub(crate) fn excess(&self) -> [T; ORDERS] {
        let mut excess = [T::ZERO; ORDERS];
        excess.copy_from_slice(&self.moments[1..]);
        let half = T::HALF * self.end;
        excess[0] += T::from_f64(-1.0 / 3.0) * half;
        excess[1] += T::from_f64(-0.2) * (half - self.moments[0]);
        excess
    }

    /// Excess of `∫₀¹(1 − s)θ̈ ds` over that of the parabola, rad/s², as
    /// [`Segment::kink_moment`](crate::motion::Segment::kink_moment) gives it for a border inside a
    /// tick.
    pub fn moment(&self) -> T {
        -(T::HALF * self.excess()[0])
    }
}

/// `P₋₁ … Pₙ` at `x`; `P₋₁ = P₀`.
fn legendre<T: Scalar>(x: T) -> [T; POLYNOMIALS + 1] {
    let mut p = [T::ONE; POLYNOMIALS + 1];
    p[2] = x;
    for k in 3..=POLYNOMIALS {
        // Degree k − 1 of those two before it.
        let n = T::from_u32(k as u32 - 1);
        p[k] = ((T::TWO * n - T::ONE) * x * p[k - 1] - (n - T::ONE) * p[k - 2]) / n;
    }
    p
}

/// `∫ₓ¹` of each over `s = 0..1`, by `(2k + 1)Pₖ = P′ₖ₊₁ − P′ₖ₋₁`, in the same places: degree −1
/// again equals degree 0. Each integral loses the highest degree.
fn integrated<T: Scalar>(p: &[T; POLYNOMIALS + 1]) -> [T; POLYNOMIALS + 1] {
    let mut integral = [T::ZERO; POLYNOMIALS + 1];
    for k in 0..POLYNOMIALS - 1 {
        integral[k + 1] = (p[k] - p[k + 2]) / T::from_u32(2 * (2 * k as u32 + 1));
    }
    integral[0] = integral[1];
    integral
}
