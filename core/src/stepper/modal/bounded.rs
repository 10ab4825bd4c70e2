//! Rates of the hub at which the spin terms leave the steps bounded.
//!
//! Each mode is advanced exactly, the spin force as a straight line over the tick: of second order,
//! but not stable whatever the rate. A mode alone grows where it turns just less than an odd number
//! of half turns a tick, two together where their turns add up to whole ones, and no formula is
//! simpler than asking the step itself: the trace of its power, the sum of the powers of its
//! eigenvalues, stays below their number where nothing grows.

use super::{Modal, ModalState};
use crate::Error;
use crate::hub::HubState;
use crate::math::{Band, Each, Scalar, array, sqrt};
use crate::stepper::{AnyMotion, Linear, Stepper};

/// A step at a constant rate, linear: the image of each unit of coordinate, rate and force.
struct Step<T, const K: usize>([[[[T; 3]; K]; 3]; K]);

/// Shares of a rate that are asked besides the whole: a spin-up passes through them.
const SHARES: u32 = 8;

/// Sines of the angles at which a gravity is asked for.
const SLOPES: [f64; 4] = [-1.0, -0.5, 0.5, 1.0];

/// Rates and gravities are tried in this ratio, so many at most.
const RATIO: f64 = 1.15;
const MOST_TRIES: u32 = 1000;

impl<T: Scalar, const K: usize> Modal<T, K> {
    /// Refuses a rate that would feed the modes a hundredfold within `2²⁰` ticks, held or passed
    /// through. Set-up only: where the bound of the linear ticks does not settle it, a million
    /// operations.
    pub(super) fn admit_rate(&self, rate: f64) -> Result<(), Error> {
        let settled = self.fastest.to_f64();
        let carries = |rate: f64| {
            let share = rate / f64::from(SHARES);
            let bounded = |i| self.held(f64::from(i) * share, 0.0, false).stays_bounded(20, 100.0);
            rate <= settled || (1..=SHARES).all(bounded)
        };
        if carries(rate) {
            return Ok(());
        }
        let mut max = rate / RATIO;
        for _ in 0..MOST_TRIES {
            if carries(max) {
                break;
            }
            max /= RATIO;
        }
        Err(Error::TooFast { rate, max })
    }

    /// Largest `θ̇` at which no mode gains more than a thousandth a tick from its spin terms being
    /// taken at a predicted state, as in linear ticks; faster ones take the general step.
    pub(super) fn fastest_linear_rate(&self, omega: &[f64; K]) -> f64 {
        let mut rate = surely_linear(&self.spin, omega, self.tick);
        for _ in 0..MOST_TRIES {
            if rate * self.tick >= 1.0 || !self.held(rate * RATIO, 0.0, true).stays_bounded(10, 2.0)
            {
                break;
            }
            rate *= RATIO;
        }
        rate
    }

    /// Refuses a gravity that would feed the modes likewise where the hub rests: one that takes or
    /// gives much of a mode's stiffness while a tick hardly resolves it. Set-up only.
    pub(super) fn admit_gravity(&self, gravity: f64) -> Result<(), Error> {
        let mut hub = HubState::ZERO;
        self.gravity.aim(&mut hub);
        // A carriage has one slope only.
        let own = [hub.sin.to_f64()];
        let slopes = if self.gravity.follows_hub() { &SLOPES[..] } else { &own };
        let carries = |share: f64| {
            slopes.iter().all(|slope| self.held(0.0, slope * share, false).stays_bounded(20, 100.0))
        };
        let mut share = 1.0;
        for _ in 0..MOST_TRIES {
            if carries(share) {
                break;
            }
            share /= RATIO;
        }
        Error::check("gravity.acceleration", gravity, 0.0, share * gravity, "m/s^2").map(|_| ())
    }

    /// The step without what shifts the modes and does not feed them: weight and the drag of the
    /// turning. The link points upwards by `sin`.
    fn held(&self, rate: f64, sin: f64, linear: bool) -> Step<T, K> {
        let [rate, sin] = [rate, sin].each(T::from_f64);
        let hub = HubState { rate, sin, cos: T::ZERO, ..HubState::ZERO };
        let level = Self { alpha: T::ZERO, ..*self };
        Step(array(|k| {
            array(|part| {
                let mut y = [[T::ZERO; K]; 3];
                y[part][k] = T::ONE;
                let [coordinate, rate, force] = y;
                let mut state = ModalState { coordinate, rate, force, softening: [T::ZERO; K] };
                if linear {
                    level.step::<Linear>(&mut state, &hub, &hub);
                } else {
                    level.step::<AnyMotion>(&mut state, &hub, &hub);
                }
                array(|j| [state.coordinate[j], state.rate[j], state.force[j]])
            })
        }))
    }
}

impl<T: Scalar, const K: usize> Step<T, K> {
    /// True if the mean of the eigenvalues' powers stays below `most` through `2^doublings` ticks:
    /// a trace, which does not depend on how the state is scaled.
    fn stays_bounded(mut self, doublings: u32, most: f64) -> bool {
        let most = T::from_f64(most * 2.0 * K as f64);
        (0..doublings).all(|_| {
            self = Self(self.0.each(|part| part.each(|image| self.of(&image))));
            let mut trace = T::ZERO;
            for k in 0..K {
                for i in 0..3 {
                    trace += self.0[k][i][k][i];
                }
            }
            -most < trace && trace < most
        })
    }

    fn of(&self, y: &[[T; 3]; K]) -> [[T; 3]; K] {
        let mut sum = [[T::ZERO; 3]; K];
        for (images, y) in self.0.iter().zip(y) {
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
}

/// A rate that feeds no mode: `θ̇²Γ` is compared with `2/h²`, above which a mode that the tick
/// resolves blows up, or with a twentieth of the `ω²` of a mode that turns more than 2 rad a tick:
/// beyond half a turn a predicted force always feeds a mode a little.
fn surely_linear<T: Scalar, const K: usize>(
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
