//! Reference solutions as the rows of a table.

use clap::ValueEnum;
use stillbeam::Scene;

use crate::error::Error;
use crate::reference::{Sample, fem, rod};
use crate::scene_file::SceneFile;
use crate::table::Row;
use crate::trajectory::Trajectory;

/// Reference solver by which the core is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Reference {
    /// The inextensible rod with exact kinematics.
    Rod,
    /// The paper's formulation done in full: corotational elements in the global frame.
    Fem,
}

impl Reference {
    /// Describes the solver in a few words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Rod => "inextensible rod, exact kinematics",
            Self::Fem => "corotational elements, global frame",
        }
    }
}

/// Solves a scene's motion at `times` (s, rising, within the run). Returns rows as `run` writes
/// them.
///
/// The row at the end of a move or of a dwell holds the left-hand acceleration and torque.
/// `progress` is called with the fraction that is done.
pub fn solve(
    reference: Reference,
    scene: &SceneFile,
    trajectory: &Trajectory,
    times: &[f64],
    progress: &dyn Fn(f64),
) -> Result<Vec<Row>, Error> {
    let samples = match reference {
        Reference::Rod => {
            rod::solve_with(&scene.arm, trajectory, times, &rod::Options::default(), progress)
        }
        Reference::Fem => {
            fem::solve_with(&scene.arm, trajectory, times, &fem::Options::default(), progress)
        }
    };
    Ok(samples.map_err(Error::new)?.iter().map(|sample| row(&scene.arm, sample)).collect())
}

/// Returns times from 0 to the end of a motion, `every` s apart, the end included.
pub fn times(trajectory: &Trajectory, every: f64) -> Vec<f64> {
    times_until(trajectory.duration(), every)
}

/// Returns times from 0 to `end` s, `every` s apart, the end included.
pub fn times_until(end: f64, every: f64) -> Vec<f64> {
    let whole = (end / every + 1e-6).floor() as u64;
    let mut times: Vec<f64> = (0..=whole).map(|k| (k as f64 * every).min(end)).collect();
    if end - times[times.len() - 1] > 1e-6 * every {
        times.push(end);
    }
    times
}

fn row(arm: &Scene, sample: &Sample) -> Row {
    let payload = (arm.payload.offset != 0.0).then_some(sample.payload);
    Row {
        t_s: sample.t,
        hub_angle_rad: sample.angle,
        hub_rate_rad_s: sample.rate,
        hub_accel_rad_s2: sample.acceleration,
        tip_x_m: sample.tip[0],
        tip_y_m: sample.tip[1],
        deflection_m: sample.deflection,
        torque_nm: sample.torque,
        payload_x_m: payload.map(|[x, _]| x),
        payload_y_m: payload.map(|[_, y]| y),
    }
}
