//! Torque and clamp moment of the reference rod along a commanded motion.

use stillbeam::Limits;

use super::{Case, Excess, Peak, Quantity, Window};
use crate::error::Error;
use crate::reference::rod::{self, Load, Options, Resume};
use crate::trajectory::Trajectory;

/// Options of a full check. With two polynomials more, or a thousandth of the tolerance, peak loads
/// of the embedded scenes and of stiff bars change by less than 4e-4.
pub const FINE: Options = Options { order: 6, tolerance: 1e-6, integrator: None };

/// Options of a first check and of a search, in a quarter of the time. Error below 3e-3.
pub const QUICK: Options = Options { order: 5, tolerance: 1e-5, integrator: None };

/// Fraction of a limit below which the first check suffices, because its error is smaller.
const CLEARLY: f64 = 0.9;

/// Progress of a check of the load limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Progress {
    /// Fraction of the check that is done, 0 to 1.
    Checked(f64),
    /// Duration that is tried in the search for the shortest one that keeps the limits, s.
    Tried(f64),
}

/// Greatest magnitudes over a time, N m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peaks {
    /// |τ| at the hub.
    pub torque: Peak,
    /// |M| at the clamp.
    pub moment: Peak,
}

impl Peaks {
    /// Returns the first limit that the peaks exceed, during the move at `index`.
    pub fn excess(&self, limits: &Limits, index: usize) -> Option<Excess> {
        let torque = limits.torque.map(|limit| (Quantity::Torque, self.torque, limit));
        let moment = limits.moment.map(|limit| (Quantity::Moment, self.moment, limit));
        torque
            .into_iter()
            .chain(moment)
            .find_map(|(quantity, peak, limit)| Excess::of(quantity, peak, limit, index))
    }

    /// Returns the greatest fraction of a limit.
    fn fraction(&self, limits: &Limits) -> f64 {
        let torque = limits.torque.map_or(0.0, |limit| self.torque.value / limit);
        torque.max(limits.moment.map_or(0.0, |limit| self.moment.value / limit))
    }
}

/// True if a load is limited at all.
pub fn limited(limits: &Limits) -> bool {
    limits.torque.is_some() || limits.moment.is_some()
}

/// Result of a flight: the first window that exceeds a limit, and the arm at its beginning.
#[derive(Clone, Debug)]
pub struct Found {
    /// The excess.
    pub excess: Excess,
    /// The window.
    pub window: Window,
    /// The arm at the window's beginning, in a [`FINE`] flight and in a [`QUICK`] one; `None` at
    /// rest.
    pub states: [Option<Resume>; 2],
}

/// Returns the first window of a motion in which the rod exceeds a load limit. Returns `None`
/// without such limits. `progress` is called with the fraction that is done.
pub fn excess(
    case: &Case<'_>,
    trajectory: &Trajectory,
    limits: &Limits,
    progress: &dyn Fn(f64),
) -> Result<Option<Found>, Error> {
    if !limited(limits) {
        return Ok(None);
    }
    let windows = case.windows(trajectory);
    let end = trajectory.duration();
    let mut quick_states = vec![None];
    let mut suspects = 0;
    for (k, window) in windows.iter().enumerate() {
        let quick = |t: f64| progress(0.2 * t / end);
        let state = quick_states[k].as_ref();
        let (peaks, next) = fly(case, trajectory, window, &QUICK, state, &quick)?;
        quick_states.push(next);
        if peaks.fraction(limits) >= CLEARLY {
            suspects = k + 1;
            if peaks.fraction(limits) > 1.0 / CLEARLY {
                break;
            }
        }
    }
    let mut state = None;
    for (window, quick) in windows[..suspects].iter().zip(quick_states) {
        let fine = |t: f64| progress(0.2 + 0.8 * t / end);
        let (peaks, next) = fly(case, trajectory, window, &FINE, state.as_ref(), &fine)?;
        if let Some(excess) = peaks.excess(limits, window.index) {
            return Ok(Some(Found { excess, window: *window, states: [state, quick] }));
        }
        state = next;
    }
    Ok(None)
}

/// Returns the rod's peaks in a window and its state at the end, from its state at the beginning.
pub fn fly(
    case: &Case<'_>,
    trajectory: &Trajectory,
    window: &Window,
    options: &Options,
    state: Option<&Resume>,
    progress: &dyn Fn(f64),
) -> Result<(Peaks, Option<Resume>), Error> {
    let mut peaks = Peaks::default();
    let mut crests = [Crest::default(), Crest::default()];
    let mut visit = |load: Load| {
        progress(load.t);
        let all = [(&mut peaks.torque, load.torque), (&mut peaks.moment, load.moment)];
        for ((peak, value), crest) in all.into_iter().zip(&mut crests) {
            peak.raise(value, load.t);
            crest.pass(load.t, value, load.jumped, peak);
        }
    };
    let end = rod::watch(case.arm, trajectory, options, state, window.end, &mut visit)?;
    Ok((peaks, Some(end)))
}

/// The last two samples of a row.
#[derive(Default)]
struct Crest {
    before: Option<(f64, f64)>,
    here: Option<(f64, f64)>,
}

impl Crest {
    /// Takes the next sample, and raises the peak to the vertex of the parabola through the last
    /// three if the middle one is the greatest.
    fn pass(&mut self, t: f64, value: f64, jumped: bool, peak: &mut Peak) {
        if jumped {
            (self.before, self.here) = (None, None);
        }
        if let (Some((t0, y0)), Some((t1, y1))) = (self.before, self.here)
            && y1.abs() >= y0.abs()
            && y1.abs() >= value.abs()
            && t1 > t0
            && t > t1
        {
            // Newton's form about t₁: y₁ + s (slope + bend (t − t₁)).
            let (left, right) = ((y1 - y0) / (t1 - t0), (value - y1) / (t - t1));
            let bend = (right - left) / (t - t0);
            let slope = left + bend * (t1 - t0);
            if bend != 0.0 {
                peak.raise(y1 - 0.25 * slope * slope / bend, t1 - 0.5 * slope / bend);
            }
        }
        (self.before, self.here) = (self.here, Some((t, value)));
    }
}
