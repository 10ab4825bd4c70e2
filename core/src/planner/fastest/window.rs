//! Residual vibration that a move may leave, for one arm or for several of other frequencies.

use super::case::{Case, Trial};
use super::grid::Grid;
use super::response::{Mode, Response};
use crate::math::{Each, Scalar};
use crate::planner::simulate::Arm;
use crate::stepper::ArmState;

/// Most arms that one move is planned for.
pub(super) const ARMS: usize = 5;

/// Part of what may be left for which a move is planned: the rest is the second mode's.
const SHARE: f64 = 0.97;

/// Amplitudes of the first mode that the first half may leave to arms of other frequencies.
///
/// In a move without a cruise the second half, which is the first one backwards, doubles the
/// deflection in the middle and takes the rate back: the arm is left with twice the former.
#[derive(Clone, Copy, Debug)]
pub(super) struct Windows {
    /// Frequencies, of the scene's arm's. The first is 1.
    factors: [f64; ARMS],
    count: usize,
    /// Residual that may be left, of L.
    pub residual: f64,
    /// Amplitude that may be left in the middle, of L.
    pub width: f64,
}

impl Windows {
    /// For frequencies known to `± spread` of themselves; 0 is the scene's arm alone.
    pub fn new(residual: f64, spread: f64) -> Self {
        let mut factors = [1.0; ARMS];
        for (factor, part) in factors.iter_mut().skip(1).zip([-1.0, 1.0, -0.5, 0.5]) {
            *factor += part * spread;
        }
        let count = if spread > 0.0 { ARMS } else { 1 };
        Self { factors, count, residual, width: 0.5 * SHARE * residual }
    }

    /// Factors of the frequencies.
    pub fn factors(&self) -> &[f64] {
        &self.factors[..self.count]
    }

    /// Amplitude, of L, that each of `each` numbers of an arm may have.
    fn side(&self, each: usize) -> f64 {
        // The square inside of the circle, where deflection and rate count.
        if each == 2 { self.width * core::f64::consts::FRAC_1_SQRT_2 } else { self.width }
    }
}

/// Vibration of the simulated arms in their windows.
pub(super) struct Seen<T, const N: usize> {
    /// Amplitudes over what may be left, in the order of the rows.
    pub amplitudes: [T; N],
    /// Bound of the largest residual of all arms, of L.
    pub residual: f64,
}

impl<T: Scalar, const K: usize> Case<'_, T, K> {
    /// Rows of the windows: amplitudes by each knot, over what may be left.
    pub fn window_rows<const N: usize>(
        &self,
        windows: &Windows,
        trial: &Trial<T, N>,
    ) -> [[T; N]; N] {
        let (interval, unit, each) = (self.interval(trial), self.unit(trial), self.each());
        let mut rows = [[T::ZERO; N]; N];
        let [frequency, coupling] = self.arm.mode(0);
        let scale = self.arm.tip_per_mode(0) * T::from_f64(unit / windows.side(each));
        for (j, &factor) in windows.factors().iter().enumerate() {
            let mode = Mode { frequency: T::from_f64(factor) * frequency, coupling };
            let response = Response::<T, N>::new(&mode, interval);
            for i in 0..each {
                let row = if i == 0 { response.deflections() } else { response.rates() };
                rows[each * j + i] = row.each(|x| scale * x);
            }
        }
        rows
    }

    /// Looks at where each arm is at the end of the half: `end_of` simulates an arm.
    pub fn look<const N: usize>(
        &self,
        windows: &Windows,
        mut end_of: impl FnMut(&Arm<T, K>) -> ArmState<T, K>,
    ) -> Seen<T, N> {
        let each = self.each();
        let per = T::from_f64(1.0 / windows.side(each));
        let mut seen = Seen { amplitudes: [T::ZERO; N], residual: 0.0_f64 };
        for (j, &factor) in windows.factors().iter().enumerate() {
            let arm = self.arm.stiffened(T::from_f64(factor));
            let end = end_of(&arm);
            let amplitudes = arm.amplitudes(0, &end, &ArmState::STRAIGHT);
            for i in 0..each {
                seen.amplitudes[each * j + i] = per * amplitudes[i];
            }
            let residual = self.residual(&arm, &end) / self.length;
            seen.residual = seen.residual.max(residual);
        }
        seen
    }

    /// Bound of what the move leaves to an arm, m: the second half can double what the first one
    /// does. Without a cruise the rates in the middle are the mirrored half's own.
    pub fn residual(&self, arm: &Arm<T, K>, end: &ArmState<T, K>) -> f64 {
        let rate = if self.cruise.is_some() { end.rate } else { [T::ZERO; K] };
        let end = ArmState { rate, ..*end };
        2.0 * arm.ringing(self.points, &end, &ArmState::STRAIGHT)
    }

    /// True if `N` knots have a row for each window.
    pub fn has_room<const N: usize>(&self) -> bool {
        self.windows.is_none_or(|windows| windows.count * self.each() <= N)
    }
}

impl<T: Scalar, const N: usize> Trial<T, N> {
    /// Moves the windows' offsets to what the simulations say; `linear` holds the program's values
    /// of these rows.
    pub fn learn_windows(&mut self, seen: &Seen<T, N>, linear: &Grid<T, N>) {
        let kind = super::grid::WINDOW;
        for i in 0..N {
            self.offsets[kind][i] += seen.amplitudes[i] - linear[kind][i];
        }
    }
}
