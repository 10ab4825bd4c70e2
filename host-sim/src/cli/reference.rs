//! `reference`: solves a scene with a reference solver.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_sim::compare::residual;
use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism;
use stillbeam_sim::truth::{self, Reference};
use stillbeam_sim::{axis_units, println, progress, run, table};

use super::mechanism::Outputs;
use super::motion::MotionArgs;

#[derive(clap::Args)]
pub struct ReferenceArgs {
    /// Scene file, or the name of an embedded scene
    scene: String,
    /// Reference solver
    #[arg(long, value_enum, default_value = "rod")]
    solver: Reference,
    /// File for the rows
    #[arg(long, value_name = "OUT.csv")]
    csv: PathBuf,
    #[command(flatten)]
    motion: MotionArgs,
    /// Interval of the rows in s [default: the scene's tick]
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    every: Option<f64>,
    /// File for a page with the mechanism drawn, of a mechanism
    #[arg(long, value_name = "OUT.html")]
    page: Option<PathBuf>,
}

impl ReferenceArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        if let Some(scene) = mechanism::scenes::open(&self.scene)? {
            super::mechanism::refuse("--motion", self.motion.is_given())?;
            let outputs = Outputs { csv: &self.csv, page: self.page.as_deref() };
            return super::mechanism::reference(&scene, self.solver, self.every, &outputs);
        }
        super::mechanism::refuse_for_arm("--page", self.page.is_some())?;
        let scene = self.motion.open(&self.scene)?;
        let tick = scene.solver.resolve()?.tick;
        let (scene, mut notes) = self.motion.command(scene, tick)?;
        notes.extend(scene.deduced.lines());
        notes.extend(scene.roundings(tick)?);
        let trajectory = scene.trajectory(tick)?;
        let every = self.every.unwrap_or(tick);
        if !(1e-6..=trajectory.duration()).contains(&every) {
            return Err(Error::new(format_args!(
                "--every = {every}: must be 0.000001 to {} s, the run's length",
                trajectory.duration()
            )));
        }
        super::with_limits_shown(|progress| run::admit_loads(&scene, tick, &|_| true, progress))?;
        let bar = progress::percent(&scene.name);
        let times = truth::times(&trajectory, every);
        let rows = truth::solve(self.solver, &scene, &trajectory, &times, &|done| {
            bar.set_position((100.0 * done) as u64);
        });
        bar.finish_and_clear();
        let rows = rows?;
        // A refusal is one line.
        for line in notes {
            super::note(&line);
        }
        table::write(&self.csv, scene.arm.mount.axis, &rows)?;
        let units = axis_units::of(scene.arm.mount.axis);
        let peak = |of: fn(&table::Row) -> f64| rows.iter().map(of).fold(0.0, f64::max);
        let bent = peak(|row| row.deflection_m.abs());
        println!("{}: {}", scene.name, self.solver.describe());
        println!("  {} rows to {}", rows.len(), self.csv.display());
        println!(
            "  peak {:<10}  {:.4} {}",
            units.effort,
            peak(|row| row.torque_nm.abs()),
            units.effort_unit
        );
        println!(
            "  peak deflection  {:.2} mm ({:.1} % of L)",
            1e3 * bent,
            100.0 * bent / scene.arm.link.length
        );
        // Rows far apart cannot tell how much a vibration leaves.
        if let Some(residual) = residual(&rows, &scene, tick)?.value() {
            println!(
                "  residual         {:.2} mm ({:.2} % of L) in a first period after arrival",
                1e3 * residual * scene.arm.link.length,
                100.0 * residual
            );
        }
        Ok(ExitCode::SUCCESS)
    }
}
