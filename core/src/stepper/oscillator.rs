//! One mode, advanced exactly over a step: what the steppers in modal coordinates share.

use crate::Error;
use crate::hub::HubState;
use crate::math::{Each, Scalar, array, phi_functions, words};

/// `ȧ = p + nₐ`, `ṗ = −ω²a − (α + βω²)p − b u(t) + n_p`, with `u = θ̈ + αθ̇`.
///
/// `a` in m √kg, `p = ȧ` of the linear part. Exact for any step as long as `u` is a parabola and
/// the remainder `n` a straight line within it; modes that the step cannot resolve included.
/// `n` at the end is taken at a predicted state, one evaluation a step, second order: predicted
/// with `n` changing as before and corrected for having been extrapolated (PEC2), or where little
/// depends on `n`, with `n` constant (ETD2RK; Cox and Matthews, J. Comput. Phys. 176, 2002).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Oscillator<T> {
    /// `exp(hA) − I`, see [`contracting`].
    gain: [[T; 2]; 2],
    /// Weights of `u` at the beginning, in the mean and at the end of the step.
    drive: [[T; 3]; 2],
    /// `hφ₁`, `hφ₂`: weights of `n` at the beginning, and of its change over the step.
    constant: [[T; 2]; 2],
    slope: [[T; 2]; 2],
    /// `h(φ₂/2 + φ₃)`: corrects for the change of `n` having been extrapolated.
    correction: [[T; 2]; 2],
}

/// Forcing of the modes within a step: a parabola with these values at the beginning and at the
/// end, and this mean.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Forcing<T> {
    pub begin: T,
    pub mean: T,
    pub end: T,
}

impl<T: Scalar> Forcing<T> {
    /// The parabola of `u = θ̈ + αθ̇` over a tick: its mean is what the rate gained, so that a jump
    /// of the acceleration within the tick does its full work.
    #[inline(always)]
    pub(crate) fn between(
        before: &HubState<T>,
        after: &HubState<T>,
        per_tick: T,
        alpha: T,
    ) -> Self {
        let gained = (after.rate - before.rate) * per_tick;
        Self {
            begin: before.acceleration + alpha * before.rate,
            mean: gained + alpha * (T::HALF * (before.rate + after.rate)),
            end: after.acceleration + alpha * after.rate,
        }
    }

    /// [`Self::between`] where `α` is zero.
    #[inline(always)]
    pub(super) fn undamped(before: &HubState<T>, after: &HubState<T>, per_tick: T) -> Self {
        let mean = (after.rate - before.rate) * per_tick;
        Self { begin: before.acceleration, mean, end: after.acceleration }
    }

    /// The same parabola over the first and over the second half of the tick.
    #[inline(always)]
    pub(crate) fn halves(&self, quarter: T) -> [Self; 2] {
        let ends = quarter * (self.begin + self.end);
        let middle = (T::ONE + T::HALF) * self.mean - ends;
        // The mean of a parabola's first half, from its ends and its own mean.
        let first = self.mean + quarter * (self.begin - self.end);
        let second = self.mean - quarter * (self.begin - self.end);
        [
            Self { begin: self.begin, mean: first, end: middle },
            Self { begin: middle, mean: second, end: self.end },
        ]
    }
}

impl<T: Scalar> Oscillator<T> {
    /// For a step of `h` s; `omega` in rad/s, `alpha` in 1/s, `beta` in s, `b` the mode's coupling
    /// to the hub.
    pub(crate) fn new(omega: f64, alpha: f64, beta: f64, b: f64, h: f64) -> Self {
        let [_, p1, p2, p3, _] = phi_of(omega, alpha, beta, h);
        let cast = |matrix: [[f64; 2]; 2]| matrix.each(|row| row.each(|x| T::from_f64(h * x)));
        Self {
            gain: contracting(gain(&matrix(omega, alpha, beta, h), &p1)),
            // u = u₀ + c₁s + c₂s², c₁ = 6ū − 4u₀ − 2u₁, c₂ = 3(u₀ + u₁ − 2ū), s = 0..1:
            // the response is h(φ₁u₀ + φ₂c₁ + 2φ₃c₂) times the second column.
            drive: array(|r| {
                let (f1, f2, f3) = (h * p1[r][1], h * p2[r][1], h * p3[r][1]);
                [f1 - 4.0 * f2 + 6.0 * f3, 6.0 * f2 - 12.0 * f3, 6.0 * f3 - 2.0 * f2]
                    .each(|weight| T::from_f64(-b * weight))
            }),
            constant: cast(p1),
            slope: cast(p2),
            correction: cast(array(|i| array(|j| 0.5 * p2[i][j] + p3[i][j]))),
        }
    }

