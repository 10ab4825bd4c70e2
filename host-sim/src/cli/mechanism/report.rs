//! Figures of a mechanism's rows and of its plans, for people and for programs.

use serde::Serialize;
use stillbeam::mechanism::Link;
use stillbeam_sim::mechanism::MechanismScene;
use stillbeam_sim::mechanism::plan::{Planned, Request};
use stillbeam_sim::mechanism::table::Row;
use stillbeam_sim::println;

use crate::cli::peak;

/// Figures of rows.
#[derive(Serialize)]
pub struct RowsReport {
    /// The scene's name or file.
    pub scene: String,
    /// The solver in words.
    pub solver: String,
    pub rows: usize,
    /// End of the run, s.
    duration_s: f64,
    /// One a joint, from the first on.
    joints: Vec<Joint>,
}

/// Figures of a joint and of the link behind it.
#[derive(Serialize)]
struct Joint {
    /// Largest torque of its drive, N m.
    peak_torque_nm: f64,
    /// Largest deflection of the link's end, m.
    peak_deflection_m: f64,
    /// Length of the link's strip, m.
    length_m: f64,
}

impl RowsReport {
    pub fn of(scene: &MechanismScene, solver: &str, rows: &[Row]) -> Self {
        let joint = |(j, link): (usize, &Link)| Joint {
            peak_torque_nm: peak(rows, |row| row.torques[j]),
            peak_deflection_m: peak(rows, |row| row.deflections[j]),
            length_m: link.length,
        };
        Self {
            scene: scene.name.clone(),
            solver: solver.to_owned(),
            rows: rows.len(),
            duration_s: rows.last().map_or(0.0, |row| row.t),
            joints: scene.mechanism.links.iter().enumerate().map(joint).collect(),
        }
    }

    /// Prints the peaks, a line a joint.
    pub fn print(&self) {
        for (j, joint) in self.joints.iter().enumerate() {
            let Joint { peak_torque_nm: torque, peak_deflection_m: bent, length_m } = joint;
            println!(
                "  joint {}  peak torque {torque:.4} N m, link deflects by {:.2} mm ({:.1} % of L)",
                j + 1,
                1e3 * bent,
                100.0 * bent / length_m
            );
        }
    }
}

/// Figures of a plan.
#[derive(Serialize)]
pub struct PlanReport {
    /// The scene's name or file.
    scene: String,
    from: Vec<f64>,
    to: Vec<f64>,
    duration_s: f64,
    first_period_s: f64,
    /// Largest torque of each joint in the reference rod, N m.
    peak_torque_nm: Vec<f64>,
    /// Distance from the place at rest in the reference rod over a first period after the arrival,
    /// fraction of the total length.
    residual: f64,
    /// The same after quintics in the same time.
    quintics_residual: f64,
    /// Simulations of the move that the search took.
    flights: u32,
    page: String,
}

impl PlanReport {
    pub fn of(request: &Request<'_>, planned: &Planned, page: &std::path::Path) -> Self {
        let rows = &planned.still.rows;
        Self {
            scene: request.scene.name.clone(),
            from: request.from.clone(),
            to: request.to.clone(),
            duration_s: planned.duration,
            first_period_s: planned.first_period,
            peak_torque_nm: (0..request.to.len())
                .map(|j| peak(rows, |row| row.torques[j]))
                .collect(),
            residual: planned.still.residual,
            quintics_residual: planned.quintic.residual,
            flights: planned.flights,
            page: page.display().to_string(),
        }
    }

    /// Prints them, a line a figure.
    pub fn print(&self) {
        println!("{}: {:?} to {:?} rad, still", self.scene, self.from, self.to);
        let periods = self.duration_s / self.first_period_s;
        println!("  duration           {:.4} s ({periods:.2} first periods)", self.duration_s);
        for (j, peak) in self.peak_torque_nm.iter().enumerate() {
            println!("  peak torque {}      {peak:.4} N m in the reference rod", j + 1);
        }
        let residual = 100.0 * self.residual;
        println!("  residual           {residual:.4} % of the total length in the reference rod");
        println!("  quintics           {:.4} % in the same time", 100.0 * self.quintics_residual);
        println!("  planned in         {} simulations of the move", self.flights);
        println!("  {}", self.page);
    }
}
