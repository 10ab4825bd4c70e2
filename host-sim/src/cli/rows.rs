//! The rows of one arm, as `run` and `reference` show them.

use serde::Serialize;
use stillbeam_sim::compare::residual;
use stillbeam_sim::error::Error;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::table::Row;
use stillbeam_sim::{axis_units, println};

/// Figures of the rows.
#[derive(Serialize)]
pub struct Figures {
    /// Largest torque, N m; on a linear axis the largest force, N.
    pub peak_effort: f64,
    pub peak_deflection_m: f64,
    /// Residual vibration, fraction of L. Absent if the hub does not end at rest, or if the rows
    /// are too far apart to tell.
    pub residual: Option<f64>,
}

impl Figures {
    /// Takes them from the rows of a scene whose durations are rounded to `tick` s.
    pub fn of(scene: &SceneFile, tick: f64, rows: &[Row]) -> Result<Self, Error> {
        Ok(Self {
            peak_effort: super::peak(rows, |row| row.torque_nm),
            peak_deflection_m: super::peak(rows, |row| row.deflection_m),
            residual: residual(rows, scene, tick)?.value(),
        })
    }

    /// Prints the peaks.
    pub fn print_peaks(&self, scene: &SceneFile) {
        let units = axis_units::of(scene.arm.mount.axis);
        println!("  peak {:<10}  {:.4} {}", units.effort, self.peak_effort, units.effort_unit);
        println!(
            "  peak deflection  {:.2} mm ({:.1} % of L)",
            1e3 * self.peak_deflection_m,
            100.0 * self.peak_deflection_m / scene.arm.link.length
        );
    }

    /// Prints the residual vibration, if there is one.
    pub fn print_residual(&self, scene: &SceneFile) {
        if let Some(residual) = self.residual {
            println!(
                "  residual         {:.2} mm ({:.2} % of L) in a first period after arrival",
                1e3 * residual * scene.arm.link.length,
                100.0 * residual
            );
        }
    }
}

/// Draws deflection and effort over time, if standard output is a terminal.
pub fn draw(scene: &SceneFile, rows: &[Row]) {
    let units = axis_units::of(scene.arm.mount.axis);
    let effort = format!("{}, {}", units.effort, units.effort_unit);
    let end = rows.last().map_or(0.0, |row| row.t_s);
    super::draw(
        [
            ("deflection, mm", rows.iter().map(|row| 1e3 * row.deflection_m).collect()),
            (effort.as_str(), rows.iter().map(|row| row.torque_nm).collect()),
        ],
        end,
    );
}
