//! A planned move after which the arm is at rest.

use core::f64::consts::TAU;

use super::Path;
use crate::hub::HubState;
use crate::math::{Each, Scalar, cast};
use crate::motion::{BULGE, Move, Peaks, PlainMove, Segment, curve_peaks};

/// A move after which the arm is at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StillMove {
    /// State of the hub where the move begins.
    pub from: HubState<f64>,
    /// Hub angle where the move ends, rad.
    pub to: f64,
    /// Hub rate where the move ends, rad/s; 0 for a move that ends at rest.
    pub rate: f64,
    /// Duration in whole ticks.
    pub ticks: u32,
    /// Control period h, s.
    pub tick: f64,
    /// Coefficients of the bulge, rad.
    pub bulge: [f64; BULGE],
    /// Greatest magnitudes of the hub's motion, with a relative error of 1e-4. For information: a
    /// generator finds them anew from the curve before it takes the move.
    pub peaks: Peaks,
    /// Residual amplitude of the first two modes by the planner's model, of L. A robust move leaves
    /// some at the scene's own frequency, so as to leave less at others.
    pub residual: f64,
    /// Number of simulations of each arm that the search took.
    pub simulations: u32,
}

impl StillMove {
    /// Duration T, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.path().duration()
    }

    /// Returns the move for a generator's queue, where it follows moves that end at rest at
    /// `self.from`. From any other state: [`Generator::redirect`](crate::Generator::redirect).
    ///
    /// A move that ends turning is for `redirect` only. It comes back with a bulge that is no
    /// number, which every queue refuses.
    #[must_use]
    pub fn plain(&self) -> PlainMove {
        let bulge = if self.rate == 0.0 { self.bulge } else { [f64::NAN; BULGE] };
        PlainMove::Still { duration: self.duration(), to: self.to, bulge }
    }

    /// Returns [`Self::plain`] among moves of other kinds.
    #[must_use]
    pub fn motion(&self) -> Move {
        self.plain().into()
    }

    /// Returns the curve of the hub.
    #[must_use]
    pub fn segment(&self) -> Segment<f64> {
        self.path().segment(&self.bulge)
    }

    /// Finds the greatest magnitudes of the curve in the tick's scalar, whatever [`Self::peaks`]
    /// says.
    pub(crate) fn curve_peaks<T: Scalar>(&self) -> Peaks {
        let path = self.path();
        curve_peaks::<T>(
            &cast(&path.quintic()),
            &self.bulge.each(|b| T::from_f64(b / TAU)),
            path.duration(),
        )
    }

    pub(super) fn path(&self) -> Path {
        let Self { from, to, rate, ticks, tick, .. } = *self;
        Path { from, to, rate, ticks, tick }
    }
}
