//! Rates of the hub at which the spin terms leave the steps bounded.
//!
//! Each mode is advanced exactly, the spin force as a straight line over the tick: of second order and
//! symmetric in time, but not stable whatever the rate. A mode alone grows where it turns just less than
//! an odd number of half turns a tick, two together where their turns add up to whole ones, and no
//! formula is simpler than asking the step itself.

use super::{Modal, ModalState};
use crate::Error;
use crate::math::{Band, Scalar, sqrt};
use crate::motion::Hub;
use crate::stepper::Stepper;

/// What a step makes of `(ωa, ωȧ)`, linear: the image of each of the `2K` units.
type Step<T, const K: usize> = [[[[T; 2]; K]; 2]; K];

/// Shares of a rate that are asked besides the whole: a spin-up passes through them.
const SHARES: u32 = 8;

/// Ticks that a rate may be held for, `2²⁰`, without a hundredfold growth.
const DOUBLINGS: u32 = 20;

impl<T: Scalar, const K: usize> Modal<T, K> {
    /// Refuses a rate that would feed the modes, held or passed through. Set-up only: where the bound of
    /// the plain ticks does not settle it, some 100,000 operations.
    pub(super) fn admit_rate(&self, rate: f64) -> Result<(), Error> {
        let settled = self.fastest.to_f64();
        let carries = |rate: f64| {
            let share = rate / f64::from(SHARES);
            rate <= settled || (1..=SHARES).all(|i| self.is_bounded(f64::from(i) * share))
        };
        if carries(rate) {
            return Ok(());
        }
        let mut max = 0.9 * rate;
        while !carries(max) {
            max *= 0.9;
        }
        Err(Error::TooFast { rate, max })
    }

    /// Whether no entry on the diagonal of the step's power grows to 100 within `2²⁰` ticks: of all
    /// entries those do not depend on how the state is scaled.
    fn is_bounded(&self, rate: f64) -> bool {
        let mut power = self.held(T::from_f64(rate));
        (0..DOUBLINGS).all(|_| {
            power = power.map(|part| part.map(|image| apply(&power, &image)));
            (0..K).all(|k| {
                (0..2).all(|i| power[k][i][k][i] * power[k][i][k][i] <= T::from_u32(10_000))
            })
        })
    }

    /// The step at a constant rate without what shifts the modes and does not feed them: weight and the
    /// drag of the turning.
    fn held(&self, rate: T) -> Step<T, K> {
        let hub = Hub { rate, cos: T::ZERO, ..Hub::ZERO };
        let level = Self { alpha: T::ZERO, ..self.clone() };
        let mut images = [[[[T::ZERO; 2]; K]; 2]; K];
        for k in 0..K {
            for i in 0..2 {
                let mut y = [[T::ZERO; K]; 2];
                y[i][k] = T::ONE;
                let [coordinate, rate] = y;
                let [force, softening] = level.force(&coordinate, &hub);
                let mut state = ModalState { coordinate, rate, force, softening };
                level.step(&mut state, &hub, &hub);
                images[k][i] = core::array::from_fn(|j| [state.coordinate[j], state.rate[j]]);
            }
        }
        images
    }
}

fn apply<T: Scalar, const K: usize>(step: &Step<T, K>, y: &[[T; 2]; K]) -> [[T; 2]; K] {
    let mut sum = [[T::ZERO; 2]; K];
    for (images, y) in step.iter().zip(y) {
        for (image, &y) in images.iter().zip(y) {
            for (sum, image) in sum.iter_mut().zip(image) {
                for (sum, &image) in sum.iter_mut().zip(image) {
                    *sum += y * image;
                }
            }
        }
    }
    sum
}

/// Largest `θ̇` at which no mode gains more than a thousandth a tick from its spin terms being taken
/// at a predicted state, as within plain cubics; faster ones take the general step. `θ̇²Γ` is compared
/// with `2/h²`, above which a mode that the tick resolves blows up, or with a twentieth of the `ω²` of a
/// mode that turns more than 2 rad a tick: beyond half a turn such a scheme always feeds a mode a
/// little.
pub(super) fn predicted<T: Scalar, const K: usize>(
    spin: &Band<T, K, K>,
    omega: &[f64; K],
    tick: f64,
) -> f64 {
    let mut least = f64::INFINITY;
    for k in 0..K {
        let turn = omega[k] * tick;
        let most = if turn < 2.0 { 2.0 / (turn * turn) } else { 0.05 };
        // Of a mode that turning softens, not all that it has.
        let own = spin.get(k, k).to_f64();
        let most = if own < 0.0 { f64::min(most, 0.8) } else { most };
        let sum: f64 = (0..K).map(|j| spin.get(k, j).to_f64().abs()).sum();
        least = f64::min(least, most / sum.max(f64::MIN_POSITIVE));
    }
    sqrt(least)
}
