//! One mode, advanced exactly about a centre that moves.

use crate::math::{Each, Scalar, array, phi_functions, words};
use crate::stepper::Forcing;
use crate::stepper::oscillator::{contracting, gain};

/// `ẏ = A(y − r) − (0, b u(t))`, `y = (ωa, p̃)`, `A = [0, ω; −ω, −c]`, `c = α + βω²`.
///
/// Everything in m √kg/s. The remainder `n` of the equations of motion is what moves the centre, `r
/// = −A⁻¹n`: in these coordinates `A⁻¹` is an exchange of rows and costs nothing, and where `n`
/// stays what it is the mode turns about `r`. What is kept is the offset `s = −r` to that centre,
/// and its drift, which spares changes of sign. With `r` changing by `δ` a step, exactly
///
/// `y(h) = y + δ + (E − I)(y − o) + …`, `E = exp(hA)`, `o = r + (hA)⁻¹δ`,
///
/// which is `hφ₁n₀ + hφ₂(n₁ − n₀)` of the exponential integrators in half the products.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mode<T> {
    /// `E − I`, the determinant of `E` rounded down to at most the true one, so that rounding never
    /// feeds the mode energy.
    turn: [[T; 2]; 2],
    /// Weights of `u` at the beginning, in the mean and at the end of the step.
    drive: [[T; 3]; 2],
    /// `1/(ωh)` and `c/(ω²h)`: `(hA)⁻¹`.
    per_turn: T,
    loss_per_turn: T,
    /// `−h(φ₂/2 + φ₃)A`: corrects for the drift of the centre having been extrapolated.
    correction: [[T; 2]; 2],
    /// `b/ω`: an undamped mode's centre under `u = 1` is at `−b/ω`.
    lag: T,
}

impl<T: Scalar> Mode<T> {
    /// For a step of `h` s; `omega` in rad/s, `alpha` in 1/s, `beta` in s, `b` the mode's coupling
    /// to the hub.
    pub(super) fn new(omega: f64, alpha: f64, beta: f64, b: f64, h: f64) -> Self {
        let loss = alpha + beta * omega * omega;
        let z = [[0.0, h * omega], [-h * omega, -h * loss]];
        let [_, p1, p2, p3, _] = phi_functions(&z);
        let f = T::from_f64;
        Self {
            turn: contracting(gain(&z, &p1)),
            // u = u₀ + c₁s + c₂s², c₁ = 6ū − 4u₀ − 2u₁, c₂ = 3(u₀ + u₁ − 2ū), s = 0..1:
            // the response is h(φ₁u₀ + φ₂c₁ + 2φ₃c₂) times the second column.
            drive: array(|r| {
                let (f1, f2, f3) = (h * p1[r][1], h * p2[r][1], h * p3[r][1]);
                [f1 - 4.0 * f2 + 6.0 * f3, 6.0 * f2 - 12.0 * f3, 6.0 * f3 - 2.0 * f2]
                    .each(|weight| f(-b * weight))
            }),
            per_turn: f(1.0 / (omega * h)),
            loss_per_turn: f(loss / (omega * omega * h)),
            lag: f(b / omega),
            correction: array(|i| {
                array(|j| {
                    let weight = |k: usize| 0.5 * p2[i][k] + p3[i][k];
                    f(-(weight(0) * z[0][j] + weight(1) * z[1][j]))
                })
            }),
        }
    }

    /// The state after a step if the offset goes on drifting by `drift` a step.
    #[inline(always)]
    pub(super) fn predict(
        &self,
        y: [T; 2],
        offset: [T; 2],
        drift: [T; 2],
        u: &Forcing<T>,
        damped: bool,
    ) -> [T; 2] {
        let mut lag = self.per_turn * drift[1];
        if damped {
            lag += self.loss_per_turn * drift[0];
        }
        let off = [y[0] + (offset[0] - lag), y[1] + (offset[1] + self.per_turn * drift[0])];
        [0, 1].each(|r| {
            let (turn, drive) = (&self.turn[r], &self.drive[r]);
            let driven = drive[0] * u.begin + drive[1] * u.mean + drive[2] * u.end;
            y[r] + ((turn[0] * off[0] + turn[1] * off[1]) + driven - drift[r])
        })
    }

    /// The same for an undamped mode and a `u` that is `begin` and gains `gained` in a straight
    /// line: the centre moves with it, and all that is left is a rotation.
    #[inline(always)]
    pub(super) fn rotate(
        &self,
        y: [T; 2],
        offset: [T; 2],
        drift: [T; 2],
        begin: T,
        gained: T,
    ) -> [T; 2] {
        let offset = [offset[0] + self.lag * begin, offset[1]];
        let drift = [drift[0] + self.lag * gained, drift[1]];
        let off = self.off(y, offset, drift);
        let [versine, sin] = self.turn[0];
        [
            y[0] + ((versine * off[0] + sin * off[1]) - drift[0]),
            y[1] + ((versine * off[1] - sin * off[0]) - drift[1]),
        ]
    }

    /// The same without a load: the hub rests. Drawn towards the centre by the fraction `damping`:
    /// by twice as much of `p̃` alone, which turns into the other.
    #[inline(always)]
    pub(super) fn step_at_rest(&self, y: [T; 2], off: [T; 2], drift: [T; 2], damping: T) -> [T; 2] {
        let [versine, sin] = self.turn[0];
        let turned = [versine * off[0] + sin * off[1], versine * off[1] - sin * off[0]];
        // In the change, not in `y`, of which f32 would round it away.
        let damped = turned[1] - damping * (off[1] + turned[1]);
        [y[0] + (turned[0] - drift[0]), y[1] + (damped - drift[1])]
    }

    /// Returns the distance of an undamped mode from the mean centre that it turns about.
    #[inline(always)]
    pub(super) fn off(&self, y: [T; 2], offset: [T; 2], drift: [T; 2]) -> [T; 2] {
        [
            y[0] + (offset[0] - self.per_turn * drift[1]),
            y[1] + (offset[1] + self.per_turn * drift[0]),
        ]
    }

    /// The state once the offset at the end is known: `excess` is how much further than expected
    /// it drifted.
    #[inline(always)]
    pub(super) fn correct(&self, y: [T; 2], excess: [T; 2]) -> [T; 2] {
        let weight = &self.correction;
        [0, 1].each(|r| y[r] - (weight[r][0] * excess[0] + weight[r][1] * excess[1]))
    }

    /// The same of an undamped mode.
    #[inline(always)]
    pub(super) fn correct_undamped(&self, y: [T; 2], excess: [T; 2]) -> [T; 2] {
        let [along, across] = self.correction[0];
        [
            y[0] - (along * excess[0] + across * excess[1]),
            y[1] + (across * excess[0] - along * excess[1]),
        ]
    }
}

words! {
    [T: Scalar] Mode<T>: turn, drive, per_turn, loss_per_turn, correction, lag;
}