    /// An undamped mode for a simulation of some hundred steps of at most [`LONGEST_TURN`] rad, in
    /// the scalar itself. An f32 then costs a hundredth of what [`Self::new`] does in f64 by
    /// software. Its energy may grow by a rounding a step. Error: 3 units in the last place.
    pub(crate) fn turning(omega: T, b: T, h: T) -> Self {
        let turn = omega * h;
        let [c1, c2, c3, c4] = turn_functions(turn * turn);
        let phi = |even: T, odd: T| [[even, h * odd], [-(omega * (turn * odd)), even]];
        let [p1, p2, p3] = [phi(c1, c2), phi(c2, c3), phi(c3, c4)];
        let scaled = |matrix: [[T; 2]; 2]| matrix.each(|row| row.each(|x| h * x));
        let versine = -(turn * turn * c2);
        Self {
            gain: [[versine, h * c1], [-(omega * (turn * c1)), versine]],
            drive: [0, 1].each(|r| {
                let (f1, f2, f3) = (h * p1[r][1], h * p2[r][1], h * p3[r][1]);
                let [two, four, six, twelve] = [2, 4, 6, 12].each(T::from_u32);
                [f1 - four * f2 + six * f3, six * f2 - twelve * f3, six * f3 - two * f2]
                    .each(|weight| -(b * weight))
            }),
            constant: scaled(p1),
            slope: scaled(p2),
            correction: scaled([0, 1].each(|i| [0, 1].each(|j| T::HALF * p2[i][j] + p3[i][j]))),
        }
    }

    /// For a force in units of `scale`.
    pub(super) fn forced_by(mut self, scale: f64) -> Self {
        let scale = T::from_f64(scale);
        for matrix in [&mut self.constant, &mut self.slope] {
            *matrix = matrix.each(|row| row.each(|x| scale * x));
        }
        self
    }

    /// Undamped, over a step in which `u` is a straight line, with the force at its beginning and
    /// at its end as a function of the predicted `a`. `rest` is `−a` of a mode that rests under `u
    /// = 1`; the force is in units of stiffness, [`Self::forced_by`] `ω²`: about where the mode
    /// would rest under the load at the beginning, the rotation is all there is.
    #[inline(always)]
    pub(super) fn rotate(&self, [a, v]: [T; 2], rest: T, begin: T, force: T) -> [T; 2] {
        let [[versine, sin], [back, _]] = self.gain;
        let off = a + (rest * begin - force);
        [a + (versine * off + sin * v), v + (back * off + versine * v)]
    }

    /// A step of the hub at rest under a constant force in units of stiffness, damped or not.
    #[inline(always)]
    pub(super) fn step_at_rest(&self, [a, v]: [T; 2], force: T) -> [T; 2] {
        let [[versine, sin], [back, forth]] = self.gain;
        let off = a - force;
        [a + (versine * off + sin * v), v + (back * off + forth * v)]
    }

    /// Returns the correction for a load that changes by `change` over the step.
    #[inline(always)]
    pub(super) fn ramp(&self, r: usize, change: T) -> T {
        self.slope[r][1] * change
    }

    /// The state after a step if `n` goes on changing as it did.
    #[inline(always)]
    pub(crate) fn predict(
        &self,
        y: [T; 2],
        forcing: &Forcing<T>,
        n: [T; 2],
        change: [T; 2],
    ) -> [T; 2] {
        [0, 1].each(|r| {
            self.free(r, y, forcing)
                + (self.constant[r][0] * n[0] + self.constant[r][1] * n[1])
                + (self.slope[r][0] * change[0] + self.slope[r][1] * change[1])
        })
    }

    /// Returns the prediction, corrected once `n` at the end is known: `excess` is its change less
    /// the expected one.
    #[inline(always)]
    pub(crate) fn correct(&self, y: [T; 2], excess: [T; 2]) -> [T; 2] {
        [0, 1]
            .each(|r| y[r] + self.correction[r][0] * excess[0] + self.correction[r][1] * excess[1])
    }

