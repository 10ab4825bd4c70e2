//! The finite element method, step by step in the global frame: nodal displacements split into the
//! rigid motion with the hub, `u_m`, which is given, and the deformation `u_d`, which is solved
//! for.
//!
//! `M(ü_m + ü_d) + αM(u̇_m + u̇_d) + f(u_d) + βK u̇_d = weight`, with f the internal forces of
//! cubic elements in corotational frames and β acting on their deformation rates; Newmark's rule (δ
//! = 1/2, β = 1/4) on u_d with equilibrium iterations. The formulation is that of Kato and Isobe's
//! trajectory calculation for flexible manipulators (section 2), with iterations added. Error: of
//! second order in the step, of fourth in the element's length.

mod block;
pub(super) mod element;
pub(super) mod inertia;
mod model;
mod newmark;
pub(super) mod node;

use model::Model;
use newmark::March;
use stillbeam::Scene;

use super::option::within;
use super::schedule::Schedule;
use super::{ReferenceError, Sample};
use crate::trajectory::Trajectory;

/// Mesh and step of the solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Number of elements over the link, 1 to 1000.
    pub elements: usize,
    /// Longest step, s; `None` is a thousandth of `L²√(ρA/EI)`. The rule is not unconditionally
    /// stable on this nonlinear problem: the spin-up of `tests/truth` needs a step below twice the
    /// default, and stops with an error above.
    pub step: Option<f64>,
    /// `EA L²/EI`, 1e2 to 1e9; 12(L/t)² for a strip of thickness t. The tip differs from an
    /// inextensible link's by up to 10/this of L in the runs of `tests/truth`.
    pub axial_stiffness: f64,
    /// Model of the stretch between axis and clamp.
    pub hub: HubModel,
    /// Largest residual of an equilibrium, as a fraction of `EI/L²` (moments: of `EI/L`), 1e-12 to
    /// 1e-2. The residual that rounding leaves is accepted too: some 1e-7 with the other defaults.
    pub tolerance: f64,
}

/// The stretch from the motor axis to the clamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HubModel {
    /// Rigid: the clamp moves on a circle about the axis.
    Rigid,
    /// One massless element, as in the paper.
    Element {
        /// Its EI and EA as multiples of the link's, 1 to 1e7. The tip differs from a rigid hub's
        /// in inverse proportion: at 1e4 by some 2e-5 of L where r is a tenth of L.
        stiffness: f64,
    },
}

impl Default for Options {
    fn default() -> Self {
        Self {
            elements: 32,
            step: None,
            axial_stiffness: 1e7,
            hub: HubModel::Rigid,
            tolerance: 1e-6,
        }
    }
}

impl Options {
    fn validate(&self) -> Result<(), ReferenceError> {
        within("elements", self.elements as f64, [1.0, 1000.0], "1 to 1000")?;
        within("step", self.step.unwrap_or(1e-3), [1e-9, 1.0], "1e-9 to 1 s")?;
        within("axial_stiffness", self.axial_stiffness, [1e2, 1e9], "1e2 to 1e9")?;
        within("tolerance", self.tolerance, [1e-12, 1e-2], "1e-12 to 1e-2")?;
        match self.hub {
            HubModel::Rigid => Ok(()),
            HubModel::Element { stiffness } => {
                within("hub.stiffness", stiffness, [1.0, 1e7], "1 to 1e7")
            }
        }
    }
}

/// Solves a run of the scene and samples it at `times` (s, ascending, within the run).
///
/// The arm starts from rest in static equilibrium at the first angle. Steps are cut so that every
/// sample time and every break of the commanded motion ends one.
pub fn solve(
    scene: &Scene,
    trajectory: &Trajectory,
    times: &[f64],
    options: &Options,
) -> Result<Vec<Sample>, ReferenceError> {
    solve_with(scene, trajectory, times, options, &|_| ())
}

/// Solves as [`solve`] does and calls `progress` with the fraction of the run that is done, 0 to 1.
pub fn solve_with(
    scene: &Scene,
    trajectory: &Trajectory,
    times: &[f64],
    options: &Options,
    progress: &dyn Fn(f64),
) -> Result<Vec<Sample>, ReferenceError> {
    let scene = scene.validate()?;
    options.validate()?;
    if scene.hub.stiffness.is_some() && options.hub != HubModel::Rigid {
        let given = format!("hub = {:?}", options.hub);
        return Err(ReferenceError::Options {
            given,
            wanted: "rigid where hub.stiffness is given",
        });
    }
    let schedule = Schedule::new(trajectory, times)?;
    let link = &scene.link;
    let period =
        link.length * link.length * (scene.mass_per_length() / link.bending_stiffness).sqrt();
    let longest = options.step.unwrap_or(1e-3 * period);

    let start = schedule.hub(0.0);
    let mut march = March::new(Model::new(&scene, options), options.tolerance);
    march.settle(&start)?;
    march.restart(&start, 0.0)?;
    let mut samples = Vec::with_capacity(times.len());
    samples.extend(schedule.initial().iter().map(|&t| march.sample(t, &start)));

    let stretches = schedule.stretches();
    for (i, stretch) in stretches.iter().enumerate() {
        let mut t = stretch.begin;
        let inside = stretch.times.partition_point(|&time| time < stretch.end);
        let (inside, at_end) = stretch.times.split_at(inside);
        for &stop in inside.iter().chain([&stretch.end]) {
            // Room for the rounding of a whole number of steps.
            let steps = ((stop - t) / longest - 1e-6).ceil().max(1.0);
            let (begin, h) = (t, (stop - t) / steps);
            for k in 1..=steps as u64 {
                t = begin + h * k as f64;
                march.step(&schedule.hub_within(stretch, t), t, h)?;
            }
            t = stop;
            if stop < stretch.end {
                samples.push(march.sample(stop, &schedule.hub(stop)));
            }
            progress(stop / schedule.duration());
        }
        let left = schedule.hub_within(stretch, stretch.end);
        let sampled = schedule.hub(stretch.end);
        // A sample just before a jump has the accelerations from before it, one behind it has not.
        let before = sampled.acceleration == left.acceleration;
        if before {
            samples.extend(at_end.iter().map(|&t| march.sample(t, &sampled)));
        }
        if let Some(next) = stretches.get(i + 1) {
            march.restart(&schedule.hub_within(next, next.begin), next.begin)?;
        }
        if !before {
            samples.extend(at_end.iter().map(|&t| march.sample(t, &sampled)));
        }
    }
    Ok(samples)
}
