//! The finite element method for chains and loops, step by step in the global frame: corotational
//! elements, all nodes of all links in one system, Newmark's rule with equilibrium iterations.
//!
//! It is the formulation of Kato and Isobe for link systems: nodal forces first, then the torques
//! of all joints at once, lengths × directions × forces. The unknowns are global places and
//! rotations of nodes; the frame of every element is updated in every iteration. A joint ties the
//! clamp of a link to the end of the one before, a pinned tip is a fixed node. Error: of second
//! order in the step, of fourth in the element's length.

mod band;
mod layout;
mod model;
mod newmark;
mod pose;

use model::Model;
use newmark::March;
use stillbeam::mechanism::Mechanism;

use super::rod;
use super::timetable::{Stretch, Timetable};
use crate::mechanism::table::Row;
use crate::mechanism::{Drives, Moving, first_pin};
use crate::reference::ReferenceError;
use crate::reference::option::within;

/// Steps of the implicit Euler rule after an impact, together one step.
const SOFT_STEPS: u32 = 4;

/// Mesh and step of the solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Number of elements a flexible link, 1 to 1000.
    pub elements: usize,
    /// Longest step, s; 1e-7 to 0.1.
    pub step: f64,
    /// `EA L²/EI` of every flexible link, 1e2 to 1e9.
    pub axial_stiffness: f64,
    /// Largest residual of an equilibrium, as a fraction of the largest `EI/L²`; 1e-12 to 1e-2. The
    /// residual that rounding leaves is accepted too.
    pub tolerance: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { elements: 16, step: 5e-5, axial_stiffness: 1e6, tolerance: 1e-7 }
    }
}

impl Options {
    fn validate(&self) -> Result<(), ReferenceError> {
        within("elements", self.elements as f64, [1.0, 1000.0], "1 to 1000")?;
        within("step", self.step, [1e-7, 0.1], "1e-7 to 0.1 s")?;
        within("axial_stiffness", self.axial_stiffness, [1e2, 1e9], "1e2 to 1e9")?;
        within("tolerance", self.tolerance, [1e-12, 1e-2], "1e-12 to 1e-2")
    }
}

/// Solves a run of a mechanism and samples it at `times` (s, ascending, within the run). Calls
/// `progress` with the fraction of the run that is done.
///
/// The mechanism starts from rest in static equilibrium. The rod tells the angles at which a loop
/// of straight links closes. Steps are cut so that every sample time and every break of the
/// commanded motion ends one.
pub fn solve(
    mechanism: &Mechanism,
    drives: &Drives,
    times: &[f64],
    options: &Options,
    progress: &dyn Fn(f64),
) -> Result<Vec<Row>, ReferenceError> {
    options.validate()?;
    let timetable = Timetable::new(mechanism, drives, times)?;
    let pin = first_pin(mechanism);
    let rigid = || ReferenceError::Options {
        given: "solver = fem".to_owned(),
        wanted: "rod for a loop without a link that bends",
    };
    let angles = rod::closed_straight(mechanism)?.ok_or_else(|| ReferenceError::Options {
        given: "solver = fem".to_owned(),
        wanted: "rod for a loop that closes by bending its links only",
    })?;
    let mut march = if pin.is_some() {
        March::new(Model::new(mechanism, options, true, pin).ok_or_else(rigid)?, options, &angles)
    } else {
        // Passive joints of an open chain begin where they are told to, whatever pulls them.
        March::new(
            Model::new(&held(mechanism), options, false, None).ok_or_else(rigid)?,
            options,
            &angles,
        )
    };
    if !march.settle() {
        return Err(ReferenceError::NoEquilibrium { angle: angles[0] });
    }
    if pin.is_none() {
        march.become_model(Model::new(mechanism, options, false, None).ok_or_else(rigid)?);
    }
    let mut rows = Vec::with_capacity(times.len());
    rows.extend(timetable.initial().iter().map(|&t| march.sample(t)));
    let mut closed = pin.is_some();
    for stretch in timetable.stretches() {
        let at = |t: f64| -> Vec<Moving> {
            (0..mechanism.links.len()).map(|joint| timetable.within(stretch, joint, t)).collect()
        };
        let mut begin = stretch.begin;
        if stretch.closed && !closed {
            march.close().ok_or_else(rigid)?;
            closed = true;
            let first = stretch.times.first().copied().unwrap_or(stretch.end).min(stretch.end);
            let h = (options.step / f64::from(SOFT_STEPS)).min(0.1 * (first - begin));
            for _ in 0..SOFT_STEPS {
                begin += h;
                march.step_softly(&at(begin), begin, h)?;
            }
        }
        march.restart(&at(begin), begin)?;
        run_stretch(&mut march, stretch, begin, options.step, &at, &mut rows)?;
        progress(stretch.end / timetable.duration());
    }
    Ok(rows)
}

/// Returns the chain with a drive at every joint.
fn held(mechanism: &Mechanism) -> Mechanism {
    let mut held = mechanism.clone();
    held.closure = None;
    for joint in &mut held.joints {
        joint.passive = false;
    }
    held
}

/// Marches through one stretch from `begin` s on and samples it.
fn run_stretch(
    march: &mut March,
    stretch: &Stretch<'_>,
    begin: f64,
    longest: f64,
    at: &dyn Fn(f64) -> Vec<Moving>,
    rows: &mut Vec<Row>,
) -> Result<(), ReferenceError> {
    let mut t = begin;
    let inside = stretch.times.partition_point(|&time| time < stretch.end);
    let (inside, at_end) = stretch.times.split_at(inside);
    for &stop in inside.iter().chain([&stretch.end]) {
        // Room for the rounding of a whole number of steps.
        let steps = ((stop - t) / longest - 1e-6).ceil().max(1.0);
        let (begin, h) = (t, (stop - t) / steps);
        for k in 1..=steps as u64 {
            t = begin + h * k as f64;
            march.step(&at(t), t, h)?;
        }
        t = stop;
        if stop < stretch.end {
            rows.push(march.sample(stop));
        }
    }
    rows.extend(at_end.iter().map(|&t| march.sample(t)));
    Ok(())
}