    /// The state after a step if `n` stays what it is, and `nₐ` is zero.
    #[inline(always)]
    pub(super) fn predict_forced(&self, y: [T; 2], forcing: &Forcing<T>, force: T) -> [T; 2] {
        [0, 1].each(|r| self.free(r, y, forcing) + self.constant[r][1] * force)
    }

    /// Returns that state, corrected once the change of `n` over the step is known.
    #[inline(always)]
    pub(super) fn correct_forced(&self, y: [T; 2], change: T) -> [T; 2] {
        [0, 1].each(|r| y[r] + self.slope[r][1] * change)
    }

    #[inline(always)]
    fn free(&self, r: usize, y: [T; 2], forcing: &Forcing<T>) -> T {
        let driven = self.drive[r][0] * forcing.begin
            + self.drive[r][1] * forcing.mean
            + self.drive[r][2] * forcing.end;
        y[r] + (self.gain[r][0] * y[0] + self.gain[r][1] * y[1] + driven)
    }
}

/// Largest angle of a step for which the series of [`turn_functions`] converges within its terms.
pub(crate) const LONGEST_TURN: f64 = 2.2;

/// Pairs of terms of these series: the last is below 1e-16 of the sum.
const TURN_TERMS: u32 = 11;

/// `c₁ … c₄` of `x`, the square of an angle: `cₖ(x) = Σ (−x)ⁿ/(2n + k)!`. `φₖ` of a rotation are
/// `cₖ` on the diagonal and the angle times `cₖ₊₁` beside it.
fn turn_functions<T: Scalar>(x: T) -> [T; 4] {
    let (mut c3, mut c4) = (T::ONE, T::ONE);
    for n in (1..TURN_TERMS).rev() {
        let per = |k: u32| T::from_f64(1.0 / f64::from((2 * n + k) * (2 * n + k - 1)));
        c3 = T::ONE - x * per(3) * c3;
        c4 = T::ONE - x * per(4) * c4;
    }
    c3 = c3 * T::from_f64(1.0 / 6.0);
    c4 = c4 * T::from_f64(1.0 / 24.0);
    [T::ONE - x * c3, T::HALF - x * c4, c3, c4]
}

/// `hA`.
fn matrix(omega: f64, alpha: f64, beta: f64, h: f64) -> [[f64; 2]; 2] {
    let stiffness = omega * omega;
    [[0.0, h], [-h * stiffness, -h * (alpha + beta * stiffness)]]
}

/// `exp Z − I = Z φ₁(Z)`, to full relative precision for small steps.
pub(super) fn gain(z: &[[f64; 2]; 2], p1: &[[f64; 2]; 2]) -> [[f64; 2]; 2] {
    [0, 1].each(|i| [0, 1].each(|j| z[i][0] * p1[0][j] + z[i][1] * p1[1][j]))
}

/// `φ₀ … φ₄` of `hA`, by way of `(ωa, p)`, in which the matrix is as small as it can be and equally
/// good for every unit of `a`.
fn phi_of(omega: f64, alpha: f64, beta: f64, h: f64) -> [[[f64; 2]; 2]; 5] {
    let (turn, decay) = (omega * h, (alpha + beta * omega * omega) * h);
    let phi = phi_functions(&[[0.0, turn], [-turn, -decay]]);
    phi.each(|[[aa, ap], [pa, pp]]| [[aa, ap / omega], [pa * omega, pp]])
}

/// Largest `(ω + α + βω²)h` of a mode that is advanced exactly: its phase is then known to 1e-10.
const MOST_TURNS: f64 = 1e6;

/// Refuses a tick in which a mode does far more than can be told: there the arm is rigid.
pub(super) fn check_turns(
    frequency: &[f64],
    alpha: f64,
    beta: &[f64],
    tick: f64,
) -> Result<(), Error> {
    let turns = frequency.iter().zip(beta).map(|(w, beta)| w + alpha + beta * w * w);
    let fastest = turns.fold(0.0, f64::max);
    Error::check("solver.tick", tick, 1e-6, MOST_TURNS / fastest, "s").map(drop)
}

/// Change to add to the state before a step, per unit of the moment by which `u` departs from its
/// parabola, see [`Segment`](crate::motion::Segment): the cubic `60 m s(1 − s)(1 − 2s)` has that
/// moment, no mean and no ends. Zero for modes that the step damps out.
pub(super) fn kick<T: Scalar>(omega: f64, alpha: f64, beta: f64, b: f64, h: f64) -> [T; 2] {
    let [e, _, p2, p3, p4] = phi_of(omega, alpha, beta, h);
    let end = [0, 1].each(|r| -60.0 * b * h * (p2[r][1] - 6.0 * p3[r][1] + 12.0 * p4[r][1]));
    pulled_back(&e, end).each(T::from_f64)
}

