//! The paper's study on the embedded scenes: one module a figure, numbers only.
//!
//! The paper: A. Kato and D. Isobe, "Calculating Trajectories for Flexible Manipulators by Using
//! Finite Element Method" (in Japanese). [`crate::report`] shows what is computed here.

pub mod elements;
mod files;
mod findings;
pub mod link_mass;
pub mod mechanisms;
pub mod members;
pub mod profiles;
pub mod setpoints;
pub mod steps;
pub mod stillness;
pub mod tip_path;

pub use files::REPORT;

use stillbeam::Move;

use crate::error::Error;
use crate::scene_file::SceneFile;
use crate::solver::{Method, Solver, SolverKeys};
use crate::table::Row;
use crate::{compare, run, scenes};

/// Results that the report shows.
#[derive(Clone, Debug)]
pub struct Study {
    /// Mass of the link of the paper's section 3.
    pub link_mass: link_mass::LinkMass,
    /// Fig. 1.
    pub tip_path: tip_path::TipPath,
    /// Fig. 2.
    pub elements: elements::Elements,
    /// Fig. 5.
    pub steps: steps::Steps,
    /// Fig. 6.
    pub members: members::Members,
    /// Evidence that the profile is the cubic.
    pub profiles: profiles::Profiles,
    /// Setpoints of one move.
    pub setpoints: setpoints::Setpoints,
    /// Moves that arrive still. The paper has none.
    pub stillness: stillness::Stillness,
    /// Link systems, open and closed.
    pub mechanisms: mechanisms::Mechanisms,
}

impl Study {
    /// Steps of [`Self::compute`], for a progress bar.
    pub const STEPS: usize = 28;

    /// Runs everything, in a few seconds. Writes nothing. `done` is called about [`Self::STEPS`]
    /// times.
    pub fn compute(done: &(dyn Fn() + Sync)) -> Result<Self, Error> {
        Ok(Self {
            link_mass: link_mass::LinkMass::compute()?,
            tip_path: tip_path::TipPath::compute()?,
            elements: elements::Elements::compute()?,
            steps: steps::Steps::compute()?,
            members: members::Members::compute()?,
            profiles: profiles::Profiles::compute()?,
            setpoints: setpoints::Setpoints::compute()?,
            stillness: stillness::Stillness::compute(done)?,
            mechanisms: mechanisms::Mechanisms::compute()?,
        })
    }
}

/// A scene, its solver, and the rows of its run.
#[derive(Clone, Debug)]
pub struct Run {
    /// The scene, with the solver in it.
    pub scene: SceneFile,
    /// The solver.
    pub solver: Solver,
    /// Rows, one every tick.
    pub rows: Vec<Row>,
}

impl Run {
    /// Runs a scene by its own solver.
    pub fn of(scene: SceneFile) -> Result<Self, Error> {
        let solver = scene.solver.resolve()?;
        let rows = run::run(&scene, &solver)?;
        Ok(Self { scene, solver, rows })
    }

    /// Runs an embedded scene. `keys` override its own solver.
    pub fn embedded(name: &str, keys: SolverKeys) -> Result<Self, Error> {
        Self::of(scene(name, keys)?)
    }

    /// Returns tip X over time, (s, m).
    pub fn tip_x(&self) -> Vec<(f64, f64)> {
        self.rows.iter().map(|row| (row.t_s, row.tip_x_m)).collect()
    }

    /// Returns the hub-frame deflection of the tip over time, (s, m).
    pub fn deflection(&self) -> Vec<(f64, f64)> {
        self.rows.iter().map(|row| (row.t_s, row.deflection_m)).collect()
    }

    /// Returns the largest |deflection| of the run, fraction of L.
    pub fn peak(&self) -> f64 {
        let largest = self.rows.iter().map(|row| row.deflection_m.abs()).fold(0.0, f64::max);
        largest / self.scene.arm.link.length
    }

    /// Returns the [`compare::residual`] of a run that ends at rest, fraction of L.
    pub fn residual(&self) -> Result<f64, Error> {
        compare::residual(&self.rows, &self.scene, self.solver.tick)?
            .value()
            .ok_or_else(|| Error::new(format_args!("{}: does not end at rest", self.scene.name)))
    }

    /// Returns the duration of the first move, s.
    pub fn move_time(&self) -> f64 {
        self.scene.moves.first().map_or(0.0, |step| step.motion.duration())
    }
}

/// Opens an embedded scene. `keys` override its own solver. If neither names a method, the paper's
/// is taken.
fn scene(name: &str, keys: SolverKeys) -> Result<SceneFile, Error> {
    let scene = scenes::open(name)?;
    let paper = SolverKeys { method: Some(Method::Newmark), ..SolverKeys::default() };
    Ok(SceneFile { solver: keys.or(scene.solver).or(paper), ..scene })
}

/// Returns the same scene with another profile and duration in its first move.
fn reshaped(scene: &SceneFile, profile: stillbeam::Profile, duration: f64) -> SceneFile {
    let mut scene = scene.clone();
    if let Some(step) = scene.moves.first_mut()
        && let Some(Move::To { to, .. }) = step.motion.as_move()
    {
        step.motion = Move::To { profile, duration, to }.into();
    }
    scene
}