/// The state before a step that ends with `end` by itself, `e` being the step. Zero for modes that
/// the step damps out.
pub(super) fn pulled_back(e: &[[f64; 2]; 2], end: [f64; 2]) -> [f64; 2] {
    let determinant = e[0][0] * e[1][1] - e[0][1] * e[1][0];
    if determinant < 1e-3 {
        return [0.0; 2];
    }
    [
        (e[1][1] * end[0] - e[0][1] * end[1]) / determinant,
        (e[0][0] * end[1] - e[1][0] * end[0]) / determinant,
    ]
}

/// Largest shortfall of the determinant from 1 at which it is held down.
const DAMPED: f64 = 1e-3;

/// Rounds `F = exp(hA) − I` so that the determinant of `I + F` does not exceed the true one.
/// Rounded to nearest it may, and a mode would then grow.
///
/// `F` rather than the exponential: a frequency is `√(2 − tr exp(hA))`, of which an f32 near 1
/// leaves `ε/(ωh)²`, and what rounding down takes from the energy is as much smaller.
pub(super) fn contracting<T: Scalar>(exact: [[f64; 2]; 2]) -> [[T; 2]; 2] {
    // det(I + F) − 1.
    let excess = |f: &[[f64; 2]; 2]| (f[0][0] + f[1][1]) + (f[0][0] * f[1][1] - f[0][1] * f[1][0]);
    let limit = excess(&exact).min(0.0);
    let nearest = exact.each(|row| row.each(T::from_f64));
    // With more damping than rounding there is nothing to mend; and where the step damps the mode
    // out, the determinant is itself but rounding, and no shrinking would bring it below its limit.
    if limit < -DAMPED {
        return nearest;
    }
    // What one rounding changes the determinant by.
    let [[aa, ap], [pa, pp]] = exact.each(|row| row.each(f64::abs));
    let unit = 0.125 * (aa + pp + ap * pa) * T::EPSILON.to_f64();
    let mut rounded = nearest;
    let mut shrunk = 0.0;
    // In f64 the product of two f32 is exact, and the sum's rounding far below an f32's; of f64
    // themselves a few steps more are on the safe side of what cannot be told.
    for _ in 0..MOST_STEPS {
        if excess(&rounded.each(|row| row.each(T::to_f64))) <= limit {
            break;
        }
        shrunk += unit;
        rounded = array(|i| {
            array(|j| {
                let identity = if i == j { shrunk } else { 0.0 };
                T::from_f64((1.0 - shrunk) * exact[i][j] - identity)
            })
        });
    }
    rounded
}

/// Steps of an eighth of a rounding; some ten are enough.
const MOST_STEPS: u32 = 1000;

words! {
    [T: Scalar] Oscillator<T>: gain, drive, constant, slope, correction;
}

#[cfg(test)]
mod tests {
    use super::{LONGEST_TURN, Oscillator};

    /// The quick set-up gives what the exact one does, up to its longest step.
    #[test]
    fn a_quick_set_up_is_the_exact_one() {
        for turn in [1e-3, 0.2, 1.0, 2.0, LONGEST_TURN] {
            let (omega, b) = (7.0, 0.3);
            let h = turn / omega;
            let exact = Oscillator::<f64>::new(omega, 0.0, 0.0, b, h);
            let quick = Oscillator::<f64>::turning(omega, b, h);
            let pairs = [
                (exact.gain, quick.gain),
                (exact.constant, quick.constant),
                (exact.slope, quick.slope),
                (exact.correction, quick.correction),
            ];
            for (exact, quick) in pairs {
                near(exact.as_flattened(), quick.as_flattened(), turn);
            }
            near(exact.drive.as_flattened(), quick.drive.as_flattened(), turn);
        }
    }

    fn near(exact: &[f64], quick: &[f64], turn: f64) {
        for (exact, quick) in exact.iter().zip(quick) {
            let most = 1e-13 * exact.abs() + 1e-16;
            assert!((exact - quick).abs() < most, "{turn}: {quick} is not {exact}");
        }
    }
}
